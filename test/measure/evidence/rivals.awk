# rivals.awk, after better.awk: sections of doc/measured from lines HALF,NUMBER,run,METHOD,... of corpus_run.sh: error
# times CPU time of asbdpt over that of each rival, in a scene a ratio. techniques, alone: of halves services and choice,
# a row for each rival, with geometric means and quartiles over scenes, the means of error and of time apart, too; of
# the choice alone also over bdpt. holm: in how many cells the interval of the mean is below 1, and which of these are
# not so by Holm's correction (Scandinavian Journal of Statistics 6, 1979), at 5 % for all. over-bdpt: error, time. data: lines of a figure, "SCENE MSE8 MSE8 MSE8 MSE8", over two
# rivals, sorted by the first. A method that misses light, or has ended, has no ratio.
BEGIN {
    FS = ","
    names = split("lvc cbdpt mbdpt spcbpt", rival, " ")
    split("mse8 relmse 8x8", measure, " ")
}
$3 == "run" {
    key = $1 SUBSEP $2 SUBSEP $4
    if (!($2 in known)) { known[$2]; scene[++scenes] = $2 }
    runs[key]++
    seconds[key] += $7
    for (k = 1; k <= 3; k++) square[key, k] += $(7 + k)
    if ($12 == "misses light") dark[key]
}
# cost: error times time by measure k, 1 to 3; 4: the error of measure 1; 5: the time; 0: not known.
function cost(half, s, method, k,    key, m) {
    key = half SUBSEP s SUBSEP method
    m = k > 3 ? 1 : k
    if (!(key in runs) || key in dark || square[key, m] <= 0) return 0
    return (k == 5 ? 1 : square[key, m] / runs[key]) * (k == 4 ? 1 : seconds[key] / runs[key])
}
function ratio(half, s, method, k,    b) {
    b = cost(half, s, method, k)
    return b > 0 ? cost(half, s, "asbdpt", k) / b : 0
}
# over: the set of ratios to a method, filled; the cells of its row.
function over(half, method,    set, k, i, n, x) {
    set = half " " method
    for (k = 1; k <= 5; k++) for (i = 1; i <= scenes; i++) take(set, k, ratio(half, scene[i], method, k))
    return set
}
function quantile(set, k, share,    x, n, i, at) { # between neighbours in proportion
    n = number[set, k]
    for (i = 1; i <= n; i++) x[i] = each[set, k, i]
    sort(x, n)
    at = 1 + (n - 1) * share
    i = int(at)
    return exp(i < n ? x[i] + (at - i) * (x[i + 1] - x[i]) : x[n])
}
function cells(half, method,    set, k) {
    set = over(half, method)
    printf "| `%s` | %d | %s | %.2f | %.2f | %.2f | %.2f | %.2f | %s |", method, number[set, 1], interval(set, 1), \
        mean_of(set, 4), mean_of(set, 5), quantile(set, 1, 0.25), quantile(set, 1, 0.5), quantile(set, 1, 0.75), \
        two(most[set, 1])
    for (k = 2; k <= 3; k++) printf " %s | %.2f |", interval(set, k), quantile(set, k, 0.5)
    print ""
    return set
}
function table(half, title,    j, k, set) {
    printf "== %s\n| over | n | mse8: mean | its error | its time | 25 %% | 50 %% | 75 %% | worst | relmse: mean | 50 %% |" \
        " 8x8: mean | 50 %% |\n", title
    print "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
    for (j = 1; j <= names; j++) {
        set = cells(half, rival[j])
        for (k = 1; k <= 3; k++) if (number[set, k] > 4 && error_of(set, k) > 0) {
            p[++all] = student_p(logs[set, k] / number[set, k] / error_of(set, k), number[set, k] - 1)
            text[all] = "over `" rival[j] "` by " measure[k] (half == "choice" ? ", choice alone" : "")
            below[all] = mean_of(set, k) * exp(student(number[set, k] - 1) * error_of(set, k)) < 1
            sure += below[all]
        }
    }
}
END {
    if (!scenes) exit 1
    table("services", "techniques")
    table("choice", "alone")
    bdpt = cells("choice", "bdpt")
    for (i = 1; i <= all; i++) sorted[i] = p[i]
    sort(sorted, all)
    for (m = 1; m <= all && sorted[m] <= 0.05 / (all - m + 1); m++) limit = sorted[m]
    for (i = 1; i <= all; i++) if (below[i] && (m == 1 || p[i] > limit)) said = said (said ? "; " : ": ") text[i]
    printf "== holm\nin %d of %d cells the interval is below 1. Holm\047s correction at 5 %% drops%s\n", sure, all, \
        said ? said : " none"
    printf "== over-bdpt\n%.2f of the error of `bdpt` in %.2f of its time\n", mean_of(bdpt, 4), mean_of(bdpt, 5)
    print "== data"
    for (i = 1; i <= scenes; i++) by[i] = ratio("services", scene[i], rival[1], 1)
    for (j = 1; j <= scenes; j++) {
        low = 0
        for (i = 1; i <= scenes; i++) if (by[i] > 0 && !(i in told) && (!low || by[i] < by[low])) low = i
        if (!low) break
        told[low]
        v = ratio("services", scene[low], rival[2], 1)
        printf "%s %.3f %.3f %.3f %s\n", scene[low], by[low], by[low], by[low], (v > 0 ? sprintf("%.3f", v) : "-")
    }
}

# corpus.awk: the tables of corpus.md from the list of scenes and the lines of corpus_run.sh, or from both in one file, in
# which the set of a scene is a line, too: NUMBER,set,SET.
#   awk -f test/measure/corpus.awk DIR/list.txt OUT/*.csv                     tables
#   awk -v scores=yes -f test/measure/corpus.awk DIR/list.txt OUT/*.csv       a line for each scene, for corpus_svg.awk:
#                                                   NUMBER SET RUNNER, asbdpt over the better by relmse, pt over bdpt
#   awk -v page=sets -f test/measure/corpus.awk FILE                          the first table for a page; page=runners: the
#                                                   second, by mse8; page=sentence: of `report`, by mse8, in words;
#                                                   page=quartiles: of `report`, for a short table; page=baselines:
#                                                   of `report`, over pt and over bdpt alone; page=few: how many
#                                                   scenes of `report` a path tracer renders
BEGIN {
    split("mse8 relmse 8x8", measure, " ")
    baselines = "pt bdpt"
    n_measures = page == "sentence" ? 1 : 3
    FORM = "%-16s %-12s %4d %7.3f %7.3f %7.3f %7.3f %7.3f %7.3f %8.3f %7.1f %% %7.1f %%\n"
}
/\t/ { split($0, field, "\t"); set[field[1]] = field[4]; next }
{ split($0, field, ",") }
field[2] == "set" { set[field[1]] = field[3] }
field[2] == "scene" {
    for (i = 7; i <= 13; i++) {
        split(field[i], pair, "=")
        has[field[1], pair[1]] = pair[2]
    }
    runner[field[1]] = has[field[1], "runner"]
    scene[++n_scenes] = field[1]
}
field[2] == "failed" && field[3] == "-" { reasons[field[4]]++; n_failed++ }
field[2] == "failed" && field[3] != "-" { failed[field[3]]++ }
field[2] == "run" {
    key = field[1] SUBSEP field[3]
    runs[key]++
    seconds[key] += field[6]
    for (k = 1; k <= 3; k++) square[key, k] += field[6 + k]
    if (field[11] == "misses light") { if (!(key in dark)) missing[field[3]]++; dark[key] = 1 }
}

# Error times CPU time of a method; -1: none, or it misses light.
function cost(number, method, k,    key) {
    key = number SUBSEP method
    return !(key in runs) || key in dark ? -1 : square[key, k] / runs[key] * seconds[key] / runs[key]
}
# Is there noise that one could see: does one of pt and bdpt differ by more than a tenth of a level of 255?
function noisy(number,    key, i) {
    for (i = 1; i <= 2; i++) {
        key = number SUBSEP (i == 1 ? "pt" : "bdpt")
        if (key in runs && square[key, 1] / runs[key] > 0.01) return 1
    }
    return 0
}
# asbdpt over the better of the baselines, pt and bdpt or one of them; -1: asbdpt or all of these are missing, or there
# is no noise.
function score(number, k,    a, p, b) {
    a = cost(number, "asbdpt", k)
    p = baselines ~ /^pt/ ? cost(number, "pt", k) : -1
    b = baselines ~ /bdpt$/ ? cost(number, "bdpt", k) : -1
    b = b > 0 && (p <= 0 || b < p) ? b : p
    return a > 0 && b > 0 && noisy(number) ? a / b : -1
}
# pt over bdpt.
function duel(number, k,    p, b) {
    p = cost(number, "pt", k)
    b = cost(number, "bdpt", k)
    return p > 0 && b > 0 ? p / b : "-"
}

function sort(x, n,    i, j, t) {
    for (i = 2; i <= n; i++) {
        t = x[i]
        for (j = i - 1; j > 0 && x[j] > t; j--) x[j + 1] = x[j]
        x[j + 1] = t
    }
}
# What a share of n sorted values does not exceed, between neighbours in proportion.
function quantile(x, n, share,    at, i) {
    at = 1 + (n - 1) * share
    i = int(at)
    return i < n ? x[i] + (at - i) * (x[i + 1] - x[i]) : x[n]
}
function line(label, m, x, n,    i, worse, better, sum) {
    if (n == 0) return
    sort(x, n)
    for (i = 1; i <= n; i++) { worse += x[i] > 1.15; better += x[i] < 0.87; sum += log(x[i]) }
    if (page == "sentence") {
        printf "%.2f of the time of the better method in the median scene. In a quarter of the scenes it takes at most " \
            "%.2f, in %.0f %% over 1.15\n", quantile(x, n, 0.5), quantile(x, n, 0.25), 100 * worse / n
        return
    }
    if (page == "quartiles") {
        printf "| %s | %.2f | %.2f | %.2f | %.2f | %.3g |\n", measure[m], quantile(x, n, 0.25), quantile(x, n, 0.5), \
            quantile(x, n, 0.75), quantile(x, n, 0.9), x[n]
        return
    }
    form = page ? "| %s | %s | %d | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.3g | %.0f %% | %.0f %% |\n" : FORM
    printf form, label, measure[m], n, exp(sum / n), quantile(x, n, 0.1), quantile(x, n, 0.25), quantile(x, n, 0.5),
        quantile(x, n, 0.75), quantile(x, n, 0.9), x[n], 100 * worse / n, 100 * better / n
}
# Of the scenes that have the value, of either set or of one.
function group(label, what, value, most,    m, i, n, x, own) {
    for (m = 1; m <= most; m++) {
        n = 0
        for (i = 1; i <= n_scenes; i++) {
            own = what == "set" ? set[scene[i]] : what == "" ? "" : what == "inside" ? \
                (has[scene[i], what] >= 0.9) : has[scene[i], what]
            if (own == value && score(scene[i], m) > 0) x[++n] = score(scene[i], m)
        }
        line(label, m, x, n)
    }
}
function head(title) {
    if (page == "sentence") return
    if (page == "quartiles") {
        print "| noise | 25 % of scenes | 50 % | 75 % | 90 % | worst |"
        print "|---|---:|---:|---:|---:|---:|"
        return
    }
    if (page) {
        print "| scenes | error | n | mean | 10 % | 25 % | 50 % | 75 % | 90 % | worst | over 1.15 | under 0.87 |"
        print "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
        return
    }
    printf "\n%s\n%-16s %-12s %4s %7s %7s %7s %7s %7s %7s %8s %9s %9s\n", title, "", "error", "n", "mean", "10 %",
        "25 %", "50 %", "75 %", "90 %", "worst", "over 1.15", "under .87"
}
END {
    if (scores) {
        for (i = 1; i <= n_scenes; i++)
            if (score(scene[i], 2) > 0)
                print scene[i], set[scene[i]], runner[scene[i]], score(scene[i], 2), \
                    duel(scene[i], 2)
        exit
    }
    if (!page) {
        printf "%d scenes measured, %d that could not be loaded again\n", n_scenes, n_failed
        for (why in reasons) printf "    %d: %s\n", reasons[why], why
        for (m in failed) printf "    %s failed in %d\n", m, failed[m]
        for (m in missing) printf "    %s misses light in %d\n", m, missing[m]
        for (i = 1; i <= n_scenes; i++) still += !noisy(scene[i])
        printf "    %d without noise that one could see\n", still
    }
    if (page == "few") {
        for (i = 1; i <= n_scenes; i++) if (set[scene[i]] == "report" && score(scene[i], 1) > 0) {
            all++
            few += runner[scene[i]] ~ /^(path_tracer|one_point)$/
        }
        print few + 0 " of " all
        exit
    }
    if (page == "baselines") {
        head()
        split("pt,bdpt,pt bdpt", each, ",")
        for (k = 1; k <= 3; k++) {
            baselines = each[k]
            group(k < 3 ? "over `" each[k] "`" : "over the better of both", "set", "report", 1)
        }
        exit
    }
    if (page != "runners") {
        head("error x CPU time of asbdpt over the better of pt and bdpt")
        if (page != "sentence" && page != "quartiles") group("tune", "set", "tune", n_measures)
        group("report", "set", "report", n_measures)
        if (page == "sentence" || page == "quartiles") exit
        for (i in set) sets[set[i]]
        if ("tune" in sets && "report" in sets) group("both", "", "", n_measures)
        if (page) exit
    }
    head("by what the race has chosen")
    for (i = 1; i <= n_scenes; i++) {
        chosen = runner[scene[i]]
        if (!told[chosen]++) group(chosen, "runner", chosen, page ? 1 : 3)
    }
    if (page) exit
    head("by what a scene has")
    n = split("delta sky lamps mirror medium", what, " ")
    for (k = 1; k <= n; k++) { group(what[k], what[k], 1, 3); group("no " what[k], what[k], 0, 3) }
    group("inside", "inside", 1, 3)
    group("outside", "inside", 0, 3)
}

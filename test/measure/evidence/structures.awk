# structures.awk, after better.awk and runs.awk: asbdpt over the better of bdpt and pt, by each measure, in scenes
# NUMBER-KIND, from the runs of `asbdpt-lab equal-time`. Sections: kinds, a row for each; all, in words; mean, over bdpt
# by mse8; by-kind, the means over kinds; row and worst, see better.awk; median, the row of medians over seeds;
# worst-KIND, the worst of it; sure, in how many scenes intervals tell; data, lines "SCENE MSE8 LOW HIGH RELMSE LOW HIGH
# 8x8 LOW HIGH", "-" without a number.
# With -v worst= and -v mean=: exit status 1 beyond them by mse8, or where asbdpt has a mark.
# cells: of a set: for each measure the mean with its interval, the worst, and in how many scenes it is above 1.
function cells(set,    m, text) {
    for (m = 1; m <= 3; m++) text = text sprintf(" %s | %.2f | %d |", interval(set, m), most[set, m], above[set, m])
    return text
}
function over(s, k,    v, by) { # and its interval
    v = over_better(g, s, k)
    if (v <= 0) return "- - -"
    by = factor(g, "subspaces", the_better(g, s, k), s, k)
    if (by) { better[k] += v * by < 1; worse[k] += v / by > 1 } else by = 1
    return sprintf("%.3f %.3f %.3f", v, v / by, v * by)
}
END {
    g = group[groups]
    for (i = 1; i <= scenes[g]; i++) {
        s = scene[g, i]
        take("over bdpt", 1, ratio(g, "subspaces", "bdpt", s, 1))
        first_marked += mark[g, "bdpt", s] != ""; missed += mark[g, "pt", s] != ""
        if (mark[g, "subspaces", s] != "") dark = dark (dark ? ", `" : " in `") s "`"
        line = s " " over(s, 1) " " over(s, 2) " " over(s, 3)
        data = data line "\n"
        kind = s; sub(/^[0-9]+-/, "", kind)
        if (!count[kind]++) order[++kinds] = kind
        count["**all**"]++
        take_scene(kind, g, s)
        take_scene("**all**", g, s)
        for (k = 1; k <= 3; k++) take("median", k, over_median(g, s, k))
        split(line, part, " ")
        if (worst && (part[2] == "-" || part[3] > worst + 0 || mark[g, "subspaces", s] != "")) {
            bad = 1
            print "structures: " line, mark[g, "subspaces", s] >"/dev/stderr"
        }
    }
    if (!number["**all**", 1]) exit 1
    print "== kinds\n| structure | scenes | mse8 | worst | above 1 | relmse | worst | above 1 | 8x8 | worst | above 1 |"
    print "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
    order[++kinds] = "**all**"
    for (j = 1; j <= kinds; j++) print "| " order[j] " | " count[order[j]] " |" cells(order[j])
    print "\n![Squared error of asbdpt over the better of bdpt and pt, in each generated scene](structures.svg)"
    print "== all"
    printf "Marks: `bdpt` in %d, `pt` in %d, `asbdpt`%s. No number: by mse8 in %d, by relmse in %d, by 8x8 in %d.\n", \
        first_marked, missed, dark ? dark : " in none", lost["**all**", 1], lost["**all**", 2], lost["**all**", 3]
    print "== mean\n" interval("over bdpt", 1)
    for (j = 1; j < kinds; j++) for (k = 1; k <= 3; k++) take("kinds", k, mean_of(order[j], k))
    print "== by-kind\n" three(interval("kinds", 1), interval("kinds", 2), interval("kinds", 3))
    printf "== sure\nis below 1 in %d scenes by mse8, %d by relmse, %d by 8x8; above 1 in %d, %d, %d.\n", better[1], \
        better[2], better[3], worse[1], worse[2], worse[3]
    answers("**all**", "")
    print "== median\n" row("median")
    for (j = 1; j < kinds; j++) printf "== worst-%s\n%s\n", order[j], worst_of(order[j])
    printf "== data\n%s", data
    if (mean && mean_of("**all**", 1) > mean) {
        bad = 1
        print "structures: mean " mean_of("**all**", 1) >"/dev/stderr"
    }
    exit bad
}

# equal.awk, after better.awk and runs.awk: sections of doc/measured from the runs of `asbdpt-lab family`, of the last
# group; all is over the better of bdpt and pt, unless it is said. table, a line for each scene; data, lines of a
# figure, "SCENE MSE8 LOW HIGH 8x8"; row and worst, see better.awk; median, the row of medians over seeds; sure, of
# how many losses intervals tell. With -v say=SCENE, SCENE: its mse8 over bdpt. With -v but=, names of scenes: rest,
# the means without them, with -v kinds= also rest-row, and typical, the median over scenes by mse8. Of groups NAME.16
# and NAME.64: sizes, the same by scenes; first-row and first-worst of the first. With -v kinds=, a file of scenes and
# their kinds: kinds, the means of each; unseen-row and unseen-worst, of the scenes that nothing was chosen on. With
# -v runners=, runners.txt: tracer, guided, light: the means by mse8 of the scenes that all seeds render by a path
# tracer, of these by the runner `guided` of older versions, if there are any, and of the others.
BEGIN {
    while (kinds != "" && (getline line < kinds) > 0) { split(line, part, " "); kind[part[1]] = part[2] }
    while (runners != "" && (getline line < runners) > 0)
        if (line ~ /^\| others \| [^ ]+ \|( guided| plain| path_tracer| one_point)+ \|$/) {
            split(line, part, " ")
            tracer[part[4]] = line ~ /plain|path_tracer|one_point/ ? "other" : "guided"
        }
    split(but, part, " ")
    for (i in part) left_out[part[i]]
}
# ends: a ratio and its interval, in up to three digits.
function ends(g, l, other, s, k,    v, by) {
    v = ratio(g, l, other, s, k)
    if (v < 0.0005) return v <= 0 ? "-" : "below 0.0005"
    by = factor(g, l, other, s, k)
    return digits(v) (by ? " [" digits(v / by) ", " digits(v * by) "]" : "")
}
function table(g,    i, k, s, v) {
    print "== table\n| scene | `pt` over `bdpt`, mse8 | mse8 | relmse | 8x8 | marked |\n|---|---:|---:|---:|---:|---|"
    for (i = 1; i <= scenes[g]; i++) {
        s = scene[g, i]; v = ratio(g, "pt", "bdpt", s, 1)
        printf "| %s | %s |", s, (v > 0 ? digits(v) : "-")
        for (k = 1; k <= 3; k++) {
            v = ends(g, "subspaces", the_better(g, s, k), s, k)
            printf(loses(over_better(g, s, k)) ? " **%s** |" : " %s |", v)
        }
        print " " marked(g, s) (marked(g, s) ? " " : "") "|"
    }
    printf "| **geometric mean** | |"
    for (k = 1; k <= 3; k++) printf " %s |", interval("all", k)
    print " |"
}
function data(g,    i, s, by, blocks) {
    print "== data"
    for (i = 1; i <= scenes[g]; i++) if ((v = over_better(g, s = scene[g, i], 1)) > 0) {
        by = factor(g, "subspaces", the_better(g, s, 1), s, 1); if (!by) by = 1
        blocks = over_better(g, s, 3)
        printf "%s %.3f %.3f %.3f %s\n", s, v, v / by, v * by, (blocks > 0 ? sprintf("%.4f", blocks) : "-")
    }
}
function sizes(a, b,    i, f, k, v, g) {
    print "== sizes\n| scene | 16: mse8 | relmse | 8x8 | 64: mse8 | relmse | 8x8 |\n|---|---:|---:|---:|---:|---:|---:|"
    for (i = 1; i <= scenes[b]; i++) {
        printf "| %s |", scene[b, i]
        for (f = 1; f <= 2; f++) for (k = 1; k <= 3; k++) {
            v = over_better(f == 1 ? a : b, scene[b, i], k)
            printf(v <= 0 ? " **-** |" : loses(v) ? " **%.2f** |" : " %.2f |", v)
        }
        take_scene("first", a, scene[b, i])
        print ""
    }
    printf "| **geometric mean** |"
    for (k = 1; k <= 6; k++) printf " %.2f |", mean_of(k < 4 ? "first" : "all", (k - 1) % 3 + 1)
    print ""
    answers("first", "first-")
}
# typical: the median over scenes by mse8, of all or of those that nothing was chosen on.
function typical(g, only,    i, n, v, x) {
    for (i = 1; i <= scenes[g]; i++)
        if ((v = over_better(g, scene[g, i], 1)) > 0 && (!only || scene[g, i] in unseen)) x[++n] = v
    return median_of(x, n)
}
END {
    g = group[groups]
    if (!scenes[g]) exit 1
    for (i = 1; i <= scenes[g]; i++) {
        s = scene[g, i]; k = kind[s]
        if (k != "" && !count[k]++) order[++kinds_there] = k
        take_scene("all", g, s)
        take_scene(k, g, s)
        if (s in unseen) take_scene("unseen", g, s)
        if (!(s in left_out)) take_scene("rest", g, s)
        take_scene(s in tracer ? "tracer" : "light", g, s)
        if (tracer[s] == "guided") take_scene("guided", g, s)
        for (k = 1; k <= 3; k++) {
            take("median", k, over_median(g, s, k))
            if (!loses(over_better(g, s, k))) continue
            by = factor(g, "subspaces", the_better(g, s, k), s, k)
            sure += by && over_better(g, s, k) > by
        }
    }
    table(g)
    data(g)
    answers("all", "")
    print "== median\n" row("median")
    printf "== sure\n%d of %d losses\n", sure, above["all", 1] + above["all", 2] + above["all", 3]
    if (say != "") {
        by = factor(g, "subspaces", "bdpt", say, 1); v = ratio(g, "subspaces", "bdpt", say, 1)
        printf "== %s\n%.3f [%.3f, %.3f]\n", say, v, v / by, v * by
    }
    if (but != "") printf "== rest\n%s\n", means_of("rest")
    if (but != "" && kinds != "") {
        print "== rest-row\n" row("rest")
        printf "== typical\n%.2f, of those not used for tuning %.2f\n", typical(g, 0), typical(g, 1)
    }
    if (groups == 2) sizes(group[1], group[2])
    if (kinds != "") answers("unseen", "unseen-")
    if (number["tracer", 1]) printf "== tracer\n%.2f\n", mean_of("tracer", 1)
    if (number["guided", 1]) printf "== guided\n%.2f\n", mean_of("guided", 1)
    if (number["tracer", 1]) printf "== light\n%.2f\n", mean_of("light", 1)
    if (kinds_there) print "== kinds\n| scenes | number | mse8 | relmse | 8x8 |\n|---|---:|---:|---:|---:|"
    for (k = 1; k <= kinds_there; k++) printf "| %s | %d | %s | %s | %s |\n", order[k], count[order[k]],
        interval(order[k], 1), interval(order[k], 2), interval(order[k], 3)
}

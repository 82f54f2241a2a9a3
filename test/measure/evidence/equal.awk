# equal.awk, after better.awk and runs.awk: sections of doc/measured from the runs of `asbdpt-lab family`, of the last
# group; all is over the better of bdpt and pt, unless it is said. table, a line for each scene; row and worst, see
# better.awk; median, the row of medians over seeds; sure, of how many losses intervals tell. With -v say=SCENE, SCENE:
# its mse8 over bdpt. With -v but=, a scene: rest, the means without it. Of groups NAME.16 and NAME.64: sizes, the same
# by scenes; first-row and first-worst of the first.
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
END {
    g = group[groups]
    if (!scenes[g]) exit 1
    for (i = 1; i <= scenes[g]; i++) {
        s = scene[g, i]
        take_scene("all", g, s)
        if (s != but) take_scene("rest", g, s)
        for (k = 1; k <= 3; k++) {
            take("median", k, over_median(g, s, k))
            if (!loses(over_better(g, s, k))) continue
            by = factor(g, "subspaces", the_better(g, s, k), s, k)
            sure += by && over_better(g, s, k) > by
        }
    }
    table(g)
    answers("all", "")
    print "== median\n" row("median")
    printf "== sure\n%d of %d losses\n", sure, above["all", 1] + above["all", 2] + above["all", 3]
    if (say != "") {
        by = factor(g, "subspaces", "bdpt", say, 1); v = ratio(g, "subspaces", "bdpt", say, 1)
        printf "== %s\n%.3f [%.3f, %.3f]\n", say, v, v / by, v * by
    }
    if (but != "") printf "== rest\n%s\n", means_of("rest")
    if (groups == 2) sizes(group[1], group[2])
}

# equal.awk, after better.awk: sections of doc/measured from family.md of `asbdpt-lab family`, where the default is
# called subspaces; all is over the better of bdpt and pt, unless it is said. Of the last file: table, a line for each
# scene; data, lines of a figure, "SCENE MSE8 LOW HIGH 8x8"; row and worst, see better.awk. With -v say=SCENE, SCENE:
# its mse8 over bdpt. With -v but=, names of scenes: rest, the means without them, with -v kinds= also rest-row,
# and typical, the median over scenes by mse8. Of two files, with 16 and 64 samples: sizes, the same by
# scenes; first-row and first-worst of the first. With -v kinds=, a file of scenes and their kinds: kinds, the means of
# each; unseen-row and unseen-worst, of the scenes that nothing was chosen on. With -v runners=, runners.txt: light, the
# mean of the scenes that not all seeds render by a path tracer.
BEGIN {
    while (kinds != "" && (getline < kinds) > 0) kind[$1] = $2
    if (kinds != "") { close(kinds); unseen_scenes(kinds, unseen) }
    while (runners != "" && (getline < runners) > 0)
        if (/^\| others \| [^ ]+ \|( guided| plain)+ \|$/) { tracer[$4]; traced++ }
    split(but, part, " ")
    for (i in part) left_out[part[i]]
    split("mse8 relmse 8x8", name, " ")
}
FNR == 1 { file++; measure = "" }
/^(mse8|relmse|8x8): squared/ { measure = $1; sub(/:/, "", measure) }
/^\| method \|/ && measure != "" {
    n = split($0, scene, / *\| */) - 3
    for (i = 1; i <= n; i++) {
        scene[i] = scene[i + 2]
        first_marked[i] = scene[i] ~ /\(bdpt: /
        sub(/,.*/, "", scene[i])
    }
}
/^\| (pt|subspaces) \|/ && measure != "" {
    m = split($0, c, / *\| */)
    for (i = 3; i < m; i++) value[file, c[2], measure, i - 2] = c[i]
}
function over(f, m, i) { return over_better(value[f, "subspaces", m, i], value[f, "pt", m, i]) } # 0: not known
# ends: the mean and the interval, that over bdpt scaled, in up to three digits.
function ends(m, i,    v, part, by) {
    v = over(file, m, i)
    if (v <= 0) return "-"
    split(value[file, "subspaces", m, i], part, /[][, ]+/)
    by = v / least(part[1])
    return digits(v) " [" digits(by * least(part[2])) ", " digits(by * least(part[3])) "]"
}
function digits(v) { return v < 0.0995 ? sprintf("%.3f", v) : two(v) }
# marked: which methods have a mark.
function marked(i,    text) {
    if (first_marked[i]) text = "`bdpt`"
    if (value[file, "pt", "mse8", i] ~ /[a-z]/) text = text (text ? ", " : "") "`pt`"
    if (value[file, "subspaces", "mse8", i] ~ /[a-z]/) text = text (text ? ", " : "") "`asbdpt`"
    return text ~ /bdpt.*pt.*asbdpt/ ? "all" : text
}
function table(    i, m, v) {
    print "== table\n| scene | `pt` over `bdpt`, mse8 | mse8 | relmse | 8x8 | marked |\n|---|---:|---:|---:|---:|---|"
    for (i = 1; i <= n; i++) {
        v = value[file, "pt", "mse8", i]
        printf "| %s | %s |", scene[i], (v ~ /^[0-9]/ ? digits(least(v)) : "-")
        for (m = 1; m <= 3; m++) printf((over(file, name[m], i) > 1 ? " **%s** |" : " %s |"), ends(name[m], i))
        print " " marked(i) (marked(i) ? " " : "") "|"
    }
    printf "| **geometric mean** | |"
    for (m = 1; m <= 3; m++) printf " %s |", interval("all", m)
    print " |"
}
function data(    i, part, b) {
    print "== data"
    for (i = 1; i <= n; i++) if (over(file, "mse8", i) > 0) {
        split(value[file, "subspaces", "mse8", i], part, /[][, ]+/)
        b = over(file, "mse8", i) / least(part[1])
        printf "%s %.3f %.3f %.3f %s\n", scene[i], b * least(part[1]), b * part[2], b * part[3],
            (over(file, "8x8", i) > 0 ? sprintf("%.3f", over(file, "8x8", i)) : "-")
    }
}
function sizes(    i, f, m, q) {
    print "== sizes\n| scene | 16: mse8 | relmse | 8x8 | 64: mse8 | relmse | 8x8 |\n|---|---:|---:|---:|---:|---:|---:|"
    for (i = 1; i <= n; i++) {
        printf "| %s |", scene[i]
        for (f = 1; f <= 2; f++) for (m = 1; m <= 3; m++) {
            q = over(f, name[m], i)
            if (f == 1) take("first", m, q)
            printf((q > 0 ? (q > 1 ? " **%.2f** |" : " %.2f |") : " **-** |"), q)
        }
        print ""
    }
    printf "| **geometric mean** |"
    for (m = 1; m <= 6; m++) printf(" %.2f |", (m < 4 ? mean_of("first", m) : mean_of("all", m - 3)))
    print ""
}
# typical: the median over scenes by mse8, of all or of those that nothing was chosen on.
function typical(only,    i, k, v, x) {
    for (i = 1; i <= n; i++)
        if ((v = over(file, "mse8", i)) > 0 && (!only || scene[i] in unseen)) x[++k] = v
    return median_of(x, k)
}
END {
    if (!n) exit 1
    for (i = 1; i <= n; i++) {
        k = kind[scene[i]]
        if (k != "" && !count[k]++) order[++groups] = k
        for (m = 1; m <= 3; m++) {
            v = over(file, name[m], i)
            take("all", m, v)
            take(k, m, v)
            if (scene[i] in unseen) take("unseen", m, v)
            if (!(scene[i] in tracer)) take("light", m, v)
            if (!(scene[i] in left_out)) take("rest", m, v)
        }
    }
    table()
    data()
    answers("all", "")
    for (i = 1; i <= n; i++) if (scene[i] == say) printf "== %s\n%s\n", say, value[file, "subspaces", "mse8", i]
    if (but != "") printf "== rest\n%s\n", means_of("rest")
    if (but != "" && kinds != "")
        printf "== rest-row\n%s\n== typical\n%.2f, of those not used for tuning %.2f\n", row("rest"), typical(0), typical(1)
    if (file > 1) { sizes(); answers("first", "first-") }
    if (kinds != "") answers("unseen", "unseen-")
    if (traced) printf "== light\n%.2f\n", mean_of("light", 1)
    if (groups) print "== kinds\n| scenes | number | mse8 | relmse | 8x8 |\n|---|---:|---:|---:|---:|"
    for (k = 1; k <= groups; k++) printf "| %s | %d | %s | %s | %s |\n", order[k], count[order[k]], interval(order[k], 1),
        interval(order[k], 2), interval(order[k], 3)
}

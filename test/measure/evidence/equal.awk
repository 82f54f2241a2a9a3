# equal.awk, after better.awk: sections of doc/measured from family.md of `asbdpt-lab family`, where the default is
# called subspaces. Of the last file: table, a row for each scene; mean: that alone; without: the mean without the best
# scene; better-... and losses-..., see better.awk. Of two files, with 16 and 64 samples: sizes, the same by scenes, a
# line where learning left no time for a sample; and first-better-..., first-losses-... of the first. With -v kinds=,
# a file of scenes and their kinds, a section for each kind: both means; and halves, of the scenes that nothing was
# chosen on, every second of the file from the first, and of the others. With -v runners=, runners.txt, light: the mean
# of the scenes that not all seeds render by a path tracer.
BEGIN {
    while (kinds != "" && (getline < kinds) > 0) {
        kind[$1] = $2
        if (!/^#/) half[$1] = ++rows % 2 ? "not used for tuning" : "used for tuning"
    }
    while (runners != "" && (getline < runners) > 0)
        if (/^\| others \| [^ ]+ \|( guided| plain)+ \|$/) { tracer[$4]; traced++ }
}
function halves(    h, of) {
    print "== halves\n| scenes | number | mse8 | worst | above 1 | relmse | worst | above 1 | 8x8 | worst | above 1 |"
    print "|---|---:|---:|---|---:|---:|---|---:|---:|---|---:|"
    for (h = split("not used for tuning;used for tuning", of, ";"); h >= 1; h--)
        print "| " of[3 - h] " | " number[of[3 - h], 1] " |" cells(of[3 - h], 1)
}
function cell(method, m, i) { return value[file, method, m, i] }
# What the default of a file makes of the better one in a scene; 0: not known.
function over(f, m, i) { return over_better(value[f, "subspaces", m, i], value[f, "pt", m, i]) }
FNR == 1 { file++; measure = "" }
/^(mse8|relmse|8x8): squared/ { measure = $1; sub(/:/, "", measure) }
/^\| method \|.*price/ { measure = "summary" }
measure == "" { next }
/^\| method \|/ && measure != "summary" {
    n = split($0, scene, / *\| */) - 3
    for (i = 1; i <= n; i++) {
        scene[i] = scene[i + 2]
        sub(/,.*/, "", scene[i])
    }
}
/^\| (pt|subspaces) \|/ {
    m = split($0, c, / *\| */)
    for (i = 3; i < m; i++) value[file, c[2], measure, i - (measure == "summary" ? 0 : 2)] = c[i]
}
function sizes(    i, f, m, q, line, mean, sum, count) {
    print "== sizes\n| scene | 16: mse8 | relmse | 8x8 | 64: mse8 | relmse | 8x8 |"
    print "|---|---:|---:|---:|---:|---:|---:|"
    mean = "| **geometric mean** |"
    for (i = 1; i <= n; i++) {
        line = "| " scene[i] " |"
        for (f = 1; f <= 2; f++) for (m = 1; m <= 3; m++) {
            q = over(f, name[m], i)
            if (q > 0) { sum[f, m] += log(q); count[f, m]++ }
            if (f == 1) take("first", m, scene[i], q)
            line = line (q > 0 ? sprintf(q > 1 ? " **%.2f** |" : " %.2f |", q) : " **-** |")
        }
        print line
    }
    for (f = 1; f <= 2; f++) for (m = 1; m <= 3; m++) mean = mean sprintf(" %.2f |", exp(sum[f, m] / count[f, m]))
    print mean
}
# without: the mean over the better without the scene that is best by relmse.
function without(m,    v) {
    v = over(file, name[m], best)
    return exp((logs["all", m] - (v > 0 ? log(v) : 0)) / (number["all", m] - (v > 0)))
}
# rest: of a kind of scenes, by relmse and 8x8, all and without the two that are worst by relmse.
function rest(k,    i, j, m, worst, sum, left) {
    for (i = 1; i <= n; i++) if (kind[scene[i]] == k) {
        j = over(file, "relmse", i) > (worst[1] ? over(file, "relmse", worst[1]) : 0) ? 1 : \
            over(file, "relmse", i) > (worst[2] ? over(file, "relmse", worst[2]) : 0) ? 2 : 0
        if (j == 1) worst[2] = worst[1]
        if (j) worst[j] = i
    }
    for (m = 2; m <= 3; m++) {
        sum[m] = logs[k, m]; left[m] = number[k, m]
        for (j = 1; j <= 2; j++) { sum[m] -= log(over(file, name[m], worst[j])); left[m]-- }
    }
    printf "== %s-rest\n%s (relmse) and %s (8x8); without `%s` and `%s`, the worst by relmse, %s and %s\n", k,
        two(mean_of(k, 2)), two(mean_of(k, 3)), scene[worst[1]], scene[worst[2]], two(exp(sum[2] / left[2])),
        two(exp(sum[3] / left[3]))
}
END {
    if (!n) exit 1
    split("mse8 relmse 8x8", name, " ")
    print "== table\n| scene | pt, mse8 | asbdpt, mse8 | asbdpt, relmse | asbdpt, 8x8 |\n|---|---:|---:|---:|---:|"
    best = 1
    for (i = 1; i <= n; i++) {
        print "| " scene[i] " | " cell("pt", "mse8", i) " | " cell("subspaces", "mse8", i) " | " \
            cell("subspaces", "relmse", i) " | " cell("subspaces", "8x8", i) " |"
        k = kind[scene[i]]; count[k]++
        q[i] = cell("subspaces", "mse8", i) ~ /^[0-9]/ ? least(cell("subspaces", "mse8", i)) : 0
        if (q[i] > 0 && (!q[best] || q[i] < q[best])) best = i
        take("bdpt", 1, scene[i], q[i])
        take("bdpt " k, 1, scene[i], q[i])
        for (m = 1; m <= 3; m++) {
            take("all", m, scene[i], over(file, name[m], i))
            take(k, m, scene[i], over(file, name[m], i))
            take(half[scene[i]], m, scene[i], over(file, name[m], i))
            if (!(scene[i] in tracer)) take("light", m, scene[i], over(file, name[m], i))
        }
    }
    print "| **geometric mean** | " cell("pt", "summary", 4) " | " cell("subspaces", "summary", 4) " | " \
        cell("subspaces", "summary", 5) " | " cell("subspaces", "summary", 6) " |"
    printf "== mean\n%s\n== without\n%.2f without `%s`\n", interval("bdpt", 1), \
        exp((logs["bdpt", 1] - log(q[best])) / (number["bdpt", 1] - 1)), scene[best]
    for (i = best = 1; i <= n; i++) if (over(file, "relmse", i) > 0 && over(file, "relmse", i) < over(file, "relmse", best)) best = i
    printf "== without-relmse\n%s (relmse) and %s (8x8) without `%s`\n", two(without(2)), two(without(3)), scene[best]
    answers("all", "")
    if (file > 1) { sizes(); answers("first", "first-") }
    if (rows) halves()
    if (traced) printf "== light\n%.2f\n", mean_of("light", 1)
    if (rows) printf "== unseen\n%s (mse8), %s (relmse) and %s (8x8)\n", two(mean_of("not used for tuning", 1)),
        two(mean_of("not used for tuning", 2)), two(mean_of("not used for tuning", 3))
    for (k in count) if (k != "" && number[k, 2] > 3) rest(k)
    for (k in count) if (k != "") printf "== %s\n%.2f (%.2f with the better of `bdpt` and `pt`; %d scenes)\n", k,
        mean_of("bdpt " k, 1), mean_of(k, 1), number[k, 1]
}

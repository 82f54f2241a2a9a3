# equal.awk, after better.awk: sections of doc/measured from family.md of `asbdpt-lab family`, where the default is
# called subspaces. Of the last file: table, a row for each scene; mean: that alone; without: the mean without the best
# scene; without-relmse: those over the better without the best by relmse; better-..., losses-... and worst, see
# better.awk. With -v say=SCENE, SCENE: mse8 over bdpt. Of two files, with 16 and 64 samples: sizes, the same by scenes, a
# line where learning left no time for a sample; and first-better-..., first-losses-... of the first. With -v kinds=,
# a file of scenes and their kinds, data, lines of the figure, and a section for each kind: both means; KIND-rest, without its two worst scenes; and
# halves, of the scenes that nothing was chosen on, every second of the file from the first, and of the others; of the
# first unseen-MEASURE and unseen-rest, without its worst scene by relmse. With -v runners=, runners.txt, light: the mean
# of the scenes that not all seeds render by a path tracer.
BEGIN {
    while (kinds != "" && (getline < kinds) > 0) {
        kind[$1] = $2
        if (!/^#/) { half[$1] = "used for tuning"; rows++ }
    }
    if (rows) { close(kinds); unseen_scenes(kinds, unseen) }
    for (s in unseen) half[s] = "not used for tuning"
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
# mean_but: of a group over the better, without scenes i and j (0: none), in two digits.
function mean_but(group, m, i, j,    v, w) {
    v = over(file, name[m], i); w = j ? over(file, name[m], j) : 0
    return two(exp((logs[group, m] - (v > 0 ? log(v) : 0) - (w > 0 ? log(w) : 0)) / \
        (number[group, m] - (v > 0) - (w > 0))))
}
# rest: of a kind of scenes, by relmse and 8x8, all and without the two that are worst by relmse.
function rest(k,    i, v, worst, next_worst) {
    for (i = 1; i <= n; i++) if (kind[scene[i]] == k && (v = over(file, "relmse", i)) > 0) {
        if (!worst || v > over(file, "relmse", worst)) { next_worst = worst; worst = i }
        else if (!next_worst || v > over(file, "relmse", next_worst)) next_worst = i
    }
    printf "== %s-rest\n%s (relmse) and %s (8x8); without `%s` and `%s`, the worst by relmse, %s and %s\n", k,
        two(mean_of(k, 2)), two(mean_of(k, 3)), scene[worst], scene[next_worst], mean_but(k, 2, worst, next_worst),
        mean_but(k, 3, worst, next_worst)
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
    for (i = 1; i <= n; i++) if (scene[i] == say) printf "== %s\n%s\n", say, cell("subspaces", "mse8", i)
    best = 0
    for (i = 1; i <= n; i++)
        if ((v = over(file, "relmse", i)) > 0 && (!best || v < over(file, "relmse", best))) best = i
    printf "== without-relmse\n%s (relmse) and %s (8x8) without `%s`\n", mean_but("all", 2, best),
        mean_but("all", 3, best), scene[best]
    answers("all", "")
    if (rows) {
        print "== data" # SCENE, mse8 and its ends over the better one, 8x8 or -
        for (i = 1; i <= n; i++) if (q[i] > 0) {
            split(cell("subspaces", "mse8", i), ends, /[][, ]+/)
            w = over(file, "mse8", i) / least(ends[1])
            printf "%s %.3f %.3f %.3f %s\n", scene[i], w * least(ends[1]), w * ends[2], w * ends[3], \
                (over(file, "8x8", i) > 0 ? sprintf("%.3f", over(file, "8x8", i)) : "-")
        }
    }
    if (file > 1) { sizes(); answers("first", "first-") }
    if (rows) halves()
    if (traced) printf "== light\n%.2f\n", mean_of("light", 1)
    if (rows) {
        k = "not used for tuning"
        for (m = 1; m <= 3; m++) printf "== unseen-%s\n%s\n== unseen-losses-%s\n%d of %d\n", name[m], interval(k, m),
            name[m], above[k, m], number[k, m]
        for (i = 1; i <= n; i++) if (scene[i] == where_most[k, 2]) best = i
        printf "== unseen-rest\n%s (relmse) and %s (8x8) without `%s`\n", mean_but(k, 2, best), mean_but(k, 3, best),
            scene[best]
    }
    for (k in count) if (k != "" && number[k, 2] > 3) rest(k)
    for (k in count) if (k != "") printf "== %s\n%.2f (%.2f with the better of `bdpt` and `pt`; %d scenes)\n", k,
        mean_of("bdpt " k, 1), mean_of(k, 1), number[k, 1]
}

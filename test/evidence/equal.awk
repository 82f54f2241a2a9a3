# equal.awk: sections of doc/measured from equal-time.md of `asbdpt-lab equal-time`, from family.md of `asbdpt-lab
# family`, where the default is called subspaces, or from such a table as it makes itself. table: a row for each scene;
# mean, worst: these two alone; without: the mean without the best scene; better: the mean over the better of bdpt and
# pt, which counts where it has no mark, like "misses light", behind its interval; losses: where that is above 1.
function clean(s) { gsub(/[ *]/, "", s); return s }
function first(s) { sub(/ .*/, "", s); return s }
function add(scene, a, b, c, d) { row[++n] = scene; pt[n] = a; rmse8[n] = b; relmse[n] = c; blocks[n] = d }
function mark(s) { return match(s, /[a-z][a-z ]*$/) ? substr(s, RSTART) : "" }
# The scene with the smallest (sign 1) or largest (sign -1) value.
function end_of(values, sign,    i, at) {
    for (i = 1; i <= n; i++)
        if (values[i] != "-" && (!at || sign * first(values[i]) < sign * first(values[at]))) at = i
    return at ? at : 1
}
/^(rmse8|relmse|8x8): squared/ { measure = $1; sub(/:/, "", measure) }
/^\| method \|.*price/ { summary = 1; next }
/^\| method \|/ { summary = 0; n_scenes = split($0, scene, /\|/); next }
/^\| (pt|asbdpt|subspaces) \|/ {
    sub(/^\| subspaces /, "| asbdpt ")
    split($0, cell, /\|/)
    for (i in cell) gsub(/^ +| +$/, "", cell[i])
    if (summary) {
        mean[cell[2], "rmse8"] = cell[4]; mean[cell[2], "relmse"] = cell[5]; mean[cell[2], "8x8"] = cell[6]
        next
    }
    for (i = 3; i < n_scenes; i++) value[cell[2], measure, i] = cell[i]
}
/^\| [a-z-]+ \|.*\*\*.*\[.*\|$/ { # a row of such a table
    split($0, cell, /\|/)
    for (i in cell) gsub(/^ +| +$|\*/, "", cell[i])
    add(cell[2], cell[3], cell[4], cell[5], cell[6])
}
/^\| \*\*geometric mean\*\*/ {
    split($0, cell, /\|/)
    for (i in cell) gsub(/^ +| +$|\*/, "", cell[i])
    mean["pt", "rmse8"] = cell[3]; mean["asbdpt", "rmse8"] = cell[4]
    mean["asbdpt", "relmse"] = cell[5]; mean["asbdpt", "8x8"] = cell[6]
}
END {
    for (i = 3; i < n_scenes; i++) {
        name = clean(scene[i]); sub(/,.*/, "", name)
        add(name, value["pt", "rmse8", i], value["asbdpt", "rmse8", i], value["asbdpt", "relmse", i],
            value["asbdpt", "8x8", i])
    }
    if (!n) exit 1
    print "== table\n| scene | pt, rmse8 | asbdpt, rmse8 | asbdpt, relmse | asbdpt, 8x8 |\n|---|---:|---:|---:|---:|"
    for (i = 1; i <= n; i++) {
        bold = rmse8[i]
        sub(/^[^ ]+/, "**&**", bold)
        printf "| %s | %s | %s | %s | %s |\n", row[i], pt[i], bold, relmse[i], blocks[i]
    }
    bold = mean["asbdpt", "rmse8"]
    sub(/^[^ ]+/, "**&**", bold)
    printf "| **geometric mean** | %s | %s | %s | %s |\n", mean["pt", "rmse8"], bold, mean["asbdpt", "relmse"],
        mean["asbdpt", "8x8"]
    asbdpt = mean["asbdpt", "rmse8"]
    j = end_of(rmse8, -1)
    worst = first(rmse8[j]) " (`" row[j] "`)"
    printf "== mean\n%s\n== worst\n%s\n", first(asbdpt), worst
    at = end_of(rmse8, 1)
    for (i = 1; i <= n; i++) {
        q = first(rmse8[i]) + 0; p = first(pt[i]) + 0
        q = log(q > 0 ? q : 0.0005); p = mark(pt[i]) != "" ? 0 : log(p > 0 ? p : 0.0005)
        rest += i == at ? 0 : q
        beside += p < 0 ? q - p : q
        if (q > (p < 0 ? p : 0)) losses++
    }
    printf "== without\n%.2f without `%s`\n== better\n%.2f\n== losses\n%d of %d\n", exp(rest / (n - 1)), row[at],
        exp(beside / n), losses, n
}

# structures.awk: asbdpt over the better of bdpt and pt, by mse8, in scenes NUMBER-KIND, from equal-time.md of
# `asbdpt-lab equal-time`. A method with a mark, like "misses light", is no better one. Sections: kinds, a row for each;
# all, in words; data, lines "SCENE RMSE8 LOW HIGH 8x8 LOW HIGH", "-" without a sample.
# With -v worst= and -v mean=: exit status 1 beyond them, or where asbdpt has a mark.
function cell(s, measure, method,    part) { # "VALUE [LOW, HIGH]"
    split(ratio[method, measure, s], part, /[][, ]+/)
    value = part[1]; low = part[2]; high = part[3]
    return value ~ /^[0-9]/
}
function over(s, measure,    by) {
    by = !misses[s] && cell(s, "mse8:", "pt") && (value < 1 || blind[s]) && cell(s, measure, "pt") ? value + 0 : 1
    if (by == 0) by = 0.0005
    return cell(s, measure, "asbdpt") ? sprintf("%.3f %.3f %.3f", value / by, low / by, high / by) : "- - -"
}
function add(kind, k, v) {
    n[kind, k]++
    logs[kind, k] += log(v > 0 ? v : 0.0005)
    if (v > most[kind, k]) most[kind, k] = v
}
function row(kind,    k, text) {
    for (k = 1; k <= 4; k += 3)
        text = text (n[kind, k] ? sprintf(" %.2f | %.2f |", exp(logs[kind, k] / n[kind, k]), most[kind, k]) : \
            " - | - |")
    print "| " kind " | " scenes[kind] " |" text
}
/^(mse8|relmse|8x8): squared/ { measure = $1 }
/^\| method \|/ {
    columns = split($0, name, / *\| */) - 1
    for (i in name) { marked = name[i] ~ /\(bdpt: /; sub(/,.*/, "", name[i]); blind[name[i]] = marked }
}
/^\| (pt|asbdpt) \|/ && measure != "" {
    split($0, c, / *\| */)
    for (i = 3; i <= columns; i++) ratio[c[2], measure, name[i]] = c[i]
}
END {
    for (i = 3; i <= columns; i++) {
        s = name[i]
        misses[s] = ratio["pt", "mse8:", s] ~ /[a-z]/
        missed += misses[s]
        if (ratio["asbdpt", "mse8:", s] ~ /[a-z]/) dark = dark (dark ? ", `" : " in `") s "`"
        line = s " " over(s, "mse8:") " " over(s, "8x8:")
        data = data line "\n"
        kind = s; sub(/^[0-9]+-/, "", kind)
        if (!scenes[kind]++) order[++kinds] = kind
        scenes["**all**"]++
        split(line, part, " ")
        if (part[2] == "-") lost++
        for (k = 1; k <= 4; k += 3)
            if (part[k + 1] != "-") { add(kind, k, part[k + 1] + 0); add("**all**", k, part[k + 1] + 0) }
        if (worst && (part[2] == "-" || part[3] > worst + 0 || ratio["asbdpt", "mse8:", s] ~ /[a-z]/)) {
            bad = 1
            print "structures: " line, ratio["asbdpt", "mse8:", s] >"/dev/stderr"
        }
    }
    if (!n["**all**", 1]) exit 1
    print "== kinds\n| structure | scenes | mean, mse8 | worst | mean, 8x8 | worst |\n|---|---:|---:|---:|---:|---:|"
    for (j = 1; j <= kinds; j++) row(order[j])
    row("**all**")
    print "\n![Squared error of asbdpt over the better of bdpt and pt, in each generated scene](structures.svg)"
    all = exp(logs["**all**", 1] / n["**all**", 1])
    printf "== all\n%.2f of the squared error of the better of `bdpt` and `pt` in the mean, %.2f at worst. ", all,
        most["**all**", 1]
    printf "`pt` misses light in %d, `asbdpt`%s. Learning leaves `asbdpt` no time in %d.\n== data\n%s", missed,
        dark ? dark : " in 0", lost, data
    if (mean && all > mean) { bad = 1; print "structures: mean " all >"/dev/stderr" }
    exit bad
}

# structures.awk, after better.awk: asbdpt over the better of bdpt and pt, by each measure, in scenes NUMBER-KIND, from
# equal-time.md of `asbdpt-lab equal-time`. Sections: kinds, a row for each; all, in words; mean, over bdpt by mse8;
# by-kind, the means over kinds; row and worst, see better.awk; worst-KIND, the worst of it; sure, in how many scenes
# intervals tell; data, lines "SCENE MSE8 LOW HIGH RELMSE LOW HIGH 8x8 LOW HIGH", "-" without a number.
# With -v worst= and -v mean=: exit status 1 beyond them by mse8, or where asbdpt has a mark.
function over(s, measure,    v, part, a) { # and its interval
    a = ratio["asbdpt", measure, s]
    v = over_better(a, ratio["pt", measure, s])
    if (!v) return "- - -"
    split(a, part, /[][, ]+/)
    return sprintf("%.3f %.3f %.3f", v, part[2] * v / least(a), part[3] * v / least(a))
}
/^(mse8|relmse|8x8): squared/ { measure = $1 }
/^\| method \|/ {
    columns = split($0, name, / *\| */) - 1
    if (measure == "mse8:") for (i = 3; i <= columns; i++) first_marked += name[i] ~ /\(bdpt: /
    for (i in name) sub(/,.*/, "", name[i])
}
/^\| (pt|asbdpt) \|/ && measure != "" {
    split($0, c, / *\| */)
    for (i = 3; i <= columns; i++) ratio[c[2], measure, name[i]] = c[i]
}
END {
    for (i = 3; i <= columns; i++) {
        s = name[i]
        take("over bdpt", 1, least(ratio["asbdpt", "mse8:", s]))
        missed += ratio["pt", "mse8:", s] ~ /[a-z]/
        if (ratio["asbdpt", "mse8:", s] ~ /[a-z]/) dark = dark (dark ? ", `" : " in `") s "`"
        line = s " " over(s, "mse8:") " " over(s, "relmse:") " " over(s, "8x8:")
        data = data line "\n"
        kind = s; sub(/^[0-9]+-/, "", kind)
        if (!scenes[kind]++) order[++kinds] = kind
        scenes["**all**"]++
        split(line, part, " ")
        for (m = 1; m <= 3; m++) {
            take(kind, m, part[3 * m - 1] + 0)
            take("**all**", m, part[3 * m - 1] + 0)
            better[m] += part[3 * m + 1] + 0 > 0 && part[3 * m + 1] + 0 < 1
            worse[m] += part[3 * m] + 0 > 1
        }
        if (worst && (part[2] == "-" || part[3] > worst + 0 || ratio["asbdpt", "mse8:", s] ~ /[a-z]/)) {
            bad = 1
            print "structures: " line, ratio["asbdpt", "mse8:", s] >"/dev/stderr"
        }
    }
    if (!number["**all**", 1]) exit 1
    print "== kinds\n| structure | scenes | mse8 | worst | above 1 | relmse | worst | above 1 | 8x8 | worst | above 1 |"
    print "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
    order[++kinds] = "**all**"
    for (j = 1; j <= kinds; j++) print "| " order[j] " | " scenes[order[j]] " |" cells(order[j])
    print "\n![Squared error of asbdpt over the better of bdpt and pt, in each generated scene](structures.svg)"
    print "== all"
    printf "Marks: `bdpt` in %d, `pt` in %d, `asbdpt`%s. No number: by mse8 in %d, by relmse in %d, by 8x8 in %d.\n", \
        first_marked, missed, dark ? dark : " in none", lost["**all**", 1], lost["**all**", 2], lost["**all**", 3]
    print "== mean\n" interval("over bdpt", 1)
    for (j = 1; j < kinds; j++) for (m = 1; m <= 3; m++) take("kinds", m, mean_of(order[j], m))
    printf "== by-kind\n%s (mse8), %s (relmse) and %s (8x8)\n", \
        interval("kinds", 1), interval("kinds", 2), interval("kinds", 3)
    printf "== sure\nis below 1 in %d scenes by mse8, %d by relmse, %d by 8x8; above 1 in %d, %d, %d.\n", better[1], better[2], \
        better[3], worse[1], worse[2], worse[3]
    answers("**all**", "")
    for (j = 1; j < kinds; j++) printf "== worst-%s\n%s\n", order[j], worst_of(order[j])
    printf "== data\n%s", data
    if (mean && mean_of("**all**", 1) > mean) {
        bad = 1
        print "structures: mean " mean_of("**all**", 1) >"/dev/stderr"
    }
    exit bad
}

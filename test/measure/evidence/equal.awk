# equal.awk, after better.awk: tables of asbdpt over the better of bdpt and pt, from runs of `asbdpt-lab family` and
# `equal-time`, NAME.csv. What a run costs is its squared error times the CPU seconds that it took, so that methods need
# not have taken the same time. A group of runs is NAME.HALF, of the column part or half; tables are of the last group.
# Sections: row, means over scenes and the number of losses; table, a line for each scene.
#   -v kinds=yes     for scenes NUMBER-KIND, in place of table: kinds, a row for each; and data, lines "SCENE MSE8 LOW
#                    HIGH RELMSE LOW HIGH 8x8 LOW HIGH". With worst= and mean=: exit status 1 beyond them by mse8, or
#                    where asbdpt misses light
#   two groups       first-row and first-worst, of the first
#   -v missing=FILE  its section unknown has lines "SCENE METHOD MEASURE [GROUP]": squared errors that no number of runs
#                    tells, since the noise of their reference is unknown or larger
BEGIN {
    FS = ","
    split("mse8 relmse relmse8x8", square, " "); split("mse8 relmse 8x8", measure, " ")
    while (missing != "" && (getline line < missing) > 0) {
        if (line ~ /^== /) on = line == "== unknown"
        else if (on) { split(line, part, " "); unknown[named(part[2]), part[1], part[3], part[4]] }
    }
}
function named(label) { return label == "subspaces" ? "asbdpt" : label }
function field(column) { return column in at ? $at[column] : "" }
FNR == 1 {
    split("", at)
    for (i = 1; i <= NF; i++) at[$i] = i
    next
}
{
    g = field("part") != "" ? field("part") : field("half"); l = named(field("label")); s = field("scene")
    if (!(g in first)) { first[g] = l; group[++groups] = g }
    if (!((g, s) in seen)) { seen[g, s]; scene[g, ++scenes[g]] = s }
    i = ++seeds[g, l, s]
    if (l == first[g]) time[g, s, i] = field("price_before") + field("spp") * field("price_each")
    if (time[g, s, i] - field("price_before") < field("price_each")) unaffordable[g, l, s]
    for (k = 1; k <= 3; k++) cost[g, l, s, k, i] = field(square[k]) * field("seconds")
    mark[g, l, s] = field("mark")
}
# mean_cost: of a method in a scene, by measure k. 0: not known.
function mean_cost(g, l, s, k,    i, sum) {
    if ((l, s, measure[k], "") in unknown || (l, s, measure[k], g) in unknown || (g, l, s) in unaffordable) return 0
    for (i = 1; i <= seeds[g, l, s]; i++) sum += cost[g, l, s, k, i]
    return i > 1 && sum > 0 ? sum / (i - 1) : 0
}
# the_better: of bdpt and pt, by measure k.
function the_better(g, s, k,    p) {
    p = mean_cost(g, "pt", s, k)
    if (mark[g, "pt", s] != "" && mark[g, "asbdpt", s] == "") return "bdpt" # pt misses light
    return p > 0 && p < mean_cost(g, "bdpt", s, k) ? "pt" : "bdpt"
}
function ratio(g, l, other, s, k,    b) { # 0: not known
    b = mean_cost(g, other, s, k)
    return b > 0 ? mean_cost(g, l, s, k) / b : 0
}
function over_better(g, s, k) { return ratio(g, "asbdpt", the_better(g, s, k), s, k) }
# factor: what the ends of the 95 % interval of over_better differ from it by: Welch's, on the logarithm, over seeds. 0
# where errors are those to a reference, whose noise runs do not tell.
function factor(g, s, k,    l, u, v, n, dof) {
    l = the_better(g, s, k)
    if (mark[g, first[g], s] != "" || mark[g, "asbdpt", s] != "" || mark[g, l, s] != "") return 0
    u = variance(g, "asbdpt", s, k); v = variance(g, l, s, k); n = seeds[g, "asbdpt", s]
    if (n < 2 || u + v <= 0) return 0
    dof = (u + v) ^ 2 / (u * u / (n - 1) + v * v / (seeds[g, l, s] - 1))
    return exp(student(dof) * sqrt(u + v))
}
function variance(g, l, s, k,    i, m, sum, n) { # of the logarithm of a mean cost
    m = mean_cost(g, l, s, k); n = seeds[g, l, s]
    if (m <= 0) return 0
    for (i = 1; i <= n; i++) sum += (cost[g, l, s, k, i] - m) ^ 2
    return sum / (n - 1) / n / m ^ 2
}
function marked(g, s,    i, who, text) { # which methods miss light
    split("bdpt pt asbdpt", who, " ")
    for (i = 1; i <= 3; i++) if (mark[g, who[i], s] != "") text = text (text ? ", " : "") "`" who[i] "`"
    return text ~ /bdpt.*pt.*asbdpt/ ? "all" : text
}
# take_scene: into a set of ratios, over_better by each measure.
function take_scene(set, g, s,    k) { for (k = 1; k <= 3; k++) take(set, k, over_better(g, s, k)) }
# row: of a set, the means by each measure, and in how many scenes asbdpt has more error.
function row(set,    m, text, losses, of_each, same) {
    same = number[set, 1] == number[set, 2] && number[set, 2] == number[set, 3]
    for (m = 1; m <= 3; m++) {
        text = text interval(set, m) " | "
        losses = losses (m > 1 ? ", " : "") above[set, m] + 0
        of_each = of_each (m > 1 ? ", " : "") above[set, m] + 0 " of " number[set, m]
    }
    return text (same ? losses " of " number[set, 1] : of_each)
}
# ends: a ratio and its interval, in up to three digits.
function ends(g, s, k,    v, by) {
    v = over_better(g, s, k); by = factor(g, s, k)
    if (v < 0.0005) return v <= 0 ? "-" : "below 0.0005"
    return digits(v) (by ? " [" digits(v / by) ", " digits(v * by) "]" : "")
}
function table(g,    i, k, s, v) {
    print "== table\n| scene | `pt` over `bdpt`, mse8 | mse8 | relmse | 8x8 | marked |\n|---|---:|---:|---:|---:|---|"
    for (i = 1; i <= scenes[g]; i++) {
        s = scene[g, i]; v = ratio(g, "pt", "bdpt", s, 1)
        printf "| %s | %s |", s, (v > 0 ? digits(v) : "-")
        for (k = 1; k <= 3; k++) printf(loses(over_better(g, s, k)) ? " **%s** |" : " %s |", ends(g, s, k))
        print " " marked(g, s) (marked(g, s) ? " " : "") "|"
    }
    printf "| **geometric mean** | |"
    for (k = 1; k <= 3; k++) printf " %s |", interval("**all**", k)
    print " |"
}
function table_of_kinds(g,    i, j, k, s, kind, count, order, n) {
    for (i = 1; i <= scenes[g]; i++) {
        kind = scene[g, i]; sub(/^[0-9]+-/, "", kind)
        if (!count[kind]++) order[++n] = kind
        take_scene(kind, g, scene[g, i])
    }
    order[n + 1] = "**all**"; count["**all**"] = scenes[g]
    print "== kinds\n| structure | scenes | mse8 | worst | above 1 | relmse | worst | above 1 | 8x8 | worst | above 1 |"
    print "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
    for (j = 1; j <= n + 1; j++) {
        printf "| %s | %d |", order[j], count[order[j]]
        for (k = 1; k <= 3; k++) printf " %s | %.2f | %d |", interval(order[j], k), most[order[j], k], above[order[j], k]
        print ""
    }
    print "\n![Squared error of asbdpt over the better of bdpt and pt, in each generated scene](structures.svg)\n== data"
    for (i = 1; i <= scenes[g]; i++) {
        s = scene[g, i]
        printf "%s", s
        for (k = 1; k <= 3; k++) {
            v = over_better(g, s, k); by = factor(g, s, k)
            if (!by) by = 1
            if (v > 0) printf " %.3f %.3f %.3f", v, v / by, v * by
            else printf " - - -"
            if (k == 1 && worst && (v <= 0 || v / by > worst || mark[g, "asbdpt", s] != "")) {
                bad = 1
                print "structures: " s, v, mark[g, "asbdpt", s] >"/dev/stderr"
            }
        }
        print ""
    }
    if (mean && mean_of("**all**", 1) > mean) {
        bad = 1
        print "structures: mean " mean_of("**all**", 1) >"/dev/stderr"
    }
}
END {
    g = group[groups]
    if (!scenes[g]) exit 1
    for (i = 1; i <= scenes[g]; i++) take_scene("**all**", g, scene[g, i])
    print "== row\n" row("**all**")
    if (kinds) table_of_kinds(g)
    else table(g)
    if (groups == 2) {
        for (i = 1; i <= scenes[g]; i++) take_scene("first", group[1], scene[g, i])
        printf "== first-row\n%s\n== first-worst\n", row("first")
        printf "%s (mse8), %s (relmse) and %s (8x8)\n", two(most["first", 1]), two(most["first", 2]), two(most["first", 3])
    }
    exit bad
}

# runs.awk, after better.awk: reads the runs of an entry, NAME.csv, and compares methods by them. What a run
# costs is its squared error times the CPU seconds that it took, so that methods need not have taken the same time. A
# group of runs is NAME.HALF, of the file and of the column half ("both" is choice and services; "all" without one) or
# part. With -v missing=FILE its section unknown is read, lines "SCENE METHOD MEASURE": squared errors that no number
# of runs tells, since the noise of their reference is unknown or larger. The default is called asbdpt or subspaces.
BEGIN {
    FS = ","
    split("mse8 relmse relmse8x8", square, " "); split("mse8 relmse 8x8", measure, " ")
    if (missing != "") read_unknown()
}
function read_unknown(    line, on, part) {
    while ((getline line < missing) > 0) {
        if (line ~ /^== /) on = line == "== unknown"
        else if (on) { split(line, part, " "); unknown[named(part[2]), part[1], part[3]] }
    }
}
function named(label) { return label == "asbdpt" ? "subspaces" : label }
function field(column) { return column in at ? $at[column] : "" }
FNR == 1 {
    split("", at)
    for (i = 1; i <= NF; i++) at[$i] = i
    entry = FILENAME; sub(/.*\//, "", entry); sub(/\.csv$/, "", entry)
    next
}
{
    half = field("part") != "" ? field("part") : field("half")
    l = named(field("label")); s = field("scene")
    n = split(half == "both" ? "choice services" : half == "" ? "all" : half, halves, " ")
    for (j = 1; j <= n; j++) {
        g = entry "." halves[j]
        if (!(g in first)) { first[g] = l; group[++groups] = g }
        if (!((g, s) in scene_seen)) { scene_seen[g, s]; scene[g, ++scenes[g]] = s }
        i = ++seeds[g, l, s]
        if (l == first[g]) time[g, s, i] = field("price_before") + field("spp") * field("price_each")
        if (time[g, s, i] - field("price_before") < field("price_each")) unaffordable[g, l, s]
        for (k = 1; k <= 3; k++) cost[g, l, s, k, i] = field(square[k]) * field("seconds")
        mark[g, l, s] = field("mark")
    }
}
# mean_cost: of a method in a scene, by measure k, without one of the seeds (0: of all). 0: not known.
function mean_cost(g, l, s, k, without,    i, sum, n) {
    if ((l, s, measure[k]) in unknown || (g, l, s) in unaffordable) return 0
    for (i = 1; i <= seeds[g, l, s]; i++) if (i != without) { sum += cost[g, l, s, k, i]; n++ }
    return n && sum > 0 ? sum / n : 0
}
function median_cost(g, l, s, k,    i, x) {
    for (i = 1; i <= seeds[g, l, s]; i++) x[i] = cost[g, l, s, k, i]
    return median_of(x, seeds[g, l, s])
}
function counts(g, s) { return mark[g, "pt", s] == "" || mark[g, "subspaces", s] != "" } # does pt?
# the_better: of bdpt and pt, by measure k.
function the_better(g, s, k, without,    p) {
    p = mean_cost(g, "pt", s, k, without)
    return counts(g, s) && p > 0 && p < mean_cost(g, "bdpt", s, k, without) ? "pt" : "bdpt"
}
function ratio(g, l, other, s, k, without,    a, b) { # 0: not known
    a = mean_cost(g, l, s, k, without); b = mean_cost(g, other, s, k, without)
    return b > 0 ? a / b : 0
}
function over_better(g, s, k, without) {
    return ratio(g, "subspaces", the_better(g, s, k, without), s, k, without)
}
# over_median: the same with the median of each method's seeds.
function over_median(g, s, k,    a, b, p) {
    a = median_cost(g, "subspaces", s, k); b = median_cost(g, "bdpt", s, k); p = median_cost(g, "pt", s, k)
    if (a <= 0 || b <= 0 || over_better(g, s, k) <= 0) return 0
    return a / (counts(g, s) && p > 0 && p < b ? p : b)
}
# spread: the least and the largest over_better, of all seeds and as each is left out: "1.0, 1.4".
function spread(g, s, k,    i, v, low, high) {
    for (i = 0; i <= seeds[g, "subspaces", s]; i++) {
        if ((v = over_better(g, s, k, i)) <= 0) continue
        if (!i || v < low) low = v
        if (!i || v > high) high = v
    }
    return two(low) ", " two(high)
}
# factor: what the ends of the 95 % interval of a ratio differ from it by: Welch's, on the logarithm, over seeds. 0
# where errors are those to a reference, whose noise runs do not tell.
function factor(g, l, other, s, k,    u, v, n, dof) {
    if (mark[g, first[g], s] != "" || mark[g, l, s] != "" || mark[g, other, s] != "") return 0
    u = variance(g, l, s, k); v = variance(g, other, s, k); n = seeds[g, l, s]
    if (n < 2 || u + v <= 0) return 0
    dof = (u + v) ^ 2 / (u * u / (n - 1) + v * v / (seeds[g, other, s] - 1))
    return exp(student(dof) * sqrt(u + v))
}
function variance(g, l, s, k,    i, m, sum, n) { # of the logarithm of a mean cost
    m = mean_cost(g, l, s, k); n = seeds[g, l, s]
    if (m <= 0) return 0
    for (i = 1; i <= n; i++) sum += (cost[g, l, s, k, i] - m) ^ 2
    return sum / (n - 1) / n / m ^ 2
}
function marked(g, s,    l, i, who, text) { # which methods have a mark
    split("bdpt pt subspaces", who, " ")
    for (i = 1; i <= 3; i++) if (mark[g, who[i], s] != "") {
        l = who[i] == "subspaces" ? "asbdpt" : who[i]
        text = text (text ? ", " : "") "`" l "`"
    }
    return text ~ /bdpt.*pt.*asbdpt/ ? "all" : text
}
# take_scene: into a set of ratios, the default over the better in a scene of a group, by each measure.
function take_scene(set, g, s,    k) { for (k = 1; k <= 3; k++) take(set, k, over_better(g, s, k), g SUBSEP s) }
# worst_of: of a set, by each measure, in words; with its range as each seed is left out.
function worst_of(set) { return three(worst_cell(set, 1), worst_cell(set, 2), worst_cell(set, 3)) }
function worst_cell(set, m,    part) {
    if (!number[set, m]) return "-"
    split(worst_name[set, m], part, SUBSEP)
    return two(most[set, m]) (part[2] != "" ? " [" spread(part[1], part[2], m) "]" : "")
}
# answers: of a set the sections row and worst, their names after `before`.
function answers(set, before) { printf "== %srow\n%s\n== %sworst\n%s\n", before, row(set), before, worst_of(set) }

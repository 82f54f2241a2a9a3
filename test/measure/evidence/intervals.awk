# intervals.awk, after better.awk and runs.awk, with -v kinds= (see equal.awk): what 95 % intervals are worth. Of the
# files others.csv, gains.csv, structures.csv: coverage, how often an interval of a mean holds the mean, see
# better.awk. Of family.csv, rivals.csv, choice.csv, over the four rivals by three measures, the tables of leads.awk:
# pairs, how many of all intervals are below 1, and which of these are so by Holm's correction (Scandinavian Journal
# of Statistics 6, 1979), at 5 % for all; pairs-coverage, the coverage of those below 1.
function titled(g) { return g ~ /choice$/ ? "choice alone" : "all techniques" }
function cover(set, k,    v) {
    v = coverage(set, k)
    if (!covered || v < least) least = v
    if (!covered || v > most_held) most_held = v
    if (!covered++ || too_high > most_high) most_high = too_high
}
function shares() {
    return sprintf("%.0f to %.0f %%, and the mean is above it in at most %.1f %%", least, most_held, most_high)
}
function cover_better(name,    g, i, k) {
    g = group[name]
    for (i = 1; i <= scenes[g]; i++) {
        take_scene(name, g, scene[g, i])
        if (g ~ /^others/ && scene[g, i] in unseen) take_scene("unseen", g, scene[g, i])
    }
    for (k = 1; k <= 3; k++) {
        cover(name, k)
        if (g ~ /^others/) cover("unseen", k)
    }
}
function compare(g,    j, k, set) {
    for (j = 1; j <= names; j++) for (k = 1; k <= 3; k++) {
        set = lead(g, rival[j], k, g ~ /^family/)
        p[++all] = student_p(logs[set, k] / number[set, k] / error_of(set, k), number[set, k] - 1)
        text[all] = "over `" rival[j] "` by " measure[k] ", " (g ~ /^family/ ? "this tree, " : "scenes by others, ") \
            titled(g)
        below[all] = mean_of(set, k) * exp(student(number[set, k] - 1) * error_of(set, k)) < 1
        if (!below[all]) continue
        sure++
        cover(set, k)
    }
}
END {
    for (i = 1; i <= groups; i++) if (group[i] ~ /^(others|gains|structures)/) cover_better(i)
    printf "== coverage\n%s\n", shares()
    covered = 0
    for (i = 1; i <= groups; i++) if (group[i] ~ /^(family|rivals|choice)/) compare(group[i])
    for (i = 1; i <= all; i++) sorted[i] = p[i]
    sort(sorted, all)
    for (m = 1; m <= all && sorted[m] <= 0.05 / (all - m + 1); m++) limit = sorted[m]
    for (i = 1; i <= all; i++) if (m > 1 && below[i] && p[i] <= limit) said = said (left++ ? "; " : ": ") text[i]
    printf "== pairs\nin %d of %d cells the interval is below 1. Holm\047s correction at 5 %% leaves %d%s\n", \
        sure, all, left, said
    printf "== pairs-coverage\n%s\n", shares()
}

# leads.awk, after better.awk: of what family.awk prints, section leads: the error of subspaces over that of rivals (-v
# rivals=, four if none are named), geometric means over scenes with their intervals, by the choice alone, if it is
# there, and with all techniques. With -v kinds= (see equal.awk) those of one half in the scenes that nothing was chosen
# on, and without cornell-ri. Then also, by mse8: best, over the best unmarked rival of each scene, which is found on the
# same seeds, so it flatters rivals; unseen-best, the same in the scenes that nothing was chosen on; best-scenes, in how
# many there is one; data, lines of a figure of the latter scenes, "SCENE MSE8 MSE8 MSE8 MSE8" over two rivals.
BEGIN {
    FS = " *[|] *"
    if (kinds != "") unseen_scenes(kinds, unseen)
    names = split(rivals != "" ? rivals : "lvc cbdpt mbdpt spcbpt", rival, " ")
    for (k = 1; k <= names; k++) is_rival[rival[k]]
}
/^== / { split(substr($0, 4), part, "-"); half = part[1]; measure = part[2]; next }
measure !~ /^(mse8|relmse|8x8)$/ { next }
$2 == "method" { for (i = 3; i < NF; i++) { scene[i] = $i; sub(/,.*/, "", scene[i]) } n = NF; there[half] }
$2 == "subspaces" || $2 in is_rival { for (i = 3; i < NF; i++) value[half, measure, $2, i] = $i }
$2 in is_rival { # the least of those without a mark, as one more rival
    for (i = 3; i < NF; i++)
        if ($i ~ /^[0-9]/ && $i !~ /[a-z]/ && (!((half, measure, "best", i) in value) || $i + 0 < value[half, measure, "best", i] + 0))
            value[half, measure, "best", i] = $i
}
# lead: mean and interval over rival r; of all scenes, or of those that nothing was chosen on, without one.
function lead(half, measure, r, all, but,    i, a, b, group) {
    group = half measure r all but
    for (i = 3; i < n; i++) {
        a = value[half, measure, "subspaces", i]; b = value[half, measure, r, i]
        if ((!all && !(scene[i] in unseen)) || scene[i] == but || a !~ /^[0-9]/ || b !~ /^[0-9]/) continue
        take(group, 1, least(a) / least(b))
    }
    return interval(group, 1)
}
function leads(half, r, all) {
    return " " lead(half, "mse8", r, all) " | " lead(half, "relmse", r, all) " | " lead(half, "8x8", r, all) " |"
}
END {
    if (kinds == "") {
        head = "mse8 | relmse | 8x8 |"; line = "---:|---:|---:|"
        if ("choice" in there) { head = "choice alone: " head " all techniques: " head; line = line line }
        print "== leads\n| rival | " head "\n|---|" line
        for (k = 1; k <= names; k++)
            print "| `" rival[k] "` |" ("choice" in there ? leads("choice", rival[k], 1) : "") leads("services", rival[k], 1)
        exit
    }
    h = "services" in there ? "services" : "choice"
    print "== leads\n| rival | mse8 | relmse | 8x8 | without `cornell-ri`: relmse | 8x8 |\n|---|---:|---:|---:|---:|---:|"
    for (k = 1; k <= names; k++)
        print "| `" rival[k] "` |" leads(h, rival[k], 0) " " lead(h, "relmse", rival[k], 0, "cornell-ri") " | " \
            lead(h, "8x8", rival[k], 0, "cornell-ri") " |"
    print "== best\n" lead(h, "mse8", "best", 1)
    print "== unseen-best\n" lead(h, "mse8", "best", 0)
    print "== data"
    for (i = 3; i < n; i++) if (scene[i] in unseen) {
        not_chosen_on++
        a = least(value[h, "mse8", "subspaces", i])
        first = a / least(value[h, "mse8", rival[1], i])
        printf "%s %.3f %.3f %.3f %.3f\n", scene[i], first, first, first, a / least(value[h, "mse8", rival[2], i])
    }
    printf "== best-scenes\n%d of %d and %d of %d\n", number[h "mse8best1", 1], n - 3, number[h "mse8best0", 1], not_chosen_on
}

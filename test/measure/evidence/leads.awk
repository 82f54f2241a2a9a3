# leads.awk, after better.awk: of what family.awk prints, section leads: the error of subspaces over that of four rivals,
# geometric means over scenes with their intervals, by the choice alone and with all techniques. With -v kinds= (see
# equal.awk) those with techniques in the scenes that nothing was chosen on, and without cornell-ri. Then also, by mse8:
# best, over the best rival of each scene, which is found on the same seeds, so it flatters rivals; unseen-best and
# unseen-lvc, over it and over lvc in the scenes that nothing was chosen on.
BEGIN { FS = " *[|] *"; if (kinds != "") unseen_scenes(kinds, unseen) }
/^== / { split(substr($0, 4), part, "-"); half = part[1]; measure = part[2]; next }
measure !~ /^(mse8|relmse|8x8)$/ { next }
$2 == "method" { for (i = 3; i < NF; i++) { scene[i] = $i; sub(/,.*/, "", scene[i]) } n = NF }
$2 ~ /^(subspaces|lvc|cbdpt|mbdpt|spcbpt)$/ { for (i = 3; i < NF; i++) value[half, measure, $2, i] = $i }
$2 ~ /^(lvc|cbdpt|mbdpt|spcbpt)$/ { # the least of those without a mark, as one more rival
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
        take(group, 1, scene[i], least(a) / least(b))
    }
    return interval(group, 1)
}
function leads(half, r, all) {
    return " " lead(half, "mse8", r, all) " | " lead(half, "relmse", r, all) " | " lead(half, "8x8", r, all) " |"
}
END {
    names = split("lvc cbdpt mbdpt spcbpt", rival, " ")
    if (kinds == "") {
        print "== leads\n| rival | choice alone: mse8 | relmse | 8x8 | all techniques: mse8 | relmse | 8x8 |"
        print "|---|---:|---:|---:|---:|---:|---:|"
        for (k = 1; k <= names; k++)
            print "| `" rival[k] "` |" leads("choice", rival[k], 1) leads("services", rival[k], 1)
        exit
    }
    print "== leads\n| rival | mse8 | relmse | 8x8 | without `cornell-ri`: relmse | 8x8 |\n|---|---:|---:|---:|---:|---:|"
    for (k = 1; k <= names; k++)
        print "| `" rival[k] "` |" leads("services", rival[k], 0) " " lead("services", "relmse", rival[k], 0, "cornell-ri") \
            " | " lead("services", "8x8", rival[k], 0, "cornell-ri") " |"
    print "== best\n" lead("services", "mse8", "best", 1)
    print "== unseen-best\n" lead("services", "mse8", "best", 0)
    print "== unseen-lvc\n" interval("servicesmse8lvc0", 1)
}

# leads.awk, after better.awk: of what family.awk prints, section leads: the error of subspaces over that of four rivals,
# geometric means over scenes with their intervals, by the choice alone and with all techniques. With -v kinds= (see
# equal.awk) those with techniques in the scenes that nothing was chosen on, and without cornell-ri.
BEGIN {
    FS = " *[|] *"
    while (kinds != "" && (getline line < kinds) > 0)
        if (line !~ /^#/ && ++rows % 2) { split(line, part, " "); unseen[part[1]] }
}
/^== / { split(substr($0, 4), part, "-"); half = part[1]; measure = part[2]; next }
measure !~ /^(mse8|relmse|8x8)$/ { next }
$2 == "method" { for (i = 3; i < NF; i++) { scene[i] = $i; sub(/,.*/, "", scene[i]) } n = NF }
$2 ~ /^(subspaces|lvc|cbdpt|mbdpt|spcbpt)$/ { for (i = 3; i < NF; i++) value[half, measure, $2, i] = $i }
function lead(half, measure, r, but,    i, a, b, group) {
    group = half measure r but
    for (i = 3; i < n; i++) {
        a = value[half, measure, "subspaces", i]; b = value[half, measure, r, i]
        if ((rows && !(scene[i] in unseen)) || scene[i] == but || a !~ /^[0-9]/ || b !~ /^[0-9]/) continue
        take(group, 1, scene[i], least(a) / least(b))
    }
    return " " interval(group, 1) " |"
}
END {
    names = split("lvc cbdpt mbdpt spcbpt", rival, " ")
    if (rows) print "== leads\n| rival | mse8 | relmse | 8x8 | without `cornell-ri`: relmse | 8x8 |"
    else print "== leads\n| rival | choice alone: mse8 | relmse | 8x8 | all techniques: mse8 | relmse | 8x8 |"
    print rows ? "|---|---:|---:|---:|---:|---:|" : "|---|---:|---:|---:|---:|---:|---:|"
    for (k = 1; k <= names; k++) {
        r = rival[k]; line = "| `" r "` |"
        if (!rows) line = line lead("choice", "mse8", r) lead("choice", "relmse", r) lead("choice", "8x8", r)
        line = line lead("services", "mse8", r) lead("services", "relmse", r) lead("services", "8x8", r)
        if (rows) line = line lead("services", "relmse", r, "cornell-ri") lead("services", "8x8", r, "cornell-ri")
        print line
    }
}

# best.awk, after better.awk: of runs.csv of `asbdpt-lab family`, mse8 of subspaces over that of the best rival of each
# scene, which is found on the same seeds, so it flatters rivals; the same, and over that of lvc, in the scenes that
# nothing was chosen on (-v kinds=, see equal.awk). Sections best, unseen-best and unseen-lvc.
BEGIN {
    FS = ","
    while (kinds != "" && (getline line < kinds) > 0)
        if (line !~ /^#/ && ++rows % 2) { split(line, part, " "); unseen[part[1]] }
}
FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
{
    s = $at["scene"]; l = $at["label"]
    if (!(s in known)) { known[s]; scene[++scenes] = s }
    if (l !~ /^(bdpt|subspaces|lvc|cbdpt|mbdpt|spcbpt)$/) next
    i = ++seeds[l, s]
    if (l == "bdpt") time[s, i] = $at["price_before"] + $at["spp"]
    n = (time[s, i] - $at["price_before"]) / $at["price_each"]
    if (n >= 1) sum[l, s] += $at["mse8"] * $at["spp"] / n
    else short[l, s]
    if ($at["mark"] != "") marked[l, s]
}
function error(l, s) { return (l, s) in short || sum[l, s] <= 0 ? 0 : sum[l, s] }
END {
    rivals = split("lvc cbdpt mbdpt spcbpt", rival, " ")
    for (j = 1; j <= scenes; j++) {
        s = scene[j]; best = 0
        for (r = 1; r <= rivals; r++)
            if (!((rival[r], s) in marked) && (e = error(rival[r], s)) > 0 && (!best || e < best)) best = e
        take("best", 1, s, best > 0 ? error("subspaces", s) / best : 0)
        if (s in unseen) take("unseen", 1, s, best > 0 ? error("subspaces", s) / best : 0)
        e = error("lvc", s)
        if (s in unseen) take("lvc", 1, s, e > 0 ? error("subspaces", s) / e : 0)
    }
    printf "== best\n%s\n== unseen-best\n%s\n== unseen-lvc\n%s\n", interval("best", 1), interval("unseen", 1),
        interval("lvc", 1)
    exit !number["best", 1]
}

# robust.awk, after better.awk: of runs.csv of `asbdpt-lab family` or `equal-time`, what does not depend on single bright
# samples or on prices: median, asbdpt over the better of bdpt and pt, where each method has the median of its seeds in a
# scene; time, the CPU time that asbdpt took over that of bdpt.
BEGIN { FS = "," ; split("mse8 relmse relmse8x8", square, " ") }
FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
{
    s = $at["scene"]; l = $at["label"] == "asbdpt" ? "subspaces" : $at["label"]
    if (!(s in known)) { known[s]; scene[++scenes] = s }
    i = ++seeds[l, s]
    if (l == "bdpt") time[s, i] = $at["price_before"] + $at["spp"]
    afforded = (time[s, i] - $at["price_before"]) / $at["price_each"]
    for (k = 1; k <= 3; k++) error[l, s, k, i] = afforded >= 1 ? $at[square[k]] * $at["spp"] / afforded : -1
    seconds[l, s] += $at["seconds"]
    marked[l, s] = $at["mark"]
}
function floor(v) { return v < 0.0005 ? 0.0005 : v } # as better.awk
function median(l, s, k,    i, x) { # of a method's seeds
    for (i = 1; i <= seeds[l, s]; i++) x[i] = error[l, s, k, i]
    return median_of(x, seeds[l, s])
}
END {
    for (j = 1; j <= scenes; j++) {
        s = scene[j]
        take("time", 1, seconds["subspaces", s] / seconds["bdpt", s])
        for (k = 1; k <= 3; k++) {
            bdpt = median("bdpt", s, k); ours = median("subspaces", s, k) / bdpt; pt = median("pt", s, k) / bdpt
            counts = bdpt > 0 && (marked["pt", s] == "" || marked["subspaces", s] != "") && pt > 0 && pt < 1
            take("median", k, bdpt > 0 && ours > 0 ? floor(ours) / (counts ? floor(pt) : 1) : 0)
        }
    }
    if (!number["median", 1] || !number["median", 2] || !number["median", 3]) exit 1
    print "== median\n" row("median")
    printf "== time\n%.0f %% more CPU time than `bdpt` (at most %.0f %%)\n", 100 * (mean_of("time", 1) - 1),
        100 * (most["time", 1] - 1)
}

# bins.awk: two tables from bins.txt of bins.sh: bias, the mean against the truth; stall,
# rmse8 beside bdpt's, in brackets without the reference's noise. The published ratios are those of the dissertation.
BEGIN {
    noise = 0.6947
    split("1.007 1.11 1.37 1.76 2.25", published, " ")
}
{ rmse8[$1, $2] = $3; mean[$1, $2] = $4 }
function off(name) { return sprintf("%+.1f %%", 100 * (mean[name, 128] - 1)) }
function alone(name, spp,    v) { v = rmse8[name, spp] ^ 2 - noise ^ 2; return v > 0 ? sqrt(v) : 0 }
function cell(name, spp) { return sprintf("%.2f (%.2f)", rmse8[name, spp], alone(name, spp)) }
END {
    if (!(("bdpt", 512) in mean)) exit 1
    print "== bias\n| parameter | mean against the truth | | parameter | mean against the truth |"
    print "|---|---|---|---|---|"
    print "| defaults (8 paths, restart 32, maxage 24) | " off("bins") " | | `binpaths` 2 | " off("binpaths=2") " |"
    print "| `restart` 8 | " off("restart=8") " | | `binpaths` 4 | " off("binpaths=4") " |"
    print "| `restart` 16 | " off("restart=16") " | | `binpaths` 16 | " off("binpaths=16") " |"
    print "| `restart` 64 | " off("restart=64") " | | `binpaths` 32 | " off("binpaths=32") " |"
    print "| `restart` 0 (never) | " off("restart=0") " | | `maxage` 8 | " off("maxage=8") " |"
    print "| `bdpt` | " off("bdpt") " | | `maxage` 0 (never) | " off("maxage=0") " |"
    print "== stall\n| spp | bins | bdpt | ratio | published ratio |\n|---|---|---|---|---|"
    for (i = 1; i <= 5; i++) {
        spp = 16 * 2 ^ i
        printf "| %d | %s | %s | %.2f (%.2f) | %s |\n", spp, cell("bins", spp), cell("bdpt", spp),
            rmse8["bins", spp] / rmse8["bdpt", spp], alone("bins", spp) / alone("bdpt", spp), published[i]
    }
}

# references.awk: the table of doc/evidence.md from ref/NAME.txt.
FNR == 1 { n++ }
$1 == "scene" { name[n] = $2; sub(/.*\//, "", name[n]); sub(/\.pbrt/, "", name[n]); at[name[n]] = n }
$1 == "resolution" { size[n] = $2 }
$1 == "mean_error" { error[n] = $2 }
$1 == "origin" { by[n] = /caustics/ ? " (caustics / caustics:with=asbdpt)" : "" }
$1 == "agreement" {
    for (i = 2; i < NF; i++) {
        if ($i == "tiles") tile[n] = $(i + 1)
        if ($i == "means" && $(i - 1) != "the") means[n] = $(i + 1)
        if ($i == "uniform") uniform[n] = $(i + 1)
    }
    ratio[n] = $(NF - 2) " +- " $NF
}
END {
    if (!n) exit 1
    print "== table\n| scene | size | ratio pt / bdpt | p, means | p, worst tile | p, uniform | error of the mean |"
    print "|---|---|---|---|---|---|---|"
    for (i = 1; i <= n; i++) {
        split(ratio[i], r, " ")
        sub(/[,;]$/, "", tile[i]); sub(/[,;]$/, "", means[i]); sub(/[,;]$/, "", uniform[i])
        printf "| %s | %s | %.5f +- %.5f%s | %s | %s | %s | %.3f %% |\n", name[i], size[i], r[1], r[3], by[i], means[i],
            tile[i], uniform[i], 100 * error[i]
    }
}

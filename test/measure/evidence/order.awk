# order.awk: a section of doc/measured from results.md files of `asbdpt-lab experiment` with bins of both orders
# (bins.c): the error of bins over that of bdpt after the same number of samples, and what its mean is off by.
/^## (cornell|veach|bathroom|living)/ { order[++n] = scene = $2 }
/^\| [0-9]+ \| .*bins/ {
    split($0, part, / *\| */)
    way = part[3] ~ /printed/ ? "printed" : "text"
    ratio[scene, way, part[2]] = part[5]
    if (part[2] + 0 > most + 0) most = part[2]
    off[scene, way] = part[9]
}
END {
    print "== table"
    print "| | u < p_0, 32 samples | u > p_0, 32 | u < p_0, " most " | u > p_0, " most \
        " | mean off by, per cent: u < p_0 | u > p_0 |"
    print "|---|---:|---:|---:|---:|---:|---:|"
    for (i = 1; i <= n; i++) {
        s = order[i]
        print "| " s " | " ratio[s, "text", 32] " | " ratio[s, "printed", 32] " | " ratio[s, "text", most] " | " \
            ratio[s, "printed", most] " | " off[s, "text"] " | " off[s, "printed"] " |"
    }
}

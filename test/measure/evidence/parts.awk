# parts.awk: what each part of the method buys, from tune.md of test/lab/tune.sh: the variants that change the squared
# error by more than 5 per cent, the largest change first.
BEGIN { FS = " *\\| *" }
NF > 10 && $2 != "variant" && $2 !~ /^-/ {
    gsub(/\*/, "", $4)
    change = $4 > 1 ? $4 : 1 / $4
    if (change > 1.05) { row[++n] = "| " $12 " | " $4 " | " $6 " | " $7 " | " $8 " | " $9 " | " $10 " |"; by[n] = change }
}
END {
    print "== parts\n| without a part, or with another constant | mse8 | relmse | 8x8 | CPU time | mse8 x CPU time | worst scene, mse8 |"
    print "|---|---:|---:|---:|---:|---:|---|"
    for (; n > 0 && !done; done = !best) {
        best = 0
        for (i in row) if (!best || by[i] > by[best]) best = i
        if (best) { print row[best]; delete row[best]; delete by[best] }
    }
}

# better.awk: squared error times CPU time of the default over that of the better of bdpt and pt, from runs.txt of
# test/lab/tune.sh with 16 samples and with 64: lines VARIANT SCENE SEED RMSE8 RELMSE BLOCKS SECONDS.
FNR == 1 { file++ }
{
    if (!seen[$2]++) scene[++n] = $2
    k = file SUBSEP $2 SUBSEP $1
    count[k]++; seconds[k] += $7
    sum[k, 1] += $4 * $4; sum[k, 2] += $5; sum[k, 3] += $6
}
function product(f, s, v, m,    k) {
    k = f SUBSEP s SUBSEP v
    return count[k] ? sum[k, m] / count[k] * seconds[k] / count[k] : 0
}
function ratio(f, s, m,    a, b, c, q) {
    a = product(f, s, "as-it-is", m); b = product(f, s, "bdpt", m); c = product(f, s, "pt", m)
    if (!a || !b || !c) return ""
    q = sprintf("%.2f", a / (b < c ? b : c))
    return q > 1 ? "**" q "**" : q
}
END {
    print "== table\n| scene | 16: rmse8 | relmse | blocks | 64: rmse8 | relmse | blocks |"
    print "|---|---:|---:|---:|---:|---:|---:|"
    for (i = 1; i <= n; i++) {
        line = "| " scene[i]
        for (f = 1; f <= 2; f++) for (m = 1; m <= 3; m++) line = line " | " ratio(f, scene[i], m)
        print line " |"
    }
}

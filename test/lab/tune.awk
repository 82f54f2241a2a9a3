# tune.awk: the table of tune.sh, from tune.txt and runs.txt, whatever scenes and seeds are there.
FNR == NR {
    for (i = 4; /^[^-+# \t]/ && i <= NF; i++)
        about[$1] = about[$1] " " $i
    next
}
{
    if (!(($1, $2) in seconds) || $7 < seconds[$1, $2])
        seconds[$1, $2] = $7
    error[$1, $2, $3, 1] = $4 * $4
    error[$1, $2, $3, 2] = $5
    error[$1, $2, $3, 3] = $6
    known[$2]
    seed[$3]
}
END {
    n = split(names, name)
    print "| variant | scenes | mse8 | +- | relmse | blocks | CPU | product | worst | best | |"
    print "|---|---:|---:|---:|---:|---:|---:|---:|---|---|---|"
    for (i = 2; i <= n; i++)
        row(name[i])
}

# Error k of v in scene s beside that of the tree as it is: the mean logarithm over n_seeds that both have; `spread`:
# the variance of that mean.
function worse(v, s, k,    j, e, sum, sum2) {
    n_seeds = 0
    for (j in seed)
        if (error[v, s, j, k] > 0 && error[name[1], s, j, k] > 0) {
            e = log(error[v, s, j, k] / error[name[1], s, j, k])
            sum += e
            sum2 += e * e
            n_seeds++
        }
    spread = n_seeds > 1 ? (sum2 - sum * sum / n_seeds) / (n_seeds - 1) / n_seeds : 0
    return n_seeds > 0 ? sum / n_seeds : 0
}

# Geometric means over scenes, worst and best of the first error; +-: its standard error, by how much the seeds of a
# scene differ.
function row(v,    s, k, e, mean, count, variance, total, worst, best) {
    worst = -99
    best = 99
    for (s in known) {
        for (k = 3; k >= 1; k--) {
            mean[k] += e = worse(v, s, k)
            count[k] += n_seeds > 0
        }
        if (n_seeds == 0)
            continue
        variance += n_seeds > 1 ? spread : 1e9
        total += log(seconds[v, s] / seconds[name[1], s])
        if (e > worst) { worst = e; at_worst = s }
        if (e < best) { best = e; at_best = s }
    }
    for (k = 1; k <= 3; k++)
        mean[k] = count[k] > 0 ? exp(mean[k] / count[k]) : 0
    total = exp(total / count[1])
    printf "| %s | %d | **%.3f** | %s | %.3f | %s | %.2f | %.3f | %.2f %s | %.2f %s |%s |\n", v, count[1], mean[1],
        (variance < 1e9 ? sprintf("%.3f", mean[1] * sqrt(variance) / count[1]) : ""), mean[2],
        (count[3] > 0 ? sprintf("%.3f", mean[3]) : ""), total, mean[1] * total,
        exp(worst), at_worst, exp(best), at_best, about[v]
}

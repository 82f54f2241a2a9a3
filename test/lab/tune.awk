# tune.awk: the table of tune.sh, from tune.txt and runs.txt.
FNR == NR {
    if (/^[^-+# \t]/ && NF > 3) {
        for (i = 4; i <= NF; i++)
            about[$1] = about[$1] " " $i
    }
    next
}
{
    error[$1, $2, $3, 1] = $4 * $4
    error[$1, $2, $3, 2] = $5
    error[$1, $2, $3, 3] = $6
    seconds[$1, $2] = ($1, $2) in seconds && seconds[$1, $2] < $7 ? seconds[$1, $2] : $7
}
END {
    n = split(names, name)
    n_scenes = split(scenes, scene)
    n_seeds = split(seeds, seed)
    print "| variant | rmse8, squared | +- | relmse | in blocks | CPU | rmse8 times CPU | worst | best | |"
    print "|---|---:|---:|---:|---:|---:|---:|---|---|---|"
    for (i = 2; i <= n; i++)
        row(name[i])
}

# How much worse is v than the tree as it is? The mean logarithm over seeds of error k in a scene; `spread`: its square.
function worse(v, s, k,    j, e, sum, sum2) {
    for (j = 1; j <= n_seeds; j++) {
        e = log(error[v, s, seed[j], k] / error[name[1], s, seed[j], k])
        sum += e / n_seeds
        sum2 += e * e / n_seeds
    }
    spread = n_seeds > 1 ? (sum2 - sum * sum) / (n_seeds - 1) : 0
    return sum
}

# Geometric means over scenes; +-: standard error of the first, by how much the seeds of a scene differ.
function row(v,    s, k, cpu, mean, variance, total, p, worst, best) {
    worst = 0
    best = 1e9
    for (s = 1; s <= n_scenes; s++) {
        for (k = 3; k >= 1; k--)
            mean[k] += worse(v, scene[s], k) / n_scenes
        variance += spread / n_scenes ^ 2
        cpu = log(seconds[v, scene[s]] / seconds[name[1], scene[s]])
        total += cpu / n_scenes
        p = exp(worse(v, scene[s], 1) + cpu)
        if (p > worst) { worst = p; at_worst = scene[s] }
        if (p < best) { best = p; at_best = scene[s] }
    }
    printf "| %s | %.3f | %.3f | %.3f | %.3f | %.3f | **%.3f** | %.2f %s | %.2f %s |%s |\n", v, exp(mean[1]),
        sqrt(variance), exp(mean[2]), exp(mean[3]), exp(total), exp(mean[1] + total), worst, at_worst, best, at_best,
        about[v]
}

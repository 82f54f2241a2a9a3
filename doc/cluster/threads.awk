# threads.awk: how long do threads wait for each other? A simulation of src/base/parallel.c: jobs start in order, each on
# the thread that is free first, but job i not before job i - window is committed; commits follow the order of the jobs,
# one at a time. Input: the seconds of every tile of a picture, one a line, from tiles.sh.
#
#     awk -f threads.awk tiles.txt
#     awk -v sigma=1 -f threads.awk tiles.txt
#
# Of the input's lengths the mean counts alone if sigma is given: they are lognormal then, and sigma the standard deviation
# of their logarithm. commit: what a commit takes, in parts of the mean (0.002). passes: so often the list is gone through
# (40). The columns, slots per thread, say how many per cent of their time the threads do not work; in the last the window
# has no end, so that what is left is the end of the render, or commits.
function normal() { return sqrt(-2 * log(1 - rand())) * cos(6.283185307179586 * rand()) }

function idle(threads, window,    i, k, best, worked, last, free, committed) {
    for (k = 0; k < threads; k++)
        free[k] = 0
    for (i = 0; i < jobs; i++) {
        for (best = k = 0; k < threads; k++)
            if (free[k] < free[best])
                best = k
        if (i >= window && committed[i - window] > free[best])
            free[best] = committed[i - window]
        free[best] += seconds[i]
        worked += seconds[i]
        last = (last > free[best] ? last : free[best]) + commit * mean
        committed[i] = last
    }
    return 100 * (1 - worked / (threads * last))
}

{ tile[n++] = $1 }

END {
    jobs = n * (passes == "" ? 40 : passes)
    commit = commit == "" ? 0.002 : commit
    for (i = 0; i < n; i++)
        mean += tile[i] / n
    for (i = 0; i < jobs; i++) {
        seconds[i] = sigma == "" ? tile[i % n] : mean * exp(sigma * normal() - sigma ^ 2 / 2)
        longest = seconds[i] > longest ? seconds[i] : longest
    }
    printf "%d tile passes, mean %.3g s, longest %.1f times the mean\n", jobs, mean, longest / mean
    printf "threads     2     4     8    16    32     -   (slots per thread; per cent of time lost)\n"
    for (k = 2; k <= 128; k *= 4) {
        printf "%7d", k
        for (w = 2; w <= 32; w *= 2)
            printf " %5.1f", idle(k, w * k)
        printf " %5.1f\n", idle(k, jobs)
    }
}

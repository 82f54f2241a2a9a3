# predictions.awk: predictions of a race (predictions.sh) against what was measured: its files predicted, runs.csv and
# equal-time.md. Sections: prices, the root of the mean square of log(predicted / measured), each scene in a unit of
# its own; scenes, a row each; right, how often the predicted runner was the best, or within 5 % of it; costs, the mean
# of its error over that of the best. Exit status 1 if prices are wrong by more than `most`.
function runner_of(label) {
    sub(/.*race=/, "", label)
    return label
}
function keep(name, s, value) {
    if (value ~ /^[0-9]/ && value !~ /[a-z]/) error[name, s, runner] = value + 0
}
FILENAME ~ /predicted$/ {
    split($0, part, / +/)
    if (part[1] == "scene") scene[++n] = s = part[2]
    else if (part[1] == "" && part[6] ~ /^[-0-9.e]+$/ && part[7] ~ /^[0-9.]+$/) {
        price[s, part[2]] = part[7] + 0
        if (/chosen$/) winner[s] = part[2]
    }
    next
}
FILENAME ~ /runs.csv$/ {
    if (FNR == 1) for (i = 1; i <= NF; i++) column[$i] = i
    else time[$1, runner_of($2)] = $column["price_each"]
    next
}
/^(mse8|relmse|8x8): squared/ { measure = $0; sub(/:.*/, "", measure) }
/^\| method \|/ && measure != "" { columns = split($0, name, / *\| */) - 1; for (i in name) sub(/,.*/, "", name[i]) }
/^\| asbdpt:/ && measure != "" {
    split($0, cell, / *\| */)
    runner = runner_of(cell[2])
    for (i = 3; i <= columns; i++) keep(measure, name[i], cell[i])
}
function mean_cost(measure) { return cases[measure] ? exp(logs[measure] / cases[measure]) : 0 }
END {
    kinds = split("all quarter path_tracer one_point", runners, " ")
    for (k = 1; k <= n; k++) {
        s = scene[k]; sum = count = 0
        for (i = 1; i <= kinds; i++)
            if (time[s, runners[i]] > 0 && price[s, runners[i]] > 0) {
                off[i] = log(price[s, runners[i]] / time[s, runners[i]])
                sum += off[i]; count++
            } else off[i] = ""
        for (i = 1; i <= kinds; i++)
            if (off[i] != "") { square += (off[i] - sum / count) ^ 2; prices++ }
    }
    rms = prices > 0 ? sqrt(square / prices) : 1
    print "== prices"
    printf "%.0f %% (%d prices, %d scenes)\n", 100 * rms, prices, n
    print "== scenes"
    print "| scene | predicted | best by mse8 | cost, mse8 | cost, relmse | cost, 8x8 |"
    print "|---|---|---|---:|---:|---:|"
    for (k = 1; k <= n; k++) {
        s = scene[k]; line = ""
        for (m = split("mse8 relmse 8x8", measures, " "); m >= 1; m--) {
            measure = measures[m]
            error[measure, s, "all"] = 1; best = "all"
            for (i = 1; i <= kinds; i++)
                if ((measure, s, runners[i]) in error && error[measure, s, runners[i]] < error[measure, s, best])
                    best = runners[i]
            known = (measure, s, winner[s]) in error
            cost = known ? error[measure, s, winner[s]] / error[measure, s, best] : 0
            line = " " (known ? sprintf("%.2f", cost) : "-") " |" line
            if (!known) continue
            logs[measure] += log(cost); cases[measure]++; right[measure] += cost < 1.05
        }
        print "| " s " | " winner[s] " | " best " |" line
    }
    printf "== right\n%d (mse8), %d (relmse) and %d (8x8) of %d\n", right["mse8"], right["relmse"], right["8x8"], cases["mse8"]
    printf "== costs\n%.2f (mse8), %.2f (relmse) and %.2f (8x8)\n", mean_cost("mse8"), mean_cost("relmse"), mean_cost("8x8")
    exit !(rms <= most && prices >= n)
}

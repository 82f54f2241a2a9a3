# better.awk: functions of equal.awk and structures.awk: the error of asbdpt over that of the better of bdpt and pt, by
# each measure. awk -f test/measure/evidence/better.awk -f test/measure/evidence/equal.awk, say. What they are given
# is over bdpt.

# over_better: of asbdpt's and pt's cells, "VALUE [LOW, HIGH] MARK". bdpt always counts, and pt, unless it alone has a
# mark. Each measure has its own better method. 0: not known.
function over_better(asbdpt, pt) {
    if (asbdpt !~ /^[0-9]/) return 0
    if (pt !~ /^[0-9]/ || pt + 0 >= 1 || (pt ~ /[a-z]/ && asbdpt !~ /[a-z]/)) return least(asbdpt)
    return least(asbdpt) / least(pt)
}
function least(v) { return v + 0 > 0 ? v + 0 : 0.0005 } # what is printed as 0.000 is taken for half of the last digit

# unseen_scenes: into out, the scenes that nothing was chosen on: every second of a file of scenes, from the first.
function unseen_scenes(file, out,    line, rows, part) {
    while ((getline line < file) > 0) if (line !~ /^#/ && ++rows % 2) { split(line, part, " "); out[part[1]] }
    close(file)
}

# take: a ratio, among those of a group and measure; 0 is counted as not known.
function take(group, m, v) {
    if (v <= 0) { lost[group, m]++; return }
    logs[group, m] += log(v); squares[group, m] += log(v) ^ 2; number[group, m]++; above[group, m] += v > 1
    if (v > most[group, m]) most[group, m] = v
}
function mean_of(group, m) { return number[group, m] ? exp(logs[group, m] / number[group, m]) : 0 }
# interval: geometric mean with its 95 % interval, Student's on the logarithms, if there are five scenes.
function interval(group, m,    n, error) {
    n = number[group, m]
    if (n < 5) return n ? sprintf("%.2f", mean_of(group, m)) : "-"
    error = sqrt((squares[group, m] - logs[group, m] ^ 2 / n) / (n - 1) / n) * student(n - 1)
    n = mean_of(group, m)
    return sprintf("%.2f [%.2f, %.2f]", n, n * exp(-error), n * exp(error))
}
# student: the quantile of Student's t that 2.5 % lie above: Cornish and Fisher's series, within .3 % from 4 on.
function student(n,    z) {
    z = 1.959964
    return z + (z ^ 3 + z) / (4 * n) + (5 * z ^ 5 + 16 * z ^ 3 + 3 * z) / (96 * n ^ 2) + \
        (3 * z ^ 7 + 19 * z ^ 5 + 17 * z ^ 3 - 15 * z) / (384 * n ^ 3)
}
# cells: of a group: for each measure the mean with its interval, the worst, and in how many scenes it is above 1.
function cells(group,    m, text) {
    for (m = 1; m <= 3; m++)
        text = text sprintf(" %s | %.2f | %d |", interval(group, m), most[group, m], above[group, m])
    return text
}
# median_of: of x[1] to x[n], which it sorts.
function median_of(x, n,    i, j, y) {
    for (i = 1; i <= n; i++) {
        y = x[i]
        for (j = i - 1; j >= 1 && x[j] > y; j--) x[j + 1] = x[j]
        x[j + 1] = y
    }
    return n % 2 ? x[(n + 1) / 2] : (x[n / 2] + x[n / 2 + 1]) / 2
}
# two: a number in two digits: 0.59, 1.2, 12, 490,000.
function two(v,    unit, text) {
    if (v < 9.95) return sprintf(v < 0.995 ? "%.2f" : "%.1f", v)
    for (unit = 1; v / unit >= 99.5; unit *= 10) ;
    text = sprintf("%.0f", sprintf("%.0f", v / unit) * unit)
    while (match(text, /^[0-9]+[0-9][0-9][0-9]($|,)/)) text = commas(text)
    return text
}
function commas(text,    first) {
    match(text, /^[0-9]+/); first = RLENGTH - 3
    return substr(text, 1, first) "," substr(text, first + 1)
}
# means_of, worst_of: of a group, by each measure, in words.
function three(a, b, c) { return two(a) " (mse8), " two(b) " (relmse) and " two(c) " (8x8)" }
function means_of(group) { return three(mean_of(group, 1), mean_of(group, 2), mean_of(group, 3)) }
function worst_of(group) { return three(most[group, 1], most[group, 2], most[group, 3]) }
# row: of a group, cells of a table: the means by each measure, and in how many scenes asbdpt has more error.
function row(group,    m, text, losses, each, same) {
    same = number[group, 1] == number[group, 2] && number[group, 2] == number[group, 3]
    for (m = 1; m <= 3; m++) {
        text = text interval(group, m) " | "
        losses = losses (m > 1 ? ", " : "") above[group, m]
        each = each (m > 1 ? ", " : "") above[group, m] " of " number[group, m]
    }
    return text (same ? losses " of " number[group, 1] : each)
}
# answers: of a group the sections row and worst, their names after `before`.
function answers(group, before) {
    printf "== %srow\n%s\n== %sworst\n%s\n", before, row(group), before, worst_of(group)
}

# better.awk: functions on sets of ratios of squared errors, of which a set has one for each scene, by three measures:
# geometric means, their intervals, losses, the worst. What reads the ratios: equal.awk, rivals.awk.

# loses: is a ratio one of a loss? Ratios within 0.5 % of 1 are ties.
function loses(v) { return v > 1.005 }
# take: into a set a ratio v; 0: not known. What is below 0.0005 counts as that: one scene shall not make the mean.
function take(set, m, v) {
    if (v <= 0) return
    if (v < 0.0005) v = 0.0005
    logs[set, m] += log(v); squares[set, m] += log(v) ^ 2; each[set, m, ++number[set, m]] = log(v)
    above[set, m] += loses(v)
    if (v > most[set, m]) most[set, m] = v
}
function mean_of(set, m) { return number[set, m] ? exp(logs[set, m] / number[set, m]) : 0 }
# error_of: the standard error of the mean logarithm.
function error_of(set, m,    n, v) {
    n = number[set, m]
    v = n > 1 ? (squares[set, m] - logs[set, m] ^ 2 / n) / (n - 1) / n : 0
    return v > 0 ? sqrt(v) : 0
}
# interval: geometric mean with its 95 % interval, Student's on the logarithms, if there are five scenes.
function interval(set, m,    n, error, v) {
    n = number[set, m]; v = mean_of(set, m)
    if (n < 5) return n ? sprintf("%.2f", v) : "-"
    error = error_of(set, m) * student(n - 1)
    return sprintf("%.2f [%.2f, %.2f]", v, v * exp(-error), v * exp(error))
}
# student: the quantile of Student's t with n degrees of freedom that 2.5 % lie above; below 5 of the whole number below
# n, from 5 on by Cornish and Fisher's series, within 0.1 %.
function student(n,    z, t) {
    if (n < 5) { split("12.706 4.303 3.182 2.776", t, " "); return t[n < 1 ? 1 : int(n)] }
    z = 1.959964
    return z + (z ^ 3 + z) / (4 * n) + (5 * z ^ 5 + 16 * z ^ 3 + 3 * z) / (96 * n ^ 2) + \
        (3 * z ^ 7 + 19 * z ^ 5 + 17 * z ^ 3 - 15 * z) / (384 * n ^ 3)
}
# student_p: the two-sided p-value of Student's t with a whole number n of degrees of freedom [Abramowitz &
# Stegun 1964 26.7.3].
function student_p(t, n,    angle, c, term, sum, i) {
    angle = atan2(t < 0 ? -t : t, sqrt(n)); c = cos(angle)
    term = n % 2 ? c : 1
    for (i = n % 2 + 2; i <= n; i += 2) { sum += term; term *= c * c * (i - 1) / i }
    return 1 - (n % 2 ? 2 / 3.14159265358979 * (angle + sin(angle) * sum) : sin(angle) * sum)
}
function sort(x, n,    i, j, y) {
    for (i = 1; i <= n; i++) {
        y = x[i]
        for (j = i - 1; j >= 1 && x[j] > y; j--) x[j + 1] = x[j]
        x[j + 1] = y
    }
}
# two: a number in two digits: 0.59, 1.2, 12, 490,000. digits: in three below 0.1.
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
function digits(v) { return v < 0.0995 ? sprintf("%.3f", v) : two(v) }

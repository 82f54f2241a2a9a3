# recompute.awk RUNS.csv NAME.txt: computes again from every run, by other code, the geometric means over scenes of
# ratios of squared errors, and their intervals, Student's at 95 % on the logarithms. It compares these with stored
# tables: the rows of methods in the sections of both halves, which the program makes, over the first method after the
# same predicted time; and the row of better.awk and the data of structures.awk, over the better of bdpt and pt, of
# errors times measured seconds. Of one scene it computes no interval: the stored one is over seeds, with the noise of
# a reference, which runs do not tell. Exit status 1 if a number differs or none was compared.
BEGIN {
    while ((getline < ARGV[2]) > 0) { # numbers that are not there: the noise of a reference, which runs do not tell
        if (/^== /) section = $0
        else if (section == "== unknown") dash[$1, $3 == "mse8" ? 1 : $3 == "relmse" ? 2 : 3]
    }
    section = ""
    FS = ","
    T = 0.00025 # relative error of t below, which has three decimals: the logarithm of an end is off by T error
    split("12.706 4.303 3.182 2.776 2.571 2.447 2.365 2.306 2.262 2.228 2.201 2.179 2.160 2.145 2.131 2.120 " \
        "2.110 2.101 2.093 2.086 2.080 2.074 2.069 2.064 2.060 2.056 2.052 2.048 2.045 2.042", t, " ")
    split("mse8 relmse relmse8x8", square, " ")
}
FNR == 1 { file++ }
file == 1 && FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
file == 1 {
    s = $at["scene"]; h = "part" in at && $at["part"] != "" ? $at["part"] : $at["half"]
    last = h == "" ? "all" : h
    n = split(h == "both" ? "choice services" : h == "" ? "all" : h, half, " ")
    if (!(s in known)) { scene[++scenes] = s; first = $at["label"]; timed = $at["half"]; known[s] }
    i = ++seeds[$at["label"], $at["half"], s] # methods have seeds of their own
    if ($at["label"] == first && $at["half"] == timed) time[s, i] = $at["price_before"] + $at["spp"]
    mark[$at["label"], s] = $at["mark"]
    afforded = (time[s, i] - $at["price_before"]) / $at["price_each"] # samples
    for (h = 1; h <= n; h++)
        for (k = 1; k <= 3; k++) {
            paid[half[h], $at["label"], s, k] += afforded >= 1 ? $at[square[k]] * $at["seconds"] : -1e99
            sum[half[h], $at["label"], s, k] += afforded >= 1 ? $at[square[k]] * $at["spp"] / afforded : -1e99
        }
    next
}
# Is a stored number ("0.63", "6.1e+03") the one of the runs, to its last place? The runs' own digits are rounded
# too; by: what the runs' number may be off by besides, relative.
function near(a, b, by,    place) {
    place = 0.51
    if (match(a, /\.[0-9]+/)) place /= 10 ^ (RLENGTH - 1)
    if (match(a, /e.*/)) place *= 10 ^ substr(a, RSTART + 1)
    return (a - b) ^ 2 <= (place + (0.0001 + by) * b) ^ 2
}
# Is the cell of a row, "VALUE [LOW, HIGH]", what the runs say by measure k?
function compare(half, method, k, text,    i, x, a, b, mean, squares, error, stored) {
    for (i = 1; i <= scenes; i++) {
        a = sum[half, method, scene[i], k]; b = sum[half, first, scene[i], k]
        if (a <= 0 || b <= 0) return text ~ /^ *[*]*-/ || wrong(half, method, k, text, "nothing")
        x[i] = log(a / b); mean += x[i] / scenes
    }
    for (i = 1; i <= scenes; i++) squares += (x[i] - mean) ^ 2
    error = scenes > 1 ? t[scenes - 1] * sqrt(squares / (scenes - 1) / scenes) : 0
    gsub(/[][*,]/, " ", text); split(text, stored, " ")
    compared++
    return near(stored[1], exp(mean)) && (scenes == 1 || \
        near(stored[2], exp(mean - error), T * error) && near(stored[3], exp(mean + error), T * error)) || \
        wrong(half, method, k, text, sprintf("%.3f [%.3f, %.3f]", exp(mean), exp(mean - error), exp(mean + error)))
}
function wrong(half, method, k, text, runs) {
    print half, method, square[k] ": stored" text ", of the runs " runs
    bad = 1
}
/^== / { section = substr($0, 4) }
section ~ /^(choice|services)$/ && /^\| / {
    split($0, c, / *\| */)
    for (k = 1; k <= 3; k++) if ((section, c[2], scene[1], 1) in sum) compare(section, c[2], k, " " c[3 + k])
}
# The default over the better of bdpt and pt, each measure with its own better one; less than 0.0005 counts as that.
function over_better(h, s, k,    ours, a, b, p) {
    if ((s, k) in dash) return 0
    ours = (h, "asbdpt", s, 1) in paid ? "asbdpt" : "subspaces"
    a = paid[h, ours, s, k]; b = paid[h, "bdpt", s, k]; p = paid[h, "pt", s, k]
    if (a <= 0 || b <= 0) return 0
    if (p > 0 && p < b && (mark["pt", s] == "" || mark[ours, s] != "")) b = p
    return a / b < 0.0005 ? 0.0005 : a / b
}
/^Marks: .* No number: / { # of structures.awk: as many are missing as is said
    sub(/.* No number: by mse8 in /, ""); split($0, missing, / in /)
}
section == "data" && split($0, c, " ") == 10 { # of structures.awk
    for (k = 1; k <= 3; k++) {
        v = over_better("all", c[1], k)
        compared++
        if (c[3 * k - 1] == "-") dashes[k]++
        if ((c[3 * k - 1] == "-") != (v == 0) || (v && !near(c[3 * k - 1], v)))
            wrong("all", c[1], k, " " c[3 * k - 1], v)
    }
}
# row: of better.awk, "MEAN [LOW, HIGH] | ... | ... | LOSSES of SCENES by each measure".
section == "row" && split($0, c, / *\| */) == 4 {
    split(c[4], lost, ", ")
    for (k = 1; k <= 3; k++) {
        mean = squares = above = number = 0
        for (i = 1; i <= scenes; i++) if ((v = over_better(last, scene[i], k)) > 0) {
            mean += log(v); squares += log(v) ^ 2; number++; above += v > 1.005
        }
        if (!number) { wrong(last, section, k, " " c[k], "nothing"); continue }
        mean /= number
        error = number > 30 ? 1.96 + 2.4 / (number - 1) : t[number - 1]
        if (number > 1) error *= sqrt((squares - number * mean ^ 2) / (number - 1) / number)
        gsub(/[][,]/, " ", c[k]); split(c[k], stored, " ")
        compared++
        if (!near(stored[1], exp(mean)) || lost[k] + 0 != above || (lost[k] " " lost[3]) !~ " of " number || \
            (number > 4 && !(near(stored[2], exp(mean - error), T * error) && \
            near(stored[3], exp(mean + error), T * error))))
            wrong(last, section, k, " " c[k] " " c[4], sprintf("%.3f %.3f %.3f, %d of %d", exp(mean), exp(mean - error),
                exp(mean + error), above, number))
    }
}
END {
    for (k = 1; k <= 3 && 1 in missing; k++)
        if (dashes[k] + 0 != missing[k] + 0) wrong("all", "numbers missing", k, " " missing[k], dashes[k] + 0)
    print compared + 0 " numbers computed again"
    exit bad || !compared
}

# recompute.awk RUNS.csv NAME.txt: computes again from every run the geometric means over scenes of the squared errors
# over the first method's after the same CPU time, and their intervals, Student's at 95 % on the logarithms. It compares
# these with a stored table: the rows of methods in the sections of both halves, or the row of better.awk. Of one scene
# it computes no interval: the stored one is over seeds, with the noise of a reference, which runs do not tell. Exit
# status 1 if a number differs or none was compared.
BEGIN {
    while ((getline < ARGV[2]) > 0) { # numbers that are not there: the noise of a reference, which runs do not tell
        if (/^== /) section = $0
        else if (section == "== data" && NF == 10) for (k = 1; k <= 3; k++) if ($(3 * k - 1) == "-") dash[$1, k]
    }
    section = ""
    FS = ","
    split("12.706 4.303 3.182 2.776 2.571 2.447 2.365 2.306 2.262 2.228 2.201 2.179 2.160 2.145 2.131 2.120 " \
        "2.110 2.101 2.093 2.086 2.080 2.074 2.069 2.064 2.060 2.056 2.052 2.048 2.045 2.042", t, " ")
    split("mse8 relmse relmse8x8", square, " ")
}
FNR == 1 { file++ }
file == 1 && FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
file == 1 {
    s = $at["scene"]; h = $at["half"]
    n = split(h == "both" ? "choice services" : h == "" ? "all" : h, half, " ")
    if (!(s in known)) { scene[++scenes] = s; first = $at["label"]; known[s] }
    i = ++seeds[$at["label"], $at["half"], s] # methods have seeds of their own
    if ($at["label"] == first) time[s, i] = $at["price_before"] + $at["spp"]
    mark[$at["label"], s] = $at["mark"]
    afforded = (time[s, i] - $at["price_before"]) / $at["price_each"] # samples
    for (h = 1; h <= n; h++)
        for (k = 1; k <= 3; k++)
            sum[half[h], $at["label"], s, k] += afforded >= 1 ? $at[square[k]] * $at["spp"] / afforded : -1e99
    next
}
# Is a stored number ("0.63", "6.1e+03") the one of the runs, to its last place? The runs' own digits are rounded too;
# by: what a quotient of rounded numbers adds.
function near(a, b, by,    place) {
    place = 0.6
    if (match(a, /\.[0-9]+/)) place /= 10 ^ (RLENGTH - 1)
    if (match(a, /e.*/)) place *= 10 ^ substr(a, RSTART + 1)
    return (a - b) ^ 2 <= (place + (0.0006 + by) * b) ^ 2
}
# Is the cell of a row, "VALUE [LOW, HIGH]", what the runs say by measure k?
function compare(half, method, k, text,    i, x, a, b, mean, squares, error, stored) {
    if (gaps && text ~ /^[ *]*-[ *]*$/) return 1
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
        near(stored[2], exp(mean - error)) && near(stored[3], exp(mean + error))) || \
        wrong(half, method, k, text, sprintf("%.3f [%.3f, %.3f]", exp(mean), exp(mean - error), exp(mean + error)))
}
function wrong(half, method, k, text, runs) {
    print half, method, square[k] ": stored" text ", of the runs " runs
    bad = 1
}
/^== / { section = substr($0, 4) }
/^\| [^|]*\| [^|]*\| (\*\*)?-/ { split($0, c, / *\| */); unknown[c[2]]; gaps++ } # against a reference whose noise is unknown
section ~ /^(choice|services)$/ && /^\| / {
    split($0, c, / *\| */)
    for (k = 1; k <= 3; k++) if ((section, c[2], scene[1], 1) in sum) compare(section, c[2], k, " " c[3 + k])
}
# The default over the better of bdpt and pt, each measure with its own better one. printed: what it is known to as a
# quotient of numbers with three digits after the point.
function over_better(h, ours, s, k,    a, b, p) {
    if ((s, k) in dash) return 0
    a = sum[h, ours, s, k]; b = sum[h, "bdpt", s, k]; p = sum[h, "pt", s, k]
    if (a <= 0 || b <= 0 || s in unknown) return 0
    printed = a < 0.0005 * b ? 0 : 0.0005 * b / a
    if (a < 0.0005 * b) a = 0.0005 * b # as it is printed
    p = p > 0 && p < b && (mark["pt", s] == "" || mark[ours, s] != "") ? p : b
    printed += (p < b ? 0.0005 * b / p : 0) + (ours == "asbdpt" ? 0.0005 * p / a : 0) # structures.awk rounds its quotient
    return a / p
}
/^Marks: .* No number: / { # of structures.awk: as many are missing as is said
    sub(/.* No number: by mse8 in /, ""); split($0, missing, / in /)
}
section == "data" && split($0, c, " ") == 10 { # of structures.awk
    for (k = 1; k <= 3; k++) {
        v = over_better("all", "asbdpt", c[1], k)
        compared++
        if (c[3 * k - 1] == "-") dashes[k]++
        else if (!near(c[3 * k - 1], v, printed)) wrong("all", c[1], k, " " c[3 * k - 1], v)
    }
}
# row: of better.awk, "MEAN [LOW, HIGH] | ... | ... | LOSSES of SCENES by each measure".
section == "row" && split($0, c, / *\| */) == 4 {
    h = ("all", first, scene[1], 1) in sum ? "all" : "services"
    ours = (h, "asbdpt", scene[1], 1) in sum ? "asbdpt" : "subspaces"
    split(c[4], lost, ", ")
    for (k = 1; k <= 3; k++) {
        mean = squares = above = least = number = by = 0
        for (i = 1; i <= scenes; i++) if ((v = over_better(h, ours, scene[i], k)) > 0) {
            mean += log(v); squares += log(v) ^ 2; number++; by += printed
            above += v > 1 - printed; least += v > 1 + printed # 1.000 may be either
        }
        if (!number) { wrong(h, section, k, " " c[k], "nothing"); continue }
        mean /= number; by /= number
        error = number > 30 ? 1.96 + 2.4 / (number - 1) : t[number - 1]
        if (number > 1) error *= sqrt((squares - number * mean ^ 2) / (number - 1) / number)
        gsub(/[][,]/, " ", c[k]); split(c[k], stored, " ")
        compared++
        if (!near(stored[1], exp(mean), by) || lost[k] + 0 > above || lost[k] + 0 < least || \
            (lost[k] " " lost[3]) !~ " of " number || \
            (number > 4 && !(near(stored[2], exp(mean - error), 2 * by) && near(stored[3], exp(mean + error), 2 * by))))
            wrong(h, section, k, " " c[k] " " c[4], sprintf("%.3f %.3f %.3f, %d of %d", exp(mean), exp(mean - error),
                exp(mean + error), above, number))
    }
}
END {
    for (k = 1; k <= 3 && 1 in missing; k++)
        if (dashes[k] + 0 != missing[k] + 0) wrong("all", "numbers missing", k, " " missing[k], dashes[k] + 0)
    print compared + 0 " numbers computed again"
    exit bad || !compared
}

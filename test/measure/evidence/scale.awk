# scale.awk: what scale.sh has measured, compared with laws a + b f(n), fitted by least squares of relative errors, a
# and b not negative; no law is fitted to two sizes. Prints sections for doc/measured: table; data, the lines of
# scale.sh.
BEGIN {
    n_rows = split("triangles build nlogn building, s|triangles load n reading, s|triangles ray log a ray, us" \
        "|triangles bdpt log bdpt, us a path|triangles memory n memory, MiB|lights load n reading, s|" \
        "lights bdpt constant bdpt, us a path|lights asbdpt constant asbdpt, us a path|lights memory n memory, MiB|" \
        "pixels bdpt n bdpt, s|pixels asbdpt n asbdpt, s|pixels bdpt-memory n bdpt, MiB|" \
        "pixels asbdpt-memory n asbdpt, MiB|" \
        "samples bdpt n bdpt, s|samples asbdpt n asbdpt, s|samples asbdpt-memory constant asbdpt, MiB|" \
        "threads bdpt-speed n bdpt, gain|threads asbdpt-speed n asbdpt, gain|" \
        "threads asbdpt-memory n asbdpt, MiB", row, "|")
    says["n"] = "a + b n"; says["nlogn"] = "a + b n log n"; says["log"] = "a + b log n"; says["constant"] = "a"
}
NF == 4 {
    if (!(($1, $2, "") in value)) { size[$1, ++sizes[$1]] = $2; value[$1, $2, ""] = 1 }
    value[$1, $2, $3] = $4
}
function f(law, n) { return law == "n" ? n : law == "nlogn" ? n * log(n) : law == "log" ? log(n) : 0 }
# What a row measures of size i; threads gain t CPU(1) / CPU(t).
function of(axis, what, i,    n, m) {
    n = size[axis, i]
    if (what !~ /-speed$/) return value[axis, n, what]
    m = what
    sub(/-speed/, "", m)
    return n * value[axis, 1, m] / value[axis, n, m]
}
function fit(axis, what, law,    i, y, x, p, q, r, s, t, d) {
    for (i = 1; i <= sizes[axis]; i++) {
        y = of(axis, what, i); x = f(law, size[axis, i])
        if (y <= 0) continue
        p += 1 / y / y; q += x / y / y; r += x * x / y / y; s += 1 / y; t += x / y
    }
    d = p * r - q * q
    if (law == "constant" || d <= 1e-12 * p * r) { a = p > 0 ? s / p : 0; b = 0; return }
    a = (s * r - t * q) / d; b = (p * t - q * s) / d
    if (a < 0) { a = 0; b = t / r }
    if (b < 0) { b = 0; a = s / p }
}
function power(n,    k) {
    k = sprintf("%.0f", log(n) / log(10))
    return k > 3 && n == sprintf("%.0f", exp(k * log(10))) ? "10^" k : n
}
END {
    print "== table\n| | from | to | | law | a | b | farthest from it |\n|---|---:|---:|---|---|---:|---:|---|"
    for (k = 1; k <= n_rows; k++) {
        split(row[k], part, " ")
        axis = part[1]; name = row[k]; sub(/^[^ ]+ [^ ]+ [^ ]+ /, "", name)
        if (!sizes[axis]) continue
        fit(axis, part[2], part[3])
        worst = at = 1
        for (i = 1; i <= sizes[axis]; i++) {
            y = of(axis, part[2], i) / (a + b * f(part[3], size[axis, i]))
            if (y > 0 && log(y) * log(y) > log(worst) * log(worst)) { worst = y; at = i }
        }
        first = of(axis, part[2], 1); last = of(axis, part[2], sizes[axis])
        if (sizes[axis] < 3) {
            printf "| %s %s to %s: %s | %.3g | %.3g | | | | | |\n", axis, power(size[axis, 1]),
                power(size[axis, sizes[axis]]), name, first, last
            continue
        }
        printf "| %s %s to %s: %s | %.3g | %.3g | | %s | %.2g | %s | %.2f at %s |\n", axis, power(size[axis, 1]),
            power(size[axis, sizes[axis]]), name, first, last, says[part[3]], a, \
            (part[3] == "constant" ? "" : sprintf("%.2g", b)), worst, power(size[axis, at])
    }
    print "== data"
    for (k in value) {
        split(k, part, SUBSEP)
        if (part[3] != "") print part[1], part[2], part[3], value[k] | "LC_ALL=C sort -k1,1 -k3,3 -k2,2n"
    }
}

# scale.awk: what scale.sh has measured, compared with laws a + b f(n), fitted by least squares of relative errors, a
# and b not negative; no law is fitted to two sizes. Prints sections for doc/measured: table; data, which with
# -v figure=1 is read to draw panels of curves, each of one unit, all axes logarithmic, laws dashed.
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
/^==/ { on = $2 == "data"; next }
NF == 4 && (!figure || on) {
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
function table(    k, part, axis, i, y, worst, at, first, last) {
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
            power(size[axis, sizes[axis]]), name, first, last, says[part[3]], a, part[3] == "constant" ? "" : \
            sprintf("%.2g", b), worst, power(size[axis, at])
    }
    print "== data"
    for (k in value) {
        split(k, part, SUBSEP)
        if (part[3] != "") print part[1], part[2], part[3], value[k] | "LC_ALL=C sort -k1,1 -k3,3 -k2,2n"
    }
}

# ---- the figure ----
function X(n) { return left + 20 + 190 * log(n / low) / log(high / low) }
function Y(v) { return top + 56 + 170 * log(most / v) / log(most / least) }
# The unit of a row's values: "s", "us", "MiB" or "gain".
function unit_of(row,    part) {
    sub(/ a path$/, "", row)
    return substr(row, match(row, /[^ ]+$/))
}
function panel(axis, unit,    k, part, i, y, m, c, d, name, j) {
    low = size[axis, 1]; high = size[axis, sizes[axis]]; least = 1e30; most = 0; m = 0
    if (high == low) high = 2 * low
    for (k = 1; k <= n_rows; k++) {
        split(row[k], part, " ")
        for (i = 1; part[1] == axis && unit_of(row[k]) == unit && i <= sizes[axis]; i++) {
            y = of(axis, part[2], i)
            if (y > 0 && y < least) least = y
            if (y > most) most = y
        }
    }
    if (!most) return 0
    least /= 1.5; most *= 1.5
    printf "<text x='%d' y='%d' font-weight='bold'>%s</text>\n", left + 20, top + 14, says[unit]
    printf "<text x='%d' y='%d' text-anchor='middle'>%s</text>\n", left + 115, top + 258, axis
    printf "<path d='M%d %dV%dH%d' stroke='#222' fill='none'/>\n", left + 20, top + 56, top + 226, left + 210
    for (j = -27; j < 27; j++) { # at powers of ten; on a short axis at 2 and 5, too
        y = substr("125", (j + 27) % 3 + 1, 1) * exp((int((j + 27) / 3) - 9) * log(10))
        if (y < least || y > most || ((j + 27) % 3 && most > 30 * least)) continue
        printf "<path d='M%d %.1fH%d' stroke='#ddd'/>", left + 20, Y(y), left + 210
        printf "<text x='%d' y='%.1f' text-anchor='end'>%g</text>\n", left + 16, Y(y) + 4, y
    }
    for (i = 1; i <= sizes[axis]; i++)
        if (i == 1 || i == sizes[axis] || sizes[axis] < 5)
            printf "<text x='%.1f' y='%d' text-anchor='middle'>%s</text>\n", X(size[axis, i]), top + 242,
                power(size[axis, i])
    for (k = 1; k <= n_rows; k++) {
        split(row[k], part, " ")
        if (part[1] != axis || unit_of(row[k]) != unit) continue
        name = row[k]; sub(/^[^ ]+ [^ ]+ [^ ]+ /, "", name)
        c = colour[++m]; d = ""
        for (i = 1; i <= sizes[axis]; i++) {
            y = of(axis, part[2], i)
            if (y <= 0) continue
            d = d (d == "" ? "M" : "L") sprintf("%.1f %.1f", X(size[axis, i]), Y(y))
            printf "<circle cx='%.1f' cy='%.1f' r='3' fill='%s'/>\n", X(size[axis, i]), Y(y), c
        }
        printf "<path d='%s' fill='none' stroke='%s' stroke-width='1.6'/>\n", d, c
        sub(/, [^,]*$/, "", name)
        if (sizes[axis] > 2) { fit(axis, part[2], part[3]); name = name ": " says[part[3]] }
        d = ""
        for (i = 0; sizes[axis] > 2 && i <= 40; i++) {
            y = low * exp(i / 40 * log(high / low))
            v = a + b * f(part[3], y)
            if (v >= least && v <= most) d = d (d == "" ? "M" : "L") sprintf("%.1f %.1f", X(y), Y(v))
        }
        if (d != "") printf "<path d='%s' fill='none' stroke='%s' stroke-dasharray='2 4'/>\n", d, c
        printf "<text x='%d' y='%d' fill='%s'>%s</text>\n", left + 20, top + 16 + 14 * m, c, name
    }
    return 1
}
END {
    if (!figure) { table(); exit }
    split("#1d5fbf #c96f00 #23823b #b0408f #777777", colour, " ")
    print "<svg xmlns='http://www.w3.org/2000/svg' width='880' height='1400' viewBox='0 0 880 1400' " \
        "font-family='sans-serif' font-size='12'><rect width='100%' height='100%' fill='white'/>"
    says["s"] = "CPU time, s"; says["us"] = "CPU time, us"; says["MiB"] = "memory, MiB"; says["gain"] = "speed-up"
    n_axes = split("triangles lights pixels samples threads", axes, " ")
    n_units = split("s gain us MiB", units, " ")
    for (p = 1; p <= n_axes; p++)
        for (u = 1; u <= n_units; u++) {
            if (u == 1) { left = 30; top = (p - 1) * 280 }
            if (panel(axes[p], units[u])) left += 290
        }
    print "</svg>"
}

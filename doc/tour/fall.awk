# fall.awk: curves as SVG, both axes logarithmic, with dashed lines from where each begins. Reads lines "NAME N VALUE",
# those of a name together; -v title=. Unless -v across= and -v up= name the axes, N are samples per pixel, and values are
# errors. Unless -v slope= is given, the dashed lines are proportional to 1/sqrt(N). -v wide=: pixels of the N axis. Lines
# "NAME N VALUE LOW HIGH" have bars. -v names="A B ...": whatever comes first, A has the first colour, B the second, and
# dashes of their own. -v dashed=: what dashed lines are, said in the figure.
BEGIN {
    if (slope == "") slope = -0.5
    if (wide == "") wide = 420
    if (across == "") across = "samples per pixel"
    if (up == "") up = "rmse of 8-bit values; lower is better"
    split("#1d5fbf #c96f00 #23823b #b0408f #777777 #8a6d00 #007d99 #6a5acd", colour, " ")
    split("none,8 3,2 3,9 3 2 3,14 4,5 2,1 2,6 2 1 2 1 2", dash, ",")
    fixed = split(names, known, " ")
}
function X(n) { return 70 + wide * log(n / first) / log(last / first) }
function Y(e) { return 300 - 250 * log(e / least) / log(most / least) }
# A number of the axis, in thousands if it is a large round one.
function short(k) { return k >= 1e4 && k % 1000 == 0 ? sprintf("%dk", k / 1000) : sprintf("%d", k) }
# Where a name is: below all that are too near.
function label(y,    i) {
    for (i = 1; i <= labels; i++) if (at[i] < y + 14 && at[i] > y - 14) { y = at[i] + 14; i = 0 }
    return at[++labels] = y
}
{ name[NR] = $1; n[NR] = $2; e[NR] = $3; low[NR] = $4; high[NR] = $5 }
NR == 1 { first = last = $2; least = most = $3 }
{ if ($2 < first) first = $2; if ($2 > last) last = $2; if ($3 < least) least = $3; if ($3 > most) most = $3 }
END {
    if (NR == 0) exit 1
    every = sprintf("%.3f", log(last / first) / log(10)) ~ /[.]000$/ ? 10 : 4
    least /= 1.3; most *= 1.3
    printf "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='350' viewBox='0 0 %d 350' font-family='sans-serif' ",
        wide + 200, wide + 200
    print "font-size='13'><rect width='100%' height='100%' fill='white'/>"
    printf "<text x='10' y='20' font-weight='bold'>%s</text>\n", title
    for (k = every == 10 ? first : 1; k < first; k *= 2);
    for (; k <= last; k *= every)
        printf "<path d='M%g 40V300' stroke='#ddd'/><text x='%g' y='318' text-anchor='middle'>%s</text>\n", X(k), X(k), short(k)
    print "<text x='" 70 + wide / 2 "' y='340' text-anchor='middle'>" across "</text>"
    if (dashed != "") printf "<text x='%d' y='34' text-anchor='end' fill='#666' font-size='12'>%s</text>\n", 70 + wide, dashed
    print "<text x='14' y='175' text-anchor='middle' transform='rotate(-90 14 175)'>" up "</text>"
    for (p = -3; p < 4; p++)
        for (m = 1; m <= 5; m += m == 1 ? 1 : 3)
            if ((v = m * exp(p * log(10))) >= least && v <= most)
                printf "<path d='M70 %gH%d' stroke='#ddd'/><text x='64' y='%g' text-anchor='end'>%.4g</text>\n",
                    Y(v), 70 + wide, Y(v) + 4, v
    for (i = 1; i <= NR; i++)
        if (name[i] != name[i - 1]) {
            series++
            for (j = 1; j <= fixed; j++) if (known[j] == name[i]) series = j
            c = colour[series]
            stop = last
            end = e[i] * (stop / n[i]) ^ slope
            edge = slope < 0 ? least : most
            if (end < least || end > most) { end = edge; stop = n[i] * (edge / e[i]) ^ (1 / slope) }
            printf "<path d='M%g %gL%g %g' stroke='#999' stroke-dasharray='3 4'/>\n", X(n[i]), Y(e[i]), X(stop), Y(end)
            d = ""
            for (j = i; name[j] == name[i]; j++) {
                d = d (j > i ? "L" : "M") sprintf("%.1f %.1f", X(n[j]), Y(e[j]))
                printf "<circle cx='%.1f' cy='%.1f' r='3.5' fill='%s'/>\n", X(n[j]), Y(e[j]), c
                if (high[j] > 0)
                    printf "<path d='M%.1f %.1fV%.1f' stroke='%s'/>\n", X(n[j]), Y(low[j] > least ? low[j] : least), \
                        Y(high[j] < most ? high[j] : most), c
            }
            printf "<path d='%s' fill='none' stroke='%s' stroke-width='2'%s/><text x='%d' y='%.1f' fill='%s'>%s</text>\n", d, c,
                fixed ? " stroke-dasharray='" dash[series] "'" : "", 80 + wide, label(Y(e[j - 1]) + 4), c, name[i]
        }
    print "</svg>"
}

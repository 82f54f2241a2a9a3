# fall.awk: errors over numbers of samples as SVG, both axes logarithmic, beside lines that fall as 1/sqrt(N). Reads lines
# "NAME N ERROR", those of a name together; -v title=.
function X(n) { return 70 + 420 * log(n / first) / log(last / first) }
function Y(e) { return 300 - 250 * log(e / least) / log(most / least) }
# Where a name stands: below the one before, if that is too near.
function label(y) { return below = below > 0 && y < below + 14 && y > below - 14 ? below + 14 : y }
{ name[NR] = $1; n[NR] = $2; e[NR] = $3 }
NR == 1 { first = last = $2; least = most = $3 }
{ if ($2 < first) first = $2; if ($2 > last) last = $2; if ($3 < least) least = $3; if ($3 > most) most = $3 }
END {
    split("#1d5fbf #c96f00 #23823b #b0408f", colour, " ")
    least /= 1.3; most *= 1.3
    print "<svg xmlns='http://www.w3.org/2000/svg' width='620' height='350' viewBox='0 0 620 350' font-family='sans-serif' " \
        "font-size='13'><rect width='100%' height='100%' fill='white'/>"
    printf "<text x='10' y='20' font-weight='bold'>%s</text>\n", title
    for (k = first; k <= last; k *= 4)
        printf "<path d='M%g 40V300' stroke='#ddd'/><text x='%g' y='318' text-anchor='middle'>%d</text>\n", X(k), X(k), k
    print "<text x='280' y='340' text-anchor='middle'>samples per pixel</text>"
    print "<text x='14' y='175' text-anchor='middle' transform='rotate(-90 14 175)'>rmse of 8-bit values; lower is better</text>"
    for (p = -3; p < 4; p++)
        for (m = 1; m <= 5; m += m == 1 ? 1 : 3)
            if ((v = m * exp(p * log(10))) >= least && v <= most)
                printf "<path d='M70 %gH490' stroke='#ddd'/><text x='64' y='%g' text-anchor='end'>%.3g</text>\n", Y(v), Y(v) + 4, v
    for (i = 1; i <= NR; i++)
        if (name[i] != name[i - 1]) {
            c = colour[++series]
            end = e[i] * sqrt(n[i] / last)
            stop = last
            if (end < least) { stop = n[i] * (e[i] / least) * (e[i] / least); end = least }
            printf "<path d='M%g %gL%g %g' stroke='#999' stroke-dasharray='3 4'/>\n", X(n[i]), Y(e[i]), X(stop), Y(end)
            d = ""
            for (j = i; name[j] == name[i]; j++) {
                d = d (j > i ? "L" : "M") sprintf("%.1f %.1f", X(n[j]), Y(e[j]))
                printf "<circle cx='%.1f' cy='%.1f' r='3.5' fill='%s'/>\n", X(n[j]), Y(e[j]), c
            }
            printf "<path d='%s' fill='none' stroke='%s' stroke-width='2'/><text x='500' y='%.1f' fill='%s'>%s</text>\n", d, c, label(Y(e[j - 1]) + 4), c, name[i]
        }
    print "</svg>"
}

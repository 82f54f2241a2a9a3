# dots.awk: ratios on a logarithmic axis as SVG, a row for each scene; 1 is a vertical line. Reads lines
# "LABEL VALUE LOW HIGH OTHER": VALUE is a dot with LOW to HIGH as its whisker, OTHER a ring ("-": none). What is beyond
# the axis becomes an arrow at its end. -v title=, -v axis=, -v dot=, -v ring=: texts; -v least=, -v most=: of the axis; -v left=: room for labels.
function place(v) { return left + width * log(v / least) / log(most / least) }
function within(v) { return v < least ? least : v > most ? most : v }
function mark(v, y, fill, radius,    x) {
    x = place(within(v))
    if (v > most || v < least)
        printf("<path d='M%g %gl%d -5v10z' fill='%s' stroke='#222'/>", x, y, v > most ? -9 : 9, fill)
    else
        printf "<circle cx='%g' cy='%g' r='%g' fill='%s' stroke='#222'/>", x, y, radius, fill
}
# The end of a whisker.
function end(v, y) {
    return sprintf("M%g %g", place(within(v)), y - 4) (v < least ? "m5 0l-5 4l5 4" : v > most ? "m-5 0l5 4l-5 4" : "v8")
}
BEGIN { if (left == "") left = 160; width = 420; across = left + width + 60 }
{ label[NR] = $1; value[NR] = $2; from[NR] = $3; to[NR] = $4; other[NR] = $5 }
END {
    bottom = 70 + 22 * NR
    printf "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d' viewBox='0 0 %d %d' ", across, bottom + 44,
        across, bottom + 44
    print "font-family='sans-serif' font-size='13'><rect width='100%' height='100%' fill='white'/>"
    printf "<text x='10' y='18' font-weight='bold'>%s</text>\n", title
    printf "<circle cx='%d' cy='38' r='4' fill='#4393c3' stroke='#222'/><text x='%d' y='42'>%s</text>\n", left, left + 12, dot
    if (ring != "")
        printf "<circle cx='%d' cy='38' r='6' fill='white' stroke='#222'/><text x='%d' y='42'>%s</text>\n", left + 270,
            left + 282, ring
    for (power = -6; power <= 6; power++)
        for (digit = 1; digit <= 3; digit += 2) {
            v = digit * exp(power * log(10))
            if (v < least * 0.999 || v > most * 1.001) continue
            printf "<path d='M%g 54V%g' stroke='#222' stroke-opacity='%g'/><text x='%g' y='%g' text-anchor='middle'>%.2g</text>\n",
                place(v), bottom, (power == 0 && digit == 1 ? 1 : 0.15), place(v), bottom + 16, v
        }
    for (i = 1; i <= NR; i++) {
        y = 70 + 22 * (i - 1)
        printf "<text x='%g' y='%g' text-anchor='end'>%s</text>", left - 14, y + 4, label[i]
        if (other[i] != "-") mark(other[i], y, "white", 6)
        printf "<path d='M%g %gH%g%s%s' stroke='#222' fill='none'/>", place(within(from[i])), y, place(within(to[i])),
            end(from[i], y), end(to[i], y)
        mark(value[i], y, "#4393c3", 4)
        print ""
    }
    printf "<text x='%g' y='%g' text-anchor='middle'>%s</text>\n</svg>\n", left + width / 2, bottom + 36, axis
}

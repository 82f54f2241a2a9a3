# chart.awk: a bar chart as SVG. Reads lines "LABEL VALUE [LOW HIGH]"; underscores in LABEL are blanks, and LOW to HIGH is
# a whisker. -v title=, -v axis=: what the values are, with unit. -v together=N: lines are "LABEL COUNT EXPECTED", of
# things that come N together; a grey band shows where most counts are, 2 standard deviations to either side.
function place(v) { return left + width * (v - low) / (high - low) }
function reach(v) { if (v < low) low = v; if (v > high) high = v }
# A step of 1, 2 or 5 times a power of ten, so that there are at most n of them.
function step_of(range, n,    power) {
    power = exp(int(log(range / n) / log(10) - 1) * log(10))
    while (range / power > n) power *= range / power / 2 <= n ? 2 : range / power / 5 <= n ? 5 : 10
    return power
}
BEGIN { left = 150; width = 360; low = high = 0 }
{
    label[NR] = $1; gsub(/_/, " ", label[NR]); value[NR] = $2 + 0; said[NR] = $2
    from[NR] = NF > 3 ? $3 + 0 : $2 + 0; to[NR] = NF > 3 ? $4 + 0 : $2 + 0
    reach(from[NR]); reach(to[NR])
    if (together) { expected[NR] = $3 + 0; all += $3 }
}
# How far from the expected count most counts of row i are; its band lies within the axis.
function spread(i) { return 2 * sqrt(together * expected[i] * (1 - expected[i] / all)) }
END {
    bottom = 34 + 22 * NR
    for (i = 1; i <= NR && together; i++) reach(expected[i] + spread(i))
    if (high == low) high = low + 1
    printf "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d' viewBox='0 0 %d %d' ", left + width + 80,
        bottom + 44, left + width + 80, bottom + 44
    print "font-family='sans-serif' font-size='13'><rect width='100%' height='100%' fill='white'/>"
    printf "<text x='10' y='18' font-weight='bold'>%s</text>\n", title
    for (i = 1; i <= NR && together; i++) {
        least = expected[i] > spread(i) ? expected[i] - spread(i) : 0
        printf "<rect x='%g' y='%d' width='%g' height='20' fill='#ddd'/>\n", place(least), 30 + 22 * (i - 1),
            place(expected[i] + spread(i)) - place(least)
    }
    step = step_of(high - low, 8)
    for (k = int(low / step); k * step <= high; k++)
        printf "<path d='M%g 28V%g' stroke='#222' stroke-opacity='%g'/><text x='%g' y='%g' text-anchor='middle'>%g</text>\n",
            place(k * step), bottom, k ? 0.15 : 1, place(k * step), bottom + 16, k * step
    for (i = 1; i <= NR; i++) {
        y = 32 + 22 * (i - 1)
        x = place(value[i]) < place(0) ? place(value[i]) : place(0)
        end = place(to[i]) > place(0) ? place(to[i]) : place(0)
        printf "<text x='%g' y='%g' text-anchor='end'>%s</text>", left - 8, y + 13, label[i]
        printf "<rect x='%g' y='%g' width='%g' height='14' fill='#4393c3'/>", x, y + 1, place(value[i]) + place(0) - 2 * x
        if (to[i] > from[i])
            printf "<path d='M%g %gH%gM%g %gv8M%g %gv8' stroke='#222'/>", place(from[i]), y + 8, place(to[i]),
                place(from[i]), y + 4, place(to[i]), y + 4
        printf "<text x='%g' y='%g'>%s</text>\n", end + 6, y + 13, said[i]
    }
    printf "<text x='%g' y='%g' text-anchor='middle'>%s</text>\n</svg>\n", left + width / 2, bottom + 36, axis
}

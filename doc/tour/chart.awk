# chart.awk: a bar chart as SVG. Reads lines "LABEL VALUE [LOW HIGH]" (underscores in LABEL are blanks; LOW to HIGH is
# drawn as a whisker); -v title=, -v unit=, -v zero=V: where bars begin; -v axis=log: a logarithmic one.
function place(v) { return left + width * ((logarithmic ? log(v) : v) - low) / (high - low) }
function reach(v) { v = logarithmic ? log(v) : v; if (v < low) low = v; if (v > high) high = v }
BEGIN { left = 150; width = 360; logarithmic = axis == "log"; low = high = logarithmic ? log(zero) : zero }
{
    label[NR] = $1; gsub(/_/, " ", label[NR]); value[NR] = $2 + 0; said[NR] = $2
    from[NR] = NF > 3 ? $3 + 0 : $2 + 0; to[NR] = NF > 3 ? $4 + 0 : $2 + 0
    reach(from[NR]); reach(to[NR])
}
END {
    if (high == low) high = low + 1
    printf "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d' viewBox='0 0 %d %d' ", left + width + 80,
        40 + 22 * NR, left + width + 80, 40 + 22 * NR
    print "font-family='sans-serif' font-size='13'><rect width='100%' height='100%' fill='white'/>"
    printf "<text x='10' y='20' font-weight='bold'>%s</text>\n", title
    base = place(zero)
    for (i = 1; i <= NR; i++) {
        y = 32 + 22 * (i - 1)
        x = place(value[i])
        end = place(to[i]) > base ? place(to[i]) : base
        printf "<text x='%g' y='%g' text-anchor='end'>%s</text>", left - 8, y + 13, label[i]
        printf("<rect x='%g' y='%g' width='%g' height='16' fill='%s'/>", x < base ? x : base, y,
            x < base ? base - x : x - base, value[i] > zero && zero > 0 ? "#d6604d" : "#4393c3")
        if (to[i] > from[i]) printf("<path d='M%g %gH%g M%g %gv8 M%g %gv8' stroke='#222'/>", place(from[i]), y + 8,
            place(to[i]), place(from[i]), y + 4, place(to[i]), y + 4)
        printf "<text x='%g' y='%g'>%s%s</text>\n", end + 6, y + 13, said[i], unit
    }
    printf "<path d='M%g 28 V%g' stroke='#222'/></svg>\n", base, 34 + 22 * NR
}

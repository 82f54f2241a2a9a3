# chart.awk: a bar chart as SVG. Reads lines "LABEL VALUE" (underscores in LABEL are blanks); -v title=, -v unit=,
# -v zero=V: where bars begin.
{ label[NR] = $1; gsub(/_/, " ", label[NR]); value[NR] = $2 + 0; said[NR] = $2 }
NR == 1 || value[NR] < low { low = value[NR] }
NR == 1 || value[NR] > high { high = value[NR] }
END {
    if (zero < low) low = zero
    if (zero > high) high = zero
    if (high == low) high = low + 1
    left = 150; width = 360
    printf "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d' viewBox='0 0 %d %d' ", left + width + 80,
        40 + 22 * NR, left + width + 80, 40 + 22 * NR
    print "font-family='sans-serif' font-size='13'><rect width='100%' height='100%' fill='white'/>"
    printf "<text x='10' y='20' font-weight='bold'>%s</text>\n", title
    base = left + width * (zero - low) / (high - low)
    for (i = 1; i <= NR; i++) {
        y = 32 + 22 * (i - 1)
        x = left + width * (value[i] - low) / (high - low)
        printf "<text x='%g' y='%g' text-anchor='end'>%s</text>", left - 8, y + 13, label[i]
        printf("<rect x='%g' y='%g' width='%g' height='16' fill='%s'/>", x < base ? x : base, y,
            x < base ? base - x : x - base, value[i] > zero && zero > 0 ? "#d6604d" : "#4393c3")
        printf "<text x='%g' y='%g'>%s%s</text>\n", (x > base ? x : base) + 5, y + 13, said[i], unit
    }
    printf "<path d='M%g 28 V%g' stroke='#222'/></svg>\n", base, 34 + 22 * NR
}

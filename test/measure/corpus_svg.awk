# corpus_svg.awk: a dot for each scene on a logarithmic axis, as SVG. Reads the lines of corpus.awk with scores=yes.
# Bands by what the race has chosen, sorted in each; a ring is a scene of `report`. The numbers are those of the three
# worst, the worst first.
#   -v column=4  asbdpt over the better of pt and bdpt (the default); 5: pt over bdpt, in one band
BEGIN { if (!column) column = 4; left = 120; width = 640; step = 5; low = 0.1; high = 10 }
$column > 0 {
    band = column == 4 ? $3 : "all"
    if (!(band in size)) order[++n_bands] = band
    size[band]++
    value[band, size[band]] = $column + 0
    name[band, size[band]] = $1
    report[band, size[band]] = $2 == "report"
    while ($column < low) low /= 10
    while ($column > high) high *= 10
}
function place(v) { return left + width * log(v / low) / log(high / low) }
function swap(a, i, j,    t) { t = a[band, i]; a[band, i] = a[band, j]; a[band, j] = t }
END {
    axis = "error x CPU time of " (column == 4 ? "asbdpt over the better of pt and bdpt" : "pt over bdpt")
    for (b = 1; b <= n_bands; b++) height += size[order[b]] * step + 24
    printf "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d' viewBox='0 0 %d %d' " \
        "font-family='sans-serif' font-size='12'><rect width='100%%' height='100%%' fill='white'/>\n",
        left + width + 60, height + 60, left + width + 60, height + 60
    for (v = low; v < high * 1.01; v *= 10)
        printf "<path d='M%g 10V%g' stroke='#ddd'/><text x='%g' y='%g' text-anchor='middle'>%g</text>\n", place(v),
            height + 14, place(v), height + 30, v
    printf "<path d='M%g 10V%g' stroke='#222'/>\n", place(1), height + 14
    y = 14
    for (b = 1; b <= n_bands; b++) {
        band = order[b]
        n = size[band]
        for (i = 2; i <= n; i++)
            for (j = i; j > 1 && value[band, j - 1] > value[band, j]; j--) {
                swap(value, j, j - 1); swap(name, j, j - 1); swap(report, j, j - 1)
            }
        printf "<text x='10' y='%g'>%s</text>", y + 16, band
        printf "<text x='10' y='%g' fill='#666'>%d scenes</text>\n", y + 30, n
        for (i = 1; i <= n; i++) {
            y += step
            colour = value[band, i] > 1.15 ? "#b2182b" : value[band, i] < 0.87 ? "#2166ac" : "#888"
            printf "<circle cx='%g' cy='%g' r='2.5' stroke='%s' fill='%s'/>", place(value[band, i]), y, colour,
                report[band, i] ? "white" : colour
            if (column == 4 && value[band, i] > 1.15 && i > n - 3) worst = name[band, i] (worst ? ", " : "") worst
            print ""
        }
        if (worst) printf "<text x='%g' y='%g' font-size='10'>%s</text>\n", place(value[band, n]) + 6, y + 4, worst
        worst = ""
        y += 24
        printf "<path d='M0 %gH%g' stroke='#eee'/>\n", y - 8, left + width + 60
    }
    printf "<text x='%g' y='%g' text-anchor='middle'>%s</text>\n</svg>\n", left + width / 2, height + 50, axis
}

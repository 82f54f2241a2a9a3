# alias.awk: draws how Vose's method fills an alias table (src/base/alias.c: pair_up), a picture a step, as SVG.
#   awk -v weights="5 1 3 2 1" -f alias.awk </dev/null >alias.svg
function bar(x, y, from, to, who) {
    printf "<rect x='%g' y='%g' width='30' height='%g' fill='%s' stroke='#222'/>", x, y - 60 * to, 60 * (to - from),
        colour[who]
    if (to - from > 0.3)
        printf "<text x='%g' y='%g' text-anchor='middle'>%d</text>", x + 15, y - 30 * (to + from) + 4, who
    print ""
}
# step TEXT: all bins as they are now, and both lists.
function step(text,    i, x) {
    top += 190
    printf "<text x='10' y='%g' font-weight='bold'>%s</text>\n", top - 160, text
    for (i = 0; i < n; i++) {
        x = 10 + 44 * i
        printf "<path d='M%g %g h38' stroke='#888' stroke-dasharray='3'/>\n", x - 4, top - 70
        if (done[i] && threshold[i] < 1) {
            bar(x, top - 10, 0, threshold[i], i)
            bar(x, top - 10, threshold[i], 1, other[i])
        } else
            bar(x, top - 10, 0, threshold[i], i)
    }
    printf "<text x='%g' y='%g'>small:%s</text>\n", 30 + 44 * n, top - 70, list(small, n_small)
    printf "<text x='%g' y='%g'>large:%s</text>\n", 30 + 44 * n, top - 50, list(large, n_large)
}
function list(a, count,    i, text) {
    for (i = 0; i < count; i++) text = text " " a[i]
    return text == "" ? " none" : text
}
END {
    n = split(weights, w, " ")
    split("#f4a582 #92c5de #b8e186 #fddbc7 #d1b3e6 #ffe08a #c7c7c7 #80cdc1", palette, " ")
    for (i = 0; i < n; i++) { sum += w[i + 1]; colour[i] = palette[i % 8 + 1] }
    steps = n + 1
    printf "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d' viewBox='0 0 %d %d' ", 44 * n + 300,
        190 * steps, 44 * n + 300, 190 * steps
    print "font-family='sans-serif' font-size='13'><rect width='100%' height='100%' fill='white'/>"
    for (i = 0; i < n; i++) {
        threshold[i] = w[i + 1] * n / sum
        if (threshold[i] < 1) small[n_small++] = i
        else large[n_large++] = i
    }
    step("weights " weights ", in units of the mean; the dashed line is 1")
    while (n_small > 0 && n_large > 0) {
        s = small[--n_small]
        l = large[n_large - 1]
        other[s] = l
        done[s] = 1
        threshold[l] += threshold[s] - 1
        if (threshold[l] < 1) { n_large--; small[n_small++] = l }
        step("bin " s ": " s " is too small; " l " fills it up and keeps " sprintf("%.2f", threshold[l]))
    }
    while (n_small > 0) { s = small[--n_small]; threshold[s] = 1; done[s] = 1 }
    while (n_large > 0) { l = large[--n_large]; threshold[l] = 1; done[l] = 1 }
    step("the remaining item weighs 1, except for rounding: threshold 1")
    print "</svg>"
}

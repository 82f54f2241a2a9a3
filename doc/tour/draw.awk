# draw.awk: a drawing as SVG, from lines of words; lengths in pixels, y downwards, # begins a comment:
#   size W H | line CLASS X Y X Y ... | dash ... | arrow CLASS X Y X Y ... | dot CLASS X Y | box CLASS X Y W H
#   shape CLASS X Y X Y ... | arc CLASS X Y R FROM TO (degrees, counterclockwise) | text WHERE X Y WORDS (left, middle, right, bold)
# Classes are colours: eye, light, link, ink, grey, pale, wall. In texts x_0 and d^2 have indices (indices.awk).
BEGIN {
    split("eye #1d5fbf light #c96f00 link #23823b ink #222 grey #888 pale #e8e8e8 wall #555 warm #fbe3c2 cool #d6e4f7 leaf #d9efdd", c, " ")
    for (i = 1; i in c; i += 2) colour[c[i]] = c[i + 1]
}
/^ *(#|$)/ { next }
$1 == "size" {
    printf "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %d %d' width='%d' height='%d' font-family='sans-serif' font-size='13'>\n", $2, $3, $2, $3
    print "<rect width='100%' height='100%' fill='white'/>"
    next
}
$1 == "line" || $1 == "dash" || $1 == "arrow" || $1 == "shape" {
    d = "M" $3 " " $4
    for (i = 5; i < NF; i += 2) d = d "L" $i " " $(i + 1)
    printf "<path d='%s' fill='%s' stroke='%s' stroke-width='%s'%s/>\n", ($1 == "shape" ? d "Z" : d),
        ($1 == "shape" ? colour[$2] : "none"), ($1 == "shape" ? "none" : colour[$2]),
        ($2 == "wall" ? 3 : $2 == "link" ? 2.5 : 1.6), ($1 == "dash" ? " stroke-dasharray='4 4'" : "")
    if ($1 == "arrow") { # its head, along the last piece
        dx = $(NF - 1) - $(NF - 3); dy = $NF - $(NF - 2); l = sqrt(dx * dx + dy * dy); dx /= l; dy /= l
        printf "<path d='M%g %gL%g %gL%g %gZ' fill='%s'/>\n", $(NF - 1), $NF, $(NF - 1) - 9 * dx + 4 * dy, $NF - 9 * dy - 4 * dx,
            $(NF - 1) - 9 * dx - 4 * dy, $NF - 9 * dy + 4 * dx, colour[$2]
    }
    next
}
$1 == "dot" { printf "<circle cx='%g' cy='%g' r='5' fill='%s'/>\n", $3, $4, colour[$2]; next }
$1 == "box" {
    printf "<rect x='%g' y='%g' width='%g' height='%g' fill='%s' stroke='#888'/>\n", $3, $4, $5, $6,
        ($2 == "none" ? "none" : colour[$2])
    next
}
$1 == "arc" {
    f = $6 * 3.14159265 / 180; t = $7 * 3.14159265 / 180
    printf "<path d='M%.1f %.1fA%g %g 0 0 0 %.1f %.1f' fill='none' stroke='%s' stroke-width='1.6'/>\n", $3 + $5 * cos(f), $4 - $5 * sin(f),
        $5, $5, $3 + $5 * cos(t), $4 - $5 * sin(t), colour[$2]
    next
}
$1 == "text" {
    words = $0
    sub(/^ *text +[a-z]+ +[-0-9.]+ +[-0-9.]+ +/, "", words)
    printf "<text x='%g' y='%g'%s>%s</text>\n", $3, $4, ($2 == "middle" ? " text-anchor='middle'" : \
        $2 == "right" ? " text-anchor='end'" : $2 == "bold" ? " font-weight='bold'" : ""), indices(words)
    next
}
{ print "draw.awk: line " NR ": what is " $1 "?" > "/dev/stderr"; bad = 1; exit 1 }
END { if (!bad) print "</svg>"; exit bad }

# family.awk: draws what each method connects an eye sub-path to, and by which choice, as SVG.
#   awk -f indices.awk -f family.awk </dev/null >family.svg
function source(key, text, note, stroke) {
    name[++sources] = key; words[key] = text; under[key] = note; colour[key] = stroke
}
function method(from, text, choice) {
    of[++methods] = from; label[methods] = text; how[methods] = choice; n[from]++; last[from] = methods
}
END {
    source("light", "points on lights", "s = 1", "#8a6a00")
    source("own", "a light sub-path of its own", "y_0 y_1 ... y_(s-1)", "#3d444d")
    source("paths", "K light sub-paths", "a tile shares them", "#0b62a8")
    source("vertices", "their V vertices", "each with the sub-path before it", "#12733a")
    source("eye", "vertices of its neighbours", "eye sub-paths of the tile", "#6a3d9a")
    source("state", "the previous sample", "a Markov chain", "#b3400a")
    method("light", "pt", "one point; the light by its power")
    method("light", "restir", "one of M, then one of N + 1 pixels'")
    method("light", "ellipse", "with one vertex between, on an ellipsoid")
    method("light", "caustics", "also through mirrors and glass")
    method("light", "ppg", "as pt; directions by the light that they met")
    method("own", "lt", "its vertices, connected to the lens: t = 1")
    method("own", "bdpt", "no choice: a new one each time")
    method("own", "bins", "one of two kept ones, by beta^2: biased")
    method("own", "regularise", "a new one; mirrors are blurred: biased")
    method("paths", "pool", "q_k, by importance: weight 1 / (K q_k)")
    method("paths", "cbdpt", "M of them, in all pairs: 1 / M")
    method("paths", "mbdpt", "a lattice over pairs sorted by length")
    method("vertices", "lvc", "1 / V")
    method("vertices", "vertices", "L_v h(x_v): worth of a place")
    method("vertices", "subspaces", "L_v h(e,l): worth of a place to a place")
    method("vertices", "pcbdpt", "mean of 1 / V and of three records")
    method("vertices", "ris", "by one record; weights depend on it")
    method("vertices", "ris2", "M2 by L_v, then as ris")
    method("vertices", "spcbpt", "subspace by Gamma(e,l), then L_v")
    method("vertices", "vcm", "as bdpt, and merges with all nearby: biased")
    method("eye", "restirgi", "one second vertex of N + 1 pixels")
    method("eye", "pathgraph", "all M of a cluster; biased")
    method("state", "pssmlt", "all its numbers, changed a little")
    method("state", "mmlt", "one strategy's numbers, changed a little")
    method("state", "mlt", "a path, a part of its vertices kept")
    print "<svg xmlns='http://www.w3.org/2000/svg' width='740' height='730' viewBox='0 0 740 730' " \
        "font-family='sans-serif' font-size='13'><rect width='100%' height='100%' fill='white'/>"
    print "<text x='12' y='22' font-weight='bold'>an eye sub-path is connected to</text>" \
        "<text x='300' y='22' font-weight='bold'>method</text><text x='392' y='22' font-weight='bold'>choice</text>"
    for (i = 1; i <= methods; i++) { # a gap of 10 between sources
        if (of[i] != of[i - 1]) gap += 10
        y[i] = 26 * i + gap + 8
        middle[of[i]] += y[i] / n[of[i]]
    }
    for (i = 1; i <= sources; i++) {
        key = name[i]
        printf "<rect x='12' y='%g' width='190' height='40' rx='4' fill='white' stroke='%s' stroke-width='2'/>" \
            "<text x='20' y='%g'>%s</text><text x='20' y='%g' font-size='11' fill='#555'>%s</text>\n",
            middle[key] - 24, colour[key], middle[key] - 7, words[key], middle[key] + 9, indices(under[key])
    }
    for (i = 1; i <= methods; i++) {
        key = of[i]
        printf "<path d='M202 %g C250 %g 250 %g 294 %g' fill='none' stroke='%s' stroke-width='2'/>" \
            "<text x='300' y='%g' font-weight='bold'>%s</text><text x='392' y='%g'>%s</text>\n", middle[key] - 4,
            middle[key] - 4, y[i] - 4, y[i] - 4, colour[key], y[i], label[i], y[i], indices(how[i])
    }
    print "</svg>"
}

# indices.awk: the words of a drawing as SVG text: x_0, y_(s-1), d^2 and beta_0^2 have indices, beta and theta are Greek.
function indices(words,    out, name, n) {
    gsub(/&/, "\\&amp;", words); gsub(/</, "\\&lt;", words)
    gsub(/beta/, "\\&#946;", words); gsub(/theta/, "\\&#952;", words); gsub(/sigma/, "\\&#963;", words); gsub(/sqrt/, "\\&#8730;", words)
    while (match(words, /(^|[^A-Za-z_])[A-Za-z;)][_^](\([^()]*\)|[A-Za-z0-9]+)/)) { # longer names are the program's
        name = substr(words, RSTART, RLENGTH)
        out = out substr(words, 1, RSTART - 1)
        words = substr(words, RSTART + RLENGTH)
        n = match(name, /[_^]/)
        out = out substr(name, 1, n - 1) moved(substr(name, n))
        if (match(words, /^\^[0-9]+/)) {
            out = out moved(substr(words, 1, RLENGTH))
            words = substr(words, RLENGTH + 1)
        }
    }
    return out words
}
function moved(index_,    by) {
    by = substr(index_, 1, 1) == "_" ? 4 : -5
    gsub(/^[_^]\(?|\)$/, "", index_)
    return "<tspan dy='" by "' font-size='10'>" index_ "</tspan><tspan dy='" (-by) "'>&#8203;</tspan>"
}

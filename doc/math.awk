# math.awk: a formula in plain text as MathML, for html.awk: p_s, y_(s-1), x^2, a / b, sqrt(x), sum_k, |cos theta|, beta.
#
# A product before a slash is the numerator; the denominator is what follows, up to the next blank. Words that are no names
# of quantities stay words. math_block(text) is the HTML of some lines; three blanks or more begin another column.

function math_init(    i, n, pair, greek, part) {
    n = split("beta:03B2 theta:03B8 kappa:03BA delta:03B4 eta:03B7 pi:03C0 eps:03B5 rho:03C1 phi:03C6 sigma:03C3 alpha:03B1 lambda:03BB", greek, " ")
    for (i = 1; i <= n; i++) { split(greek[i], part, ":"); MI[part[1]] = "&#x" part[2] ";" }
    n = split("cos sin tan min max floor log exp luminance var mean mis pdf rev dx dA dw", pair, " ")
    for (i = 1; i <= n; i++) MI[pair[i]] = pair[i]
    ready = 1
}

# Tokens of a chunk: T[1..N], blanks before each in B.
function math_tokens(s,    text, n) {
    N = 0
    while (s != "") {
        match(s, /^ */); n = RLENGTH
        s = substr(s, n + 1)
        if (s == "") break
        if (match(s, /^(<=|>=|\.\.\.|->)/) || match(s, /^[A-Za-z]+/) || match(s, /^[0-9]+(\.[0-9]+)?/)) text = substr(s, 1, RLENGTH)
        else text = substr(s, 1, 1)
        T[++N] = text; B[N] = n
        s = substr(s, length(text) + 1)
    }
    T[N + 1] = ""
}
function math_entity(c) {
    if (c == "<") return "&lt;"
    if (c == ">") return "&gt;"
    if (c == "<=") return "&#x2264;"
    if (c == ">=") return "&#x2265;"
    if (c == "...") return "&#x2026;"
    if (c == "->") return "&#x2192;"
    if (c == "-") return "&#x2212;"
    if (c == "*") return "&#x22C5;"
    if (c == "&") return "&amp;"
    return c
}
function is_text(i) { return T[i] ~ /^[A-Za-z][A-Za-z]+$/ && !(T[i] in MI) && T[i] !~ /^(integral|prod|sqrt|wi|wo|ns|ng)$/ && T[i + 1] !~ /^[_^]$/ }

# From token I on, up to `closer`: terms and the signs between them.
function math_terms(closer,    out) {
    while (I <= N && T[I] != closer) {
        if (math_begins(I)) out = out math_product(closer)
        else { out = out "<mo>" math_entity(T[I]) "</mo>"; I++ }
    }
    return out
}
function math_begins(i) { return T[i] ~ /^[A-Za-z0-9([]/ || math_opens(i) }
# |x|: a bar that something follows at once, and nothing stands right before.
function math_opens(i) { return T[i] == "|" && !inside && B[i + 1] == 0 && (B[i] > 0 || i == 1 || T[i - 1] ~ /^[(=]$/) }

function math_product(closer,    out, top, n) {
    while (I <= N && T[I] != closer) {
        if (math_sums(I)) {
            out = out top math_sign(); top = ""; n = 0
        } else if (is_text(I)) { # words are no part of a fraction, unless a slash follows
            out = out top; top = math_factor()
            n = T[I] == "/"
            if (!n) { out = out top; top = "" }
        } else if (T[I] == "/") {
            I++
            if (n == 1) top = math_bare(top)
            top = "<mfrac><mrow>" top "</mrow><mrow>" math_bare(math_factor()) "</mrow></mfrac>"
            n = 2
        } else if (math_begins(I)) {
            if (top ~ /^<mfrac>.*<\/mfrac>$/) { out = out top "<mspace width=\"0.17em\"/>"; top = ""; n = 0 } # what follows is beside it
            top = top (n++ > 0 ? "<mspace width=\"0.17em\"/>" : "") math_factor()
        } else break
    }
    return out top
}
# A sum or integral of a quantity, which has an index or stands before one: "sum over draws" is words.
function math_sums(i) { return T[i] ~ /^(integral|prod)$/ || T[i] == "sum" && (T[i + 1] == "_" || !is_text(i + 1)) }
function math_sign(    out) {
    out = "<mo>" (T[I] == "sum" ? "&#x2211;" : T[I] == "prod" ? "&#x220F;" : "&#x222B;") "</mo>"
    I++
    if (T[I] == "_") { I++; out = out math_index() } else return out
    if (T[I] != "^") return "<munder>" out "</munder>"
    I++
    return "<munderover>" out math_index() "</munderover>"
}
# A group without its parentheses, which a fraction does not need.
function math_bare(s) {
    if (s !~ /^<mrow class="group">/ || s !~ /<\/mrow>$/) return s
    sub(/^<mrow class="group"><mo>\(<\/mo>/, "", s); sub(/<mo>\)<\/mo><\/mrow>$/, "", s)
    return s
}
# What _ and ^ are followed by: a group, or a word.
function math_index(    out) {
    if (T[I] == "(") { I++; out = math_terms(")"); I++ }
    else { out = T[I] ~ /^[0-9]/ ? "<mn>" T[I] "</mn>" : "<mi>" ((T[I] in MI) ? MI[T[I]] : T[I]) "</mi>"; I++
        if (T[I] ~ /^[0-9]+$/ && B[I] == 0) { out = out "<mn>" T[I] "</mn>"; I++ } }
    return "<mrow>" out "</mrow>"
}
function math_factor(    out, low, high, kept) {
    if (math_sums(I)) return math_sign() math_product("")
    if (T[I] == "sqrt" && T[I + 1] == "(") { I += 2; out = "<msqrt>" math_terms(")") "</msqrt>"; I++ }
    else if (T[I] == "(" || T[I] == "[") {
        kept = T[I++] == "(" ? ")" : "]"
        out = math_terms(kept); I++
        if (kept == "]" || out !~ /^<mfrac>.*<\/mfrac>$/ || gsub(/<mfrac>/, "<mfrac>", out) > 1)
            out = "<mrow class=\"group\"><mo>" (kept == ")" ? "(" : "[") "</mo>" out "<mo>" kept "</mo></mrow>"
    } else if (T[I] == "|") { I++; inside = 1; out = "<mrow><mo>|</mo>" math_terms("|") "<mo>|</mo></mrow>"; inside = 0; I++ }
    else if (T[I] ~ /^[0-9]/) out = "<mn>" T[I++] "</mn>"
    else if (T[I] ~ /^(wi|wo|ns|ng)$/) {
        out = "<msub><mi>" substr(T[I], 1, 1) "</mi><mi>" substr(T[I], 2) "</mi></msub>"
        I++
    }
    else if (is_text(I)) {
        out = T[I++]
        while (I <= N && B[I] > 0 && (is_text(I) || (T[I] == "a" && is_text(I + 1)))) out = out "&#xA0;" T[I++]
        return "<mtext>&#xA0;" out "&#xA0;</mtext>"
    } else { out = "<mi>" ((T[I] in MI) ? MI[T[I]] : T[I]) "</mi>"; I++ }
    if (T[I] == "'" && B[I] == 0) { out = "<msup>" out "<mo>&#x2032;</mo></msup>"; I++ }
    if (T[I] == "_" ) { I++; low = math_index() }
    if (T[I] == "^") { I++; high = math_index() }
    if (T[I] == "*" && B[I] == 0 && (T[I + 1] == "(" || B[I + 1] > 0 || I == N)) { I++; high = "<mo>*</mo>" }
    if (low != "" && high != "") out = "<msubsup>" out low high "</msubsup>"
    else if (low != "") out = "<msub>" out low "</msub>"
    else if (high != "") out = "<msup>" out high "</msup>"
    if (T[I] == "(" && B[I] == 0) { I++; out = "<mrow>" out "<mo>(</mo>" math_terms(")") "<mo>)</mo></mrow>"; I++ }
    return out
}
function math_chunk(s,    i, words) {
    math_tokens(s)
    for (i = 1; i <= N; i++) words += is_text(i)
    if (s ~ /^\[[A-Z][A-Za-z]*[0-9]/ || (words > N / 2 && s !~ /[=<]/)) return ""
    I = 1; inside = 0
    return "<math displaystyle=\"true\">" math_terms("") "</math>"
}
function math_block(text,    line, n, i, rest, chunk, cell, out) {
    if (!ready) math_init()
    n = split(text, line, "\n")
    out = "<div class=\"wide\"><table class=\"math\">"
    for (i = 1; i <= n; i++) {
        out = out "<tr>"
        rest = line[i]
        sub(/^ +/, "", rest)
        while (rest != "") {
            chunk = match(rest, /   +/) ? substr(rest, 1, RSTART - 1) : rest
            rest = match(rest, /   +/) ? substr(rest, RSTART + RLENGTH) : ""
            cell = math_chunk(chunk)
            out = out "<td>" (cell != "" ? cell : formula(escape(chunk), 0)) "</td>"
        }
        out = out "</tr>"
    }
    return out "</table></div>"
}

# x_0, y_(s-1), m^2 of escaped text; names of two letters or more before an underscore are operators or functions.
function formula(s, in_text,    out, base, index_, mark) {
    gsub(/&lt;=/, "\\&le;", s); gsub(/&gt;=/, "\\&ge;", s)
    if (!in_text) {
        gsub(/\.\.\./, "\\&hellip;", s)
        s = word(s, "integral", "\\&int;")
        gsub(/sqrt\(/, "\\&radic;(", s)
    } else { # a mirror's density is a word
        gsub(/a delta/, "a del\003ta", s); gsub(/called delta/, "called del\003ta", s); gsub(/<em>delta/, "<em>del\003ta", s)
        gsub(/<strong>delta/, "<strong>del\003ta", s)
    }
    s = word(s, "delta", "\\&delta;"); s = word(s, "kappa", "\\&kappa;")
    gsub(/\003/, "", s)
    s = word(s, "sum_", "\\&Sigma;_"); s = word(s, "beta", "\\&beta;"); s = word(s, "theta", "\\&theta;")
    s = word(s, "eta", "\\&eta;"); s = word(s, "pi", "\\&pi;"); s = word(s, "sigma", "\\&sigma;")
    while (match(s, /[A-Za-z*;)][_^](\([^()]*\)|[A-Za-z0-9]+)/)) {
        base = substr(s, RSTART, 1)
        mark = substr(s, RSTART + 1, 1) == "_" ? "sub" : "sup"
        index_ = substr(s, RSTART + 2, RLENGTH - 2)
        if (index_ ~ /^\(/) index_ = substr(index_, 2, length(index_) - 2)
        out = out substr(s, 1, RSTART - 1) base "<" mark ">" index_ "</" mark ">"
        s = substr(s, RSTART + RLENGTH)
        if (match(s, /^\^[0-9]/)) { out = out "<sup>" substr(s, 2, 1) "</sup>"; s = substr(s, 3) }
    }
    return out s
}
# Replace a name that is no part of a longer one; what follows may be an index.
function word(s, name, with,    out, before, after, at, w) {
    w = with
    gsub(/\\/, "", w)
    while (at = index(s, name)) {
        before = at > 1 ? substr(s, at - 1, 1) : " "
        after = substr(s, at + length(name), 1)
        out = out substr(s, 1, at - 1) (before ~ /[A-Za-z&]/ || (after ~ /[A-Za-z;]/ && name !~ /_$/) ? name : w)
        s = substr(s, at + length(name))
    }
    return out s
}

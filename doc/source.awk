# source.awk: sources in C as pages to read: every name leads to its definition, comments are set as text, and the line
# that computes a formula of the tour has it above. Run from the top; the folders of OUT exist:
#   awk -v out=OUT -v marks=FILE -f doc/math.awk -f doc/frame.awk -f doc/source.awk FILE...
# marks is what doc/marks.awk writes. All files are read first. A name is then looked up in its own file, and else among
# what the others of src offer; a field in the type of what stands before its dot or arrow, or if that is not known, where
# only one type has it. Relies on the form of the sources: what begins in column 0 is at file scope.

# ---- what is defined where: a place is FILE SUBSEP LINE ----
function define(name, offered, type,    place) {
    place = FILENAME SUBSEP FNR
    if (!((FILENAME, name) in OWN)) OWN[FILENAME, name] = place
    if (offered && FILENAME ~ /^src/ && !(name in ALL)) ALL[name] = place
    TYPE[place, name] = type
}
# The struct that a text names first, or "". Those of a source file are its own.
function type_in(file, s) { return match(s, /struct [A-Za-z0-9_]+/) ? type_key(file, substr(s, RSTART + 7, RLENGTH - 7)) : "" }
function type_key(file, tag) { return file !~ /\.h$/ && (file, "struct " tag) in OWN ? file ":" tag : tag }

function last_word(s) { sub(/[^A-Za-z0-9_]*$/, "", s); return match(s, /[A-Za-z0-9_]+$/) ? substr(s, RSTART) : "" }
function constants(s,    n, i, part) {
    gsub(/=[^,]*/, "", s)
    n = split(s, part, ",")
    for (i = 1; i <= n; i++) if (part[i] ~ /[A-Z]/) define(last_word(part[i]), FILENAME ~ /\.h$/)
}
function fields(s,    n, i, part, name, type) {
    type = type_in(FILENAME, s)
    if (match(s, /\(\*[a-z_]+\)/)) { # a function, whose parameters may need more lines
        part[1] = substr(s, RSTART, RLENGTH)
        n = 1
        open = s !~ /;/
    } else {
        if (open) { open = s !~ /;/; return }
        gsub(/\[[^]]*\]|:.*/, "", s)
        if (!sub(/;.*/, "", s)) return
        n = split(s, part, ",")
    }
    for (i = 1; i <= n; i++) {
        name = last_word(part[i])
        FIELD[body, name] = FILENAME SUBSEP FNR
        FIELD_TYPE[body, name] = type
        if (FILENAME !~ /^src/) continue
        if (!(name in SOLE)) SOLE[name] = body
        else if (SOLE[name] != body) SOLE[name] = ""
    }
}
# A line without comments and texts.
function collect(s,    header, name, tag) {
    header = FILENAME ~ /\.h$/
    if (body != "") {
        if (s ~ /^}/) { if (s ~ /^} [a-z]/) typedef(last_word(s)); body = "" }
        else if (body == "enum") constants(s)
        else fields(s)
    } else if (match(s, /^#define [A-Za-z0-9_]+/)) define(substr(s, 9, RLENGTH - 8), header)
    else if (match(s, /^(typedef |static |const )*(struct|union|enum)( [A-Za-z0-9_]+)? \{/)) {
        tag = substr(s, 1, RLENGTH)
        if (tag ~ /[a-z0-9_]+ [A-Za-z0-9_]+ \{/) define("struct " last_word(tag), header)
        s = substr(s, RLENGTH + 1)
        body = tag ~ /enum/ ? "enum" : type_key(FILENAME, last_word(tag))
        if (s ~ /}/) { sub(/}.*/, "", s); if (body == "enum") constants(s); else fields(s); body = "" }
    } else if (match(s, /^[a-z][A-Za-z0-9_ *]*[ *][A-Za-z0-9_]+\(/)) {
        name = last_word(substr(s, 1, RLENGTH - 1))
        if (s ~ /^typedef/) typedef(name)
        else if (s ~ /;$/ || header && s !~ /^static/) { if (header) DECLARED[name] = FILENAME SUBSEP FNR }
        else define(name, header || s !~ /^static/, type_in(FILENAME, substr(s, 1, RLENGTH)))
    } else if (s !~ /^extern/ && match(s, /^[a-z][A-Za-z0-9_ *]*[ *][A-Za-z0-9_]+(\[[^]]*\])* *[=;]/)) {
        name = substr(s, 1, RLENGTH)
        sub(/\[.*/, "", name)
        if (s !~ /^struct [a-z_]+;/) define(last_word(name), header || s !~ /^static/, type_in(FILENAME, s))
    }
}
function typedef(name) { define(name, FILENAME ~ /\.h$/); IS_TYPE[name] = 1 }

# ---- pieces of a line ----
# The length of the first piece, and its KIND.
function piece(s,    at) {
    KIND = "comment"
    if (commented || s ~ /^\/\*/) {
        at = index(substr(s, commented ? 1 : 3), "*/")
        commented = !at
        return at ? at + (substr(s, 1, 2) == "/*" ? 3 : 1) : length(s)
    }
    KIND = "word"
    if (match(s, /^[A-Za-z_][A-Za-z0-9_]*/)) return RLENGTH
    KIND = "other"
    if (match(s, /^[ \t]+/) || match(s, /^[0-9][0-9A-Za-z_.]*/)) return RLENGTH
    KIND = "text"
    if (match(s, /^"([^"\\]|\\.)*"/) || match(s, /^'([^'\\]|\\.)*'/)) return RLENGTH
    KIND = "sign"
    return s ~ /^->/ ? 2 : 1
}
function bare(s,    i, out) {
    while (s != "") {
        i = piece(s)
        out = out (KIND == "comment" ? "" : KIND == "text" ? "\"\"" : substr(s, 1, i))
        s = substr(s, i + 1)
    }
    sub(/ +$/, "", out)
    return out
}

# ---- links ----
function way(place,    part) {
    split(place, part, SUBSEP)
    return (part[1] == file ? "" : root "/" part[1] ".html") "#L" part[2]
}
function linked(text, place) { return place == "" || place == file SUBSEP now ? text : "<a href=\"" way(place) "\">" text "</a>" }
function place_of(name,    place) {
    place = (file, name) in OWN ? OWN[file, name] : name in ALL ? ALL[name] : DECLARED[name]
    return place == file SUBSEP now ? DECLARED[name] : place
}
# A word of code. PREV: the piece before it; WHAT: the struct that what has been read of an expression is; DECLARING: that of
# variables that are being declared between brackets of depth AT, VAR: of those that have been; LAST: that of an initialiser.
function word_of(w, rest,    type) {
    if (is_keyword(w) || w in IS_TYPE) {
        if (w != "const") DECLARING = ""
        return is_keyword(w) ? "<b>" w "</b>" : linked(w, place_of(w))
    }
    if (PREV ~ /^(struct|union|enum)$/) {
        LAST = DECLARING = type_key(file, w)
        TAG = w
        AT = DEPTH
        return linked(w, place_of("struct " w))
    }
    if (PREV ~ /^(\.|->)$/) {
        type = (DOTTED, w) in FIELD ? DOTTED : SOLE[w]
        WHAT = FIELD_TYPE[type, w]
        return linked(w, FIELD[type, w])
    }
    if (DECLARING != "" && DEPTH == AT && rest !~ /^\(/ && (PREV == TAG || PREV ~ /^([*,]|const)$/)) VAR[w] = DECLARING
    if (w in VAR) { WHAT = VAR[w]; return w }
    type = place_of(w)
    WHAT = TYPE[type, w]
    return DEPTH > 0 && rest !~ /^\(/ && w !~ /_|[A-Z]/ ? w : linked(w, type) # a variable of a block may have a function's name
}
function sign_of(c) {
    if (c == "." || c == "->") DOTTED = PREV ~ /^[{,(]$/ ? LAST : WHAT
    else if (c ~ /^[({[]$/) { BEFORE[++DEPTH] = WHAT; WHAT = "" }
    else if (c ~ /^[])}]$/) { WHAT = BEFORE[DEPTH--]; if (DEPTH < AT) DECLARING = "" }
    else WHAT = ""
    if (c ~ /^[;{}]$/) DECLARING = ""
    return escape(c)
}
# Text of comments: names of files, and names with an underscore, lead to them.
function prose(s,    out, w, place, tag) {
    while (match(s, /[A-Za-z_][A-Za-z0-9_]*(\.[ch])?/)) {
        w = substr(s, RSTART, RLENGTH)
        out = out escape(substr(s, 1, RSTART - 1))
        place = out ~ /(struct|enum) $/ ? place_of("struct " w) : w ~ /_/ ? place_of(w) : ""
        if (w ~ /\.[ch]$/ && NAMED[w] != "" && NAMED[w] != file) place = NAMED[w] SUBSEP 1
        out = out linked(w, place)
        s = substr(s, RSTART + RLENGTH)
    }
    out = out escape(s)
    while (match(out, /`[^`]+`| \*[a-z]+\*/)) {
        tag = substr(out, RSTART, 1) == " " ? "em" : "code"
        w = substr(out, RSTART, RLENGTH)
        gsub(/[`*]/, "", w)
        out = substr(out, 1, RSTART - 1) "<" tag ">" w "</" tag ">" substr(out, RSTART + RLENGTH)
    }
    return out
}

# ---- pages ----
function code(s,    i, out, part) {
    if (match(s, /^#include "[^"]*"/)) {
        part = "src/" substr(s, 11, RLENGTH - 11)
        s = substr(s, RLENGTH + 1)
        return "<b>#include</b> \"" linked(substr(part, 5), part in LINES ? part SUBSEP 1 : "") "\"" prose(s)
    }
    if (match(s, /^# *[a-z]+/)) {
        out = "<b>" substr(s, 1, RLENGTH) "</b>"
        s = substr(s, RLENGTH + 1)
        if (out !~ /define/) return out prose(s)
    }
    if (s ~ /^[a-z]/ && DEPTH == 0) for (i in VAR) delete VAR[i]
    while (s != "") {
        i = piece(s)
        part = substr(s, 1, i)
        s = substr(s, i + 1)
        if (KIND == "comment") { # blanks before it are those of code
            match(part, /^ */)
            out = out substr(part, 1, RLENGTH) "<i>" prose(substr(part, RLENGTH + 1)) "</i>"
        }
        else if (KIND == "word") out = out word_of(part, s)
        else if (KIND == "sign") out = out sign_of(part)
        else out = out escape(part)
        if (KIND == "word" || KIND == "sign") PREV = part
    }
    return out
}
# The last line of a comment that fills whole lines from this one on, or 0.
function filled(n) {
    if (TEXT[file, n] !~ /^\/\*/) return 0
    while (n < LINES[file] && TEXT[file, n] !~ /\*\//) n++
    return TEXT[file, n] ~ /\*\/$/ ? n : 0
}
# What a line of a comment says.
function said(n,    s) {
    s = TEXT[file, n]
    sub(/^\/\* ?/, "", s); sub(/ ?\*\/$/, "", s); sub(/^ \* ?/, "", s)
    return s
}
# The lines from n on that stand further in, if all are equations, typeset, else ""; now is then the last.
function equations(n,    s, lines, places) {
    for (; (s = said(n)) ~ /^  /; n++) {
        if (s !~ /^    [^ ].* = / || s ~ /  = /) return ""
        gsub(/\{/, "(", s); gsub(/\}/, ")", s)
        sub(/\)  /, ")   ", s)
        lines = lines (lines == "" ? "" : "\n") s
        places = places "<span id=\"L" n "\"></span>"
    }
    now = n - 1
    return places math_block(lines) "\n"
}
# The lines to end as paragraphs; those further in stay as they are. What begins with a name is a paragraph of its own.
function comment(end,    s, kind, was, set, fresh, out) {
    for (; now <= end; now++) {
        s = said(now)
        if (sub(/^--- /, "", s)) { sub(/ -+$/, "", s); return "<h2 id=\"L" now "\">" escape(s) "</h2>\n" }
        kind = s ~ /^ *$/ ? "" : s ~ /^  / ? "pre" : "p"
        set = kind == "pre" && was != "pre" ? equations(now) : ""
        fresh = kind != was || set != "" || s ~ /^[a-z0-9]+_[a-z0-9_]+(, [a-z0-9_]+)*: /
        if (fresh && was != "") out = out "</" was ">"
        was = set == "" ? kind : ""
        if (fresh && was != "") out = out "<" was ">"
        out = out (set != "" ? set : "<span id=\"L" now "\">" prose(s) "</span>\n")
    }
    now--
    return "<div class=\"c\">" out (was != "" ? "</" was ">" : "") "</div>\n"
}
# The file, to now.
function page(    end, lines, out) {
    root = file
    gsub(/[^\/]+/, "..", root)
    sub(/\/?\.\.$/, "", root)
    DEPTH = commented = 0
    DECLARING = WHAT = ""
    for (now = 1; now <= LINES[file]; now++) {
        end = commented ? 0 : filled(now)
        if (lines != "" && (end || MARK[file, now] != "" || (DEPTH == 0 && TEXT[file, now] == ""))) { out = out "<pre>" lines "</pre>\n"; lines = "" }
        if (end) out = out comment(end)
        else if (lines == "" && TEXT[file, now] == "") out = out "<p id=\"L" now "\"></p>\n"
        else {
            out = out MARK[file, now]
            lines = lines "<span class=\"l\" id=\"L" now "\"><a class=\"n\" href=\"#L" now "\">" now "</a>" code(TEXT[file, now]) "\n</span>"
        }
    }
    if (lines != "") out = out "<pre>" lines "</pre>\n"
    if (NEXT[file] != "") out = out "<p>Next: <a href=\"" root "/" NEXT[file] ".html\">" NEXT[file] "</a></p>\n"
    return frame(file, root, "source") "<h1>" file "</h1>\n" out "</body></html>"
}
# In which order the README reads the files.
function find_order(    line, i, path, last) {
    while ((getline line < "README.md") > 0)
        while (line ~ /^\| [0-9]/ && match(line, /`[a-z]+\/[a-z_]+`/)) {
            for (i = 1; i <= 2; i++) {
                path = "src/" substr(line, RSTART + 1, RLENGTH - 2) (i == 1 ? ".h" : ".c")
                if (path in LINES) { if (last != "") NEXT[last] = path; last = path }
            }
            line = "| 0" substr(line, RSTART + RLENGTH)
        }
}

# What pages say of lines: the formula, or the number of an example.
BEGIN {
    while (marks != "" && (getline line < marks) > 0) {
        split(line, part, "\t")
        root = part[2]
        gsub(/[^\/]+/, "..", root); sub(/\/?\.\.$/, "", root)
        example = part[1] !~ /\/[0-9]/
        sub(/\.md$/, ".html", part[1])
        gsub(/\003/, "\n", part[6])
        MARK[part[2], part[3]] = MARK[part[2], part[3]] "<div class=\"f\"><a href=\"" root "/" part[1] "#" part[4] "\">" \
            part[5] "</a>" (example ? formula(escape(part[6]), 0) : math_block(part[6])) "</div>\n"
    }
}
FNR == 1 {
    commented = 0
    body = ""
    order[++n_files] = FILENAME
    name = FILENAME
    sub(/.*\//, "", name)
    if (FILENAME ~ /^src/) { NAMED[name] = TIMES[name] ? "" : FILENAME; TIMES[name]++ }
}
{ TEXT[FILENAME, FNR] = $0; LINES[FILENAME] = FNR; collect(bare($0)) }
END {
    find_order()
    for (i = 1; i <= n_files; i++) {
        file = order[i]
        path = out "/" file ".html"
        print page() >path
        close(path)
    }
}

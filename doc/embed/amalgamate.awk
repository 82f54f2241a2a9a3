# amalgamate.awk HEADERS... SOURCES... library: SOURCES... main: SOURCES...: see amalgamate.sh. Reads all and prints one
# file. A file-local name is that of a static function or variable, of an enumerator, or of a struct, union or enum that
# a .c file defines; where two files have it, or a header, it gets the file's name in front. Members stay as they are.
# Macros of a .c file end with it.
function tokens(text,    n, c) { # into tok[1 .. n]; blanks and comments are tokens, too
    n = 0
    while (text != "") {
        if (match(text, /^[A-Za-z_][A-Za-z0-9_]*/) || match(text, /^\/\*([^*]|\*+[^*\/])*\*+\//) ||
            match(text, /^[ \t\n]+/) || match(text, /^"([^"\\]|\\.)*"/) || match(text, /^'([^'\\]|\\.)*'/) || match(text, /^\/\/[^\n]*/) ||
            match(text, /^[0-9.][A-Za-z0-9_.]*/) || match(text, /^->/) || match(text, /^\.\.\./))
            c = RLENGTH
        else
            c = 1
        tok[++n] = substr(text, 1, c)
        text = substr(text, c + 1)
    }
    return n
}
function blank(t) { return t ~ /^([ \t\n]|\/\*|\/\/)/ }
function word(t) { return t ~ /^[A-Za-z_]/ }
# A name of a file; space: "name", or "tag" of a struct, union or enum.
function note(file, space, name) {
    if (!((file, space, name) in own)) {
        own[file, space, name] = 1
        owners[space, name]++
    }
}
# What a piece of text at the file's top level declares. Preprocessor lines are not in it.
function collect(file, header, text,    n, i, t, depth, start, tag, kind, in_enum, before, static, done, body, paren) {
    n = tokens(text)
    start = 1
    for (i = 1; i <= n; i++) {
        t = tok[i]
        if (blank(t)) continue
        if (start) {
            start = 0
            static = t == "static"
            before = tag = kind = ""
            done = t == "extern"
        }
        if (depth == 0 && paren == 0) {
            if (t == "struct" || t == "union" || t == "enum") kind = t
            else if (kind ~ /^(struct|union|enum)$/ && word(t)) { tag = t; kind = kind " " }
            if (t == "(" && !done && (static || header) && word(before)) { note(file, "name", before); done = 1 }
            if ((t == "=" || t == ";" || t == "[") && static && !done && word(before)) { note(file, "name", before); done = 1 }
            if (t == "," && static && word(before)) note(file, "name", before)
        }
        if (t == "(" ) paren++
        if (t == ")") paren--
        if (t == "{") {
            if (depth == 0 && kind != "" && before != ")" && before != "=") {
                if (tag != "") note(file, "tag", tag)
                if (kind ~ /^enum/) in_enum = 1
                body = 1
            } else if (depth == 0)
                body = before == "=" ? 1 : 0
            depth++
            before = "{"
            continue
        }
        if (t == "}") {
            depth--
            in_enum = 0
            if (depth == 0 && !body) start = 1
            kind = ""
        }
        if (depth == 0 && t == ";") start = 1
        if (in_enum && depth == 1 && word(t) && (before == "{" || before == ",")) note(file, "name", t)
        before = t
    }
}
# The text with this file's names; members of structs and what comes after a dot stay.
function rename(file, stem, text,    n, i, t, depth, out, kind, before, inside, square, at, paren, is_tag, member) {
    n = tokens(text)
    out = ""
    for (i = 1; i <= n; i++) {
        t = tok[i]
        if (blank(t)) { out = out t; continue }
        if (t == "(") { paren++; if (before ~ /^(AT|offsetof)$/) at = paren }
        if (t == ")") { if (at == paren) at = 0; paren-- }
        if (t == "{") {
            depth++
            if (!inside && kind ~ /^(struct|union)/ && before != ")" && before != "=") inside = depth
        }
        if (t == "}") { if (inside == depth) inside = 0; depth--; kind = "" }
        if (inside && t == "[") square++
        if (inside && t == "]") square--
        if (t == ";" || t == "(" || t == ")") kind = ""
        is_tag = before == "struct" || before == "union" || before == "enum"
        member = before == "." || before == "->" || at || (inside && !square)
        if (word(t) && (is_tag ? (file, "tag", t) in clash : (file, "name", t) in clash && !member))
            out = out stem "_" t
        else
            out = out t
        if (t == "struct" || t == "union" || t == "enum") kind = t
        before = t
    }
    return out
}
function load(file,    line, text) {
    while ((getline line < file) > 0) text = text line "\n"
    close(file)
    gsub(/\\\n/, "\001\n", text) # lines that go on stay one directive
    source[file] = text
}
function declared(file, header,    n, i, part, text, skip) {
    n = split(source[file], part, "\n")
    for (i = 1; i <= n; i++) {
        if (skip || part[i] ~ /^[ \t]*#/) skip = part[i] ~ /\001$/
        else text = text part[i] "\n"
    }
    collect(file, header, text)
}
function header_of(name) { return "src/" name }
function emit(file, stem,    n, i, part, name, skip, text, macros, m) {
    if (file in emitted) return
    emitted[file] = 1
    n = split(source[file], part, "\n")
    for (i = 1; i < n; i++) {
        if (part[i] ~ /^[ \t]*#[ \t]*include[ \t]*"/) {
            name = part[i]
            gsub(/^[^"]*"|".*$/, "", name)
            sub(/^.*$/, "", part[i])
            printf "%s", finish(stem == "" ? text : rename(file, stem, text))
            text = ""
            emit(header_of(name), "")
            continue
        }
        if (part[i] ~ /^#define _(POSIX|NETBSD|XOPEN|DEFAULT)/) continue # at the top
        if (stem != "" && match(part[i], /^#[ \t]*define[ \t]+[A-Za-z_0-9]+/)) {
            m = substr(part[i], RSTART, RLENGTH)
            sub(/.*[ \t]/, "", m)
            macros = macros "#undef " m "\n"
        }
        text = text part[i] "\n"
    }
    printf "%s", finish(stem == "" ? text : rename(file, stem, text)) macros
}
function finish(text) { gsub(/\001/, "\\", text); return text }
BEGIN {
    for (i = 1; i < ARGC; i++)
        if (ARGV[i] !~ /:$/) {
            load(ARGV[i])
            declared(ARGV[i], ARGV[i] ~ /\.h$/)
        }
    # names of the systems' headers that a file may have, too
    split("read write open close link pipe index stat sleep send accept connect select remove rename rewind", taken, " ")
    for (i in taken) owners["name", taken[i]]++
    # A struct that a header only names is defined in the .c file of that header, or in the only one that defines it.
    for (key in own) {
        split(key, part, SUBSEP)
        if (part[1] !~ /\.c$/ || owners[part[2], part[3]] < 2) continue
        header = part[1]
        sub(/c$/, "h", header)
        if (part[2] == "name" || source[header] !~ ("struct " part[3] "[^a-z_0-9]"))
            clash[part[1], part[2], part[3]] = 1
    }
    print "/* asbdpt.c: the program asbdpt, or with -DASBDPT_LIBRARY its library (asbdpt.h), as one file; made by"
    print " * doc/embed/amalgamate.sh from the sources, which are the text to read. */"
    print "#if defined __linux__ || defined __CYGWIN__ || defined __wasi__ /* see src/base/os.c */"
    print "#define _POSIX_C_SOURCE 200809L\n#define _XOPEN_SOURCE 700\n#endif\n#define _NETBSD_SOURCE 1"
    for (i = 1; i < ARGC; i++) {
        if (ARGV[i] == "library:") print "#ifndef ASBDPT_LIBRARY"
        else if (ARGV[i] == "main:") print "#endif"
        else if (ARGV[i] ~ /\.c$/) {
            stem = ARGV[i]
            sub(/^src\//, "", stem)
            gsub(/\//, "_", stem)
            sub(/\.c$/, "", stem)
            print "\n/* ---- " ARGV[i] " ---- */"
            emit(ARGV[i], stem)
        }
    }
}

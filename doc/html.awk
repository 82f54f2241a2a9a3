# html.awk: a page of Markdown, or a file of text (-v source=1), as HTML that needs nothing but itself and its pictures.
#   awk -v root=../.. -v title=NAME [-v math=1] [-v source=1] [-v class=NAME] [-v marks=FILE] \
#       -f doc/math.awk -f doc/frame.awk -f doc/html.awk FILE >FILE.html
# root is the way from the page to the top of the HTML tree, class that of the page's body; in slides every heading begins
# a section. The subset of Markdown is that of this tree's documents: headings, paragraphs, lists of one level, tables,
# indented and fenced code, pictures, links, emphasis, code.
# With math, plain-text formulas are typeset: those of a line of text by indices and Greek letters, blocks by
# math.awk (not with math=2).

# Where a link leads in the HTML tree: documents and sources have a page each; "FILE: FUNCTION" leads to the line.
function target(url, label) {
    if (url ~ /^(https?:|mailto:|#)/) return url
    if (url ~ /\.md(#.*)?$/) { sub(/\.md/, ".html", url); return url }
    return url ~ /\.(png|svg|jpg|html)$/ ? url : url ".html" line_of(url, label)
}
# "#L" and the number of the line on which the function is defined; "" if none is named or found.
function line_of(url, label,    name, folder, line, n) {
    if (label !~ /: [A-Za-z0-9_]+$/) return ""
    name = label
    sub(/^.*: /, "", name)
    folder = FILENAME
    sub(/[^\/]*$/, "", folder)
    while ((getline line < (folder url)) > 0) {
        n++
        if (line ~ ("^[a-z].*[ *]" name "\\(") && line !~ /;$/) { close(folder url); return "#L" n }
    }
    close(folder url)
    return ""
}

# `transport/mis` leads to that file of src, and in the README of a folder of src `mis` to that of the folder.
function to_source(name, text,    path, line) {
    path = FILENAME
    if (name ~ /^[a-z]+\/[a-z_]+(\.[ch])?$/) path = "src/" name
    else if (!sub(/README\.md$/, "", path) || path !~ /^src\// || name !~ /^[a-z_]+(\.[ch])?$/) return text
    else path = path name
    if (name !~ /\./) path = path ((getline line < (path ".h")) > 0 ? ".h" : ".c")
    if ((getline line < path) <= 0) return text
    close(path)
    return "<a href=\"" root "/" path ".html\">" text "</a>"
}

# A label whose code was set aside.
function plain(label,    n, text) {
    if (label !~ /^\001[0-9]+\002$/) return label
    n = substr(label, 2, length(label) - 2)
    text = kept[n]
    gsub(/<[^>]*>/, "", text)
    return text
}

# Emphasis, links and code of a paragraph.
function inline(s,    out, at, code, text, label, url, i) {
    n_kept = 0
    s = escape(s)
    while (match(s, /`[^`]+`/)) {
        code = substr(s, RSTART + 1, RLENGTH - 2)
        text = "<code" (RLENGTH > 38 && kind != "table" ? " class=\"long\"" : "") ">" breakable(code) "</code>"
        kept[++n_kept] = substr(s, RSTART - 1, 1) == "[" ? text : to_source(code, text)
        s = substr(s, 1, RSTART - 1) "\001" n_kept "\002" substr(s, RSTART + RLENGTH)
    }
    while (match(s, /!?\[[^][]*\]\([^() ]*\)/)) {
        code = substr(s, RSTART, RLENGTH)
        at = index(code, "](")
        url = substr(code, at + 2, length(code) - at - 2)
        label = substr(code, 1, at - 1)
        sub(/^!?\[/, "", label)
        if (substr(code, 1, 1) == "!") kept[++n_kept] = "<img src=\"" url "\" alt=\"" label "\"" (is_drawing(url) ? " class=\"drawing\"" : "") ">"
        else if (substr(s, RSTART + RLENGTH) ~ /^ at \001/) { # doc/marks.awk knows where its line is
            marked++
            kept[++n_kept] = "<a id=\"computed-" marked "\" href=\"" url ".html#L" at_line[marked] "\">" label "</a>"
        } else kept[++n_kept] = "<a href=\"" target(url, plain(label)) "\">" label "</a>"
        s = substr(s, 1, RSTART - 1) "\001" n_kept "\002" substr(s, RSTART + RLENGTH)
    }
    while (match(s, /&lt;https?:[^ ]*&gt;/)) {
        url = substr(s, RSTART + 4, RLENGTH - 8)
        kept[++n_kept] = "<a href=\"" url "\">" url "</a>"
        s = substr(s, 1, RSTART - 1) "\001" n_kept "\002" substr(s, RSTART + RLENGTH)
    }
    s = pairs(s, "\\*\\*[^*]+\\*\\*", 2, "strong")
    s = pairs(s, "\\*[^* ]([^*]*[^* ])?\\*", 1, "em")
    if (math) s = formula(s, 1)
    for (i = n_kept; i > 0; i--) {
        at = index(s, "\001" i "\002")
        if (at) s = substr(s, 1, at - 1) kept[i] substr(s, at + length(i) + 2)
    }
    return s
}
# Is it a picture of words and lines that nobody could read if it were made as narrow as a phone?
function is_drawing(url,    folder, line) {
    folder = FILENAME
    sub(/[^\/]*$/, "", folder)
    if (url !~ /[.]svg$/ || (getline line < (folder url)) <= 0) return 0
    close(folder url)
    return substr(line, index(line, " width=") + 8) + 0 > 600
}
# Where a narrow table may break a long name.
function breakable(code) { if (kind == "table" && length(code) > 12) gsub(/[\/_ ]/, "&<wbr>", code); return code }
function pairs(s, pattern, n, tag,    out) {
    while (match(s, pattern)) {
        out = out substr(s, 1, RSTART - 1) "<" tag ">" substr(s, RSTART + n, RLENGTH - 2 * n) "</" tag ">"
        s = substr(s, RSTART + RLENGTH)
    }
    return out s
}

# C, a line at a time: comments and keywords marked. commented: inside a comment that began on a line before.
function colour(s,    out, at, code) {
    while (s != "") {
        if (commented) {
            at = index(s, "*/")
            commented = !at
            code = at ? substr(s, 1, at + 1) : s
            out = out "<i>" escape(code) "</i>"
        } else {
            at = index(s, "/*")
            commented = at > 0
            code = at ? substr(s, 1, at - 1) : s
            out = out keywords(escape(code))
        }
        s = substr(s, length(code) + 1)
    }
    return out
}
function keywords(s,    out, name) {
    while (match(s, /[A-Za-z_][A-Za-z0-9_]*/)) {
        name = substr(s, RSTART, RLENGTH)
        out = out substr(s, 1, RSTART - 1) (is_keyword(name) ? "<b>" name "</b>" : name)
        s = substr(s, RSTART + RLENGTH)
    }
    return out s
}

# A block of indented lines: a formula unless it looks like commands or a listing.
function block(text,    is_code) {
    is_code = math != 1 || text ~ /(^|\n) *(\.\/|make|cc |sh |build\/|WHOLE=|asbdpt|static |extern )/
    sub(/\n$/, "", text); sub(/^ /, "", text) # a numbered item's block stands a blank further in
    print is_code ? "<pre>" escape(text) "</pre>" : math_block(text)
}

function flush(    i, n, cell, tag) {
    if (kind == "p") print (buffer ~ /^!\[/ ? "<p class=\"wide\">" : "<p>") inline(buffer) "</p>"
    if (kind == "item") printf "%s", inline(buffer)
    if (kind == "pre") block(buffer)
    if (kind == "table") print "</table></div>"
    kind = buffer = ""
}
function end_list() { if (list != "") { flush(); print "</li></" list ">"; list = "" } }
function row(line, tag,    n, i, cell, out, side) {
    gsub(/\\\|/, "\003", line)
    sub(/^\|/, "", line); sub(/\| *$/, "", line)
    n = split(line, cell, "|")
    for (i = 1; i <= n; i++) {
        gsub(/^ +| +$/, "", cell[i]); gsub(/\003/, "|", cell[i])
        side = i in right ? " class=\"right\"" : ""
        out = out "<" tag side ">" inline(cell[i]) "</" tag ">"
    }
    print "<tr>" out "</tr>"
}
# The first row of a table, when the line below it is read: that says which columns end at the right.
function head(line,    n, i, cell) {
    n = split(line, cell, "|") - 2
    for (i in right) delete right[i]
    for (i = 1; i <= n; i++) if (cell[i + 1] ~ /-:/) right[i] = 1
    print "<div class=\"wide" (n > 3 ? " many" : "") "\"><table>"
    row(buffer, "th")
    buffer = ""
}

BEGIN {
    print frame(title, root, class)
    if (source) print "<h1>" title "</h1><pre>"
    while (marks != "" && (getline line < marks) > 0) {
        split(line, part, "\t")
        if (part[1] == ARGV[1]) at_line[++n_marks] = part[3]
    }
}
source { printf "<span id=\"L%d\" class=\"n\">%4d</span> %s\n", FNR, FNR, escape($0); next }

fence && /^ *```/ { fence = 0; print "</pre>"; next }
fence { print (fence == 2 ? colour($0) : escape($0)); next }
/^ *```/ { flush(); fence = /```c$/ ? 2 : 1; printf "<pre>"; next }
/^<!-- .* -->$/ { next }
{ gsub(/<!-- [a-z][^>]* -->/, "") } # marks of measured numbers
/^ *$/ {
    blank = 1
    if (kind == "pre") buffer = buffer "\n"
    else flush()
    next
}
/^#+ / {
    end_list(); flush()
    match($0, /^#+/)
    n = RLENGTH
    text = substr($0, n + 2)
    if (class == "slides") print (sections++ ? "</section>" : "") "<section>"
    id = tolower(text); gsub(/[^a-z0-9 -]/, "", id); gsub(/ /, "-", id)
    print "<h" n " id=\"" id "\">" inline(text) "</h" n ">"
    if (n == 2) contents = contents "<a href=\"#" id "\">" inline(text) "</a>\n"
    blank = 0
    next
}
/^\|[-: |]+\|$/ && kind == "table" { head($0); next }
/^\|/ {
    if (kind != "table") {
        end_list(); flush()
        kind = "table"; buffer = $0
    } else row($0, "td")
    blank = 0
    next
}
/^([-*]|[0-9]+\.) / {
    wanted = /^[-*]/ ? "ul" : "ol"
    if (list != wanted) { end_list(); flush(); print "<" wanted ">"; list = wanted } else { flush(); print "</li>" }
    printf "<li>"
    sub(/^([-*]|[0-9]+\.) +/, "")
    kind = "item"; buffer = $0; blank = 0
    next
}
/^(    |\t)/ && (list == "" || (/^      / && blank)) && (kind == "" || kind == "pre") || kind == "pre" && /^    / {
    if (kind != "pre") { flush(); kind = "pre" }
    sub(list == "" ? "^    " : "^      ", "")
    buffer = buffer $0 "\n"
    blank = 0
    next
}
{
    if (kind == "pre") flush()
    if (list != "" && blank && !/^ /) end_list()
    if (kind == "table") flush()
    if (kind == "") kind = "p"
    sub(/^ +/, "")
    buffer = buffer (buffer == "" ? "" : "\n") $0
    blank = 0
}
END {
    end_list(); flush()
    if (source) print "</pre>"
    if (sections) print "</section>"
    if (contents != "") print "<aside>" contents "</aside>"
    print "</body></html>"
}

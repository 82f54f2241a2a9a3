#!/bin/sh
# references.sh: does every source named in a comment resolve? A source is a bracket in a comment of src and test,
# [KEY] or [KEY WHERE], that begins with a capital and a second letter or digit (but is no constant's name and no
# usage line), begins with pbrt-v3, or ends with a year. Checked:
#   1. KEY is an entry of doc/references.md, a line "- **[KEY]**", and WHERE has the form of a place in a source;
#   2. every entry is used, or says "Background reading"; none stands twice.
# Entries that are not in alphabetical order are brought into it. Prints what is wrong, or one line; exit status 0 only
# if nothing is. Run from the top.
export LC_ALL=C
page=doc/references.md

# sorted: the page with its entries in order: each in one line behind its key, sorted, and in lines again.
sorted() {
    sed '/^- \*\*\[/,$d' $page
    sed -n '/^- \*\*\[/,$p' $page | awk '
        /^- \*\*\[/ { printf "%s%s", (NR > 1 ? "\n" : ""), tolower(substr($0, 6, index($0, "]") - 6)) }
        { printf "\t%s", $0 }
        END { print "" }' | sort | cut -f 2- | tr '\t' '\n'
}
new=$(sorted) || exit
[ "$new" = "$(cat $page)" ] || { printf '%s\n' "$new" >$page && echo "references: $page is sorted anew"; }
awk -f test/tree/pieces.awk $(find src test -name '*.[ch]' | sort) | awk -F '\t' '
    function wrong(text) { print text; bad = 1 }

    # The key that begins this source: the longest entry that ends at a blank or at the end.
    function key_of(source,    k, best) {
        for (k in entry)
            if ((source == k || index(source, k " ") == 1) && length(k) > length(best)) best = k
        return best
    }

    function cite(source,    key, where) {
        if (source !~ /^[A-Z][A-Za-z0-9\047]/ && source !~ /^pbrt-v3/ && source !~ /(1[89]|20)[0-9][0-9]$/) return
        if (source ~ /^[A-Z0-9]*_/ || source ~ /\.\.\.$/) return
        key = key_of(source)
        if (key == "") { wrong($1 ":" $2 ": [" source "] is not in doc/references.md"); return }
        used[key] = 1
        where = substr(source, length(key) + 2)
        if (where != "" && key != "pbrt-v3" &&
            where !~ /^((eq\.|Algorithms?|annex|appendix) )?[0-9A-Z][0-9.]*(-[0-9.]+| and [0-9]+| \([0-9]+\))?$/)
            wrong($1 ":" $2 ": [" source "]: " where " is no place in " key)
    }

    # What follows the last "[", or the whole text.
    function innermost(text) { sub(/.*\[/, "", text); return text }

    # A line of comment text; a bracket may go on in the next line. Intervals such as [0,1) close none.
    function comment(text,    at) {
        if (begun != "") { sub(/^[ \t]*\*?[ \t]*/, "", text); text = begun " " text; begun = "" }
        while (at = index(text, "]")) {
            if (index(substr(text, 1, at), "[")) cite(innermost(substr(text, 1, at - 1)))
            text = substr(text, at + 1)
        }
        if (index(text, "[")) begun = "[" innermost(text)
    }

    FILENAME ~ /references\.md$/ {
        if (/^- \*\*\[/) {
            key = substr($0, 6)
            sub(/\].*/, "", key)
            if (key in entry) wrong("doc/references.md: [" key "] stands twice")
            entry[key] = 1
            n_entries++
        }
        if (/Background reading/) used[key] = 1
        next
    }
    $1 != file { file = $1; begun = "" }
    $3 == "code" && $4 ~ /[^ ]/ { begun = "" }
    $3 == "comment" { comment($4) }
    END {
        for (k in entry) if (!(k in used)) wrong("doc/references.md: nothing refers to [" k "]")
        if (n_entries == 0) wrong("doc/references.md has no entries")
        if (!bad) print "references: all of " n_entries " keys resolve and are used"
        exit bad
    }' $page -

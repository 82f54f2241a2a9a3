#!/bin/sh
# words.sh [TOP [LIST]]: are the documents short enough, and easy to read? It checks
#   - the words of each page, without measured tables, against the limits of words.txt;
#   - the words of each sentence (at most 35) and their mean over a page (below 18);
#   - that no phrase of words.txt is in a page, or in a comment or a string of src and test/lab.
# The exceptions of words.txt may stay. Prints the words of each row of limits, then what it has found.
here=$(cd "$(dirname "$0")" && pwd) list=${2:-$here/words.txt} && cd "${1:-.}" || exit 2
LC_ALL=C
export LC_ALL

# pages: the text of Markdown pages as lines FILE <tab> LINE <tab> KIND <tab> TEXT. KIND is "prose", which has
# sentences, "rest" (headings and tables) or "code"; a line without TEXT ends a paragraph. A piece of code within a
# sentence becomes one word. Measured tables, which evidence.sh fills in, are left out.
pages() {
    find . \( -name 'build*' -o -name out -o -name .git \) -prune -o -name '*.md' -print | sed 's/^\.\///' | sort | xargs awk '
        function put(kind, text) { print FILENAME "\t" FNR "\t" kind "\t" text }
        FNR == 1 { fenced = code = measured = 0; before = "" }
        /^<!-- measured:.*-->$/ { measured = 1 }
        measured { measured = !/^<!-- end -->$/; next }
        /^ *```/ { fenced = !fenced; put("code", ""); next }
        { code = /^    / && (code || before == ""); before = $0 }
        fenced || code { put("code", $0); next }
        {
            gsub(/<!--[^>]*-->/, "")
            gsub(/`[^`]*`/, "CODE")
            gsub(/!\[[^]]*\]\([^)]*\)/, "")
            gsub(/\]\([^)]*\)/, "")
            gsub(/\t/, " ")
        }
        /^ *$/ { put("prose", ""); next }
        /^[#|]/ { put("rest", ""); put("rest", $0); put("rest", ""); next }
        /^ *([-*]|[0-9]+\.) / { put("prose", ""); sub(/[-*]|[0-9]+\./, "") }
        { put("prose", $0) }'
}
# sources: the comments and strings of C files in the same way, of the kind "source"; code in backquotes and names of
# files become one word.
sources() {
    find src test/lab -name '*.[ch]' | sort | xargs awk -f "$here/pieces.awk" | awk '
        BEGIN { FS = OFS = "\t" }
        $3 == "code" { included = $4 ~ /^#include/; next }
        $3 == "string" && (included || $4 ~ /^\047/) { next }
        {
            gsub(/`[^`]*`|[a-z_0-9-]+\.(c|h|sh|awk|md|pbrt)/, "CODE", $4)
            $3 = "source"
            print
        }'
}
{ pages; sources; } | awk -F '\t' '
    function found(page, line, what, say,    i) {
        for (i = 1; i <= exceptions; i++) if (page ~ in_page[i] && what == excepted[i]) { used[i] = 1; return }
        wrong[++n_wrong] = page ":" line ": " what (say == "" ? "" : " -> " say)
    }
    function pattern(glob) { gsub(/\./, "\\.", glob); gsub(/\*/, "[^/]*", glob); return "^" glob "$" }
    /^== / && list < 4 { list++; next }
    FNR == 1 && NR > 1 { list = 4 }
    list < 4 && (/^#/ || !NF) { next }
    list == 1 {
        n = split($0, part, " ")
        limit[++rows] = part[1]
        limited_at[rows] = FNR
        for (i = 2; i <= n; i++) {
            of[++patterns] = pattern(part[i])
            row[patterns] = rows
            name[rows] = name[rows] " " part[i]
        }
    }
    list == 2 { split($0, part, " = "); phrase[++phrases] = "[^a-z/_-](" part[1] ")[^a-z/_-]"; instead[phrases] = part[2] }
    list == 3 {
        split($0, part, / *\| */)
        in_page[++exceptions] = pattern(part[1])
        excepted[exceptions] = part[2]
        excepted_at[exceptions] = FNR
    }
    list < 4 { next }

    # Phrases that begin in the line before this one, for they may end in this one.
    function look(text,    both, i, rest) {
        both = " " before " " text " "
        for (i = 1; i <= phrases; i++)
            for (rest = both; match(rest, phrase[i]) && length(rest) - RSTART > length(text) + 1;
                 rest = substr(rest, RSTART + 1))
                found(before_page, before_line, substr(rest, RSTART + 1, RLENGTH - 2), instead[i])
        before = text
        before_page = $1
        before_line = $2
    }
    function end_sentence() {
        if (long > 35) found(page, begun, "long sentence", long " words")
        if (long) { sentences[page]++; in_sentences[page] += long }
        long = ended = 0
    }
    {
        if ($1 != page) { end_sentence(); look("") }
        if ($3 != "prose" || $4 == "") end_sentence()
        page = $1
        n = split($4, word, / +/)
        for (i = 1; i <= n; i++) {
            if (word[i] !~ /[A-Za-z0-9]/) continue
            if ($3 != "source") words[page]++
            if ($3 != "prose") continue
            if (ended && word[i] !~ /^[a-z]/) end_sentence()
            if (!long++) begun = $2
            ended = word[i] ~ /[.?!][])"*_]*$/
        }
        text = tolower($4)
        gsub(/[^a-z0-9_\/-]+/, " ", text)
        gsub(/^ | $/, "", text)
        look($3 == "code" ? "" : text)
    }
    END {
        end_sentence()
        look("")
        for (page in words) {
            for (i = 1; i <= patterns && page !~ of[i]; i++) continue
            if (i > patterns) found(page, 1, "a page without a limit")
            else all[row[i]] += words[page]
            if (sentences[page] && in_sentences[page] / sentences[page] >= 18)
                found(page, 1, "long sentences", sprintf("%.1f words in the mean", in_sentences[page] / sentences[page]))
        }
        for (i = 1; i <= rows; i++) {
            if (limit[i] != "-" && i < rows) all[rows] += all[i]
            printf "%6d of %5s words: %s\n", all[i], limit[i], name[i]
            if (limit[i] != "-" && all[i] > limit[i])
                found("words.txt", limited_at[i], "too many words", all[i] " of " limit[i] " in" name[i])
        }
        for (i = 1; i <= exceptions; i++) if (!used[i]) found("words.txt", excepted_at[i], "an exception without use", excepted[i])
        for (i = 1; i <= n_wrong; i++) print wrong[i]
        print "words: " all[rows] " words to be read, " n_wrong + 0 " findings"
    }' "$list" -

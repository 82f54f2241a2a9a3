# check.awk: the checks of words.sh. It reads limits, phrases and exceptions, then what pages.awk and sources.awk print.
function found(page, line, what, say,    i) {
    for (i = 1; i <= exceptions; i++) if (page ~ in_page[i] && what == excepted[i]) { used[i] = 1; return }
    wrong[++n_wrong] = page ":" line ": " what (say == "" ? "" : " -> " say)
}
function pattern(glob) { gsub(/\./, "\\.", glob); gsub(/\*/, "[^/]*", glob); return "^" glob "$" }
FNR == 1 { list++ }
list < 4 && (/^#/ || !NF) { next }
list == 1 {
    n = split($0, part, " ")
    limit[++rows] = part[1]
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
        if (i > patterns) found(page, 1, "a page in no row of limits.txt")
        else all[row[i]] += words[page]
        if (sentences[page] && in_sentences[page] / sentences[page] >= 18)
            found(page, 1, "long sentences", sprintf("%.1f words in the mean", in_sentences[page] / sentences[page]))
    }
    for (i = 1; i <= rows; i++) {
        if (limit[i] != "-" && i < rows) all[rows] += all[i]
        printf "%6d of %5s words: %s\n", all[i], limit[i], name[i]
        if (limit[i] != "-" && all[i] > limit[i])
            found("limits.txt", i, "too many words", all[i] " of " limit[i] " in" name[i])
    }
    for (i = 1; i <= exceptions; i++) if (!used[i]) found("exceptions.txt", i, "an exception without use", excepted[i])
    for (i = 1; i <= n_wrong; i++) print wrong[i]
    print "words: " all[rows] " words to be read, " n_wrong + 0 " findings"
}

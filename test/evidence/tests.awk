# tests.awk TEST/MAIN.C TEST/TEST_*.C: the tests that `build/test` knows as a table of doc/measured, a row for each file
# that holds any: their names, slow ones marked, and the first sentence of the file's head.
FNR == 1 { head = FILENAME !~ /main\.c$/; text = "" }
FILENAME ~ /main\.c$/ {
    while (match($0, /\{"[a-z-]+", test_[a-z_]+, (true|false)\}/)) {
        split(substr($0, RSTART + 2, RLENGTH - 3), part, /", |, /)
        $0 = substr($0, RSTART + RLENGTH)
        order[++n] = part[1]; by[part[1]] = part[2]; slow[part[1]] = part[3] == "true"
    }
    next
}
head {
    line = $0
    sub(/^ ?\/?\*\/? ?/, "", line)
    if (FNR == 1) sub(/^[a-z_]+\.c: /, "", line)
    sub(/ *\*\/ *$/, "", line)
    text = text (text == "" ? "" : " ") line
    if (match(text, /\.( |$)/)) { text = substr(text, 1, RSTART - 1); head = 0 }
    if ($0 ~ /\*\//) head = 0
    says[FILENAME] = text
}
/^void test_[a-z_]+\(struct test \*t\)/ { name = $2; sub(/\(.*/, "", name); file[name] = FILENAME }
END {
    print "== table\n| `build/test` | what it tests |\n|---|---|"
    for (i = 1; i <= n; i++) {
        f = file[by[order[i]]]
        if (f == "") { print "no file has " by[order[i]] >"/dev/stderr"; exit 1 }
        if (!(f in names)) row[++rows] = f
        names[f] = names[f] (names[f] == "" ? "" : ", ") "`" order[i] "`" (slow[order[i]] ? " (slow)" : "")
    }
    for (i = 1; i <= rows; i++) {
        gsub(/\|/, "\\|", says[row[i]])
        print "| " names[row[i]] " | " says[row[i]] " |"
    }
}

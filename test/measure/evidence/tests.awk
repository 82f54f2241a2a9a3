# tests.awk TEST_*.C: the suites that `build/test` knows as a table of doc/measured, a row for each file that holds any:
# their names, slow ones marked, and the first sentence of the file's head.
FNR == 1 { head = 1; text = "" }
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
/^void test_[a-z_]+\(struct test \*t\)/ && !/;$/ {
    suite = substr($2, 6)
    sub(/\(.*/, "", suite)
    gsub("_", "-", suite)
    if (!(FILENAME in names)) row[++rows] = FILENAME
    names[FILENAME] = names[FILENAME] (names[FILENAME] == "" ? "" : ", ") "`" suite "`" (suite ~ /-long$/ ? " (slow)" : "")
}
END {
    print "== table\n| `build/test` | what it tests |\n|---|---|"
    for (i = 1; i <= rows; i++) {
        gsub(/\|/, "\\|", says[row[i]])
        print "| " names[row[i]] " | " says[row[i]] " |"
    }
}

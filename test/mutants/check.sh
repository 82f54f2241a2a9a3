#!/bin/sh
# check.sh: does every fault of list.txt, every variant of test/lab/tune.txt, and every plant of the course still apply?
# The text to be replaced must occur in its file exactly once, no two may have the same name, and doc/mutants.md must be
# the list as a table.
#   sh test/mutants/check.sh renew    writes doc/mutants.md
page=doc/mutants.md
table() {
    printf '# Mutants\n\nThe %s faults of [`list.txt`](../test/mutants/list.txt) and ' \
        "$(awk '/^[^-+# \t]/ && NF > 3' test/mutants/list.txt | wc -l | tr -d ' ')"
    printf 'the tests that are to notice them. '
    printf '`make mutants`\napplies them one by one; [evidence.md](evidence.md) says what that shows. Written by '
    printf '`sh test/mutants/check.sh renew`.\n\n| mutant | fault | tests |\n|---|---|---|\n'
    awk '/^[^-+# \t]/ && NF > 3 {
        text = $4
        for (i = 5; i <= NF; i++)
            text = text " " $i
        gsub(/,/, ", ", $3)
        gsub(/\|/, "\\|", text)
        print "| " $1 " | " text " | " $3 " |" }' test/mutants/list.txt
}
if [ "$1" = renew ]; then
    table >$page
    exit
fi
if ! table | cmp -s - $page; then
    echo "$page is not the list of mutants: sh test/mutants/check.sh renew"
    exit 1
fi

awk '
    function check() {
        if (name == "")
            return
        if (!(file in text)) {
            while ((getline line < file) > 0)
                text[file] = text[file] line "\n"
            close(file)
        }
        n++
        at = index(text[file], old)
        if (seen[name]++ || old == "" || at == 0 || index(substr(text[file], at + length(old)), old)) {
            print "mutant " name ": " file " does not hold the text to be replaced once, or the name is taken"
            bad++
        }
    }
    FNR == 1 { check(); name = ""; lists++ }
    /^#/ { next }
    /^[^-+ \t]/ && NF > 3 { check(); name = $1; file = $2; old = ""; next }
    /^-/ { old = old (old == "" ? "" : "\n") substr($0, 3) }
    END {
        check()
        print "mutants, variants and plants: " n - bad " of " n " apply"
        exit bad > 0 || n == 0 || lists != 3
    }' \
    test/mutants/list.txt test/lab/tune.txt test/course/plants.txt

#!/bin/sh
# check.sh: does every fault of list.txt, every variant of test/lab/tune.txt, and every plant of the course still apply?
# The text to be replaced must occur in its file exactly once, and no two may have the same name.
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

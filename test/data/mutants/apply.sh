#!/bin/sh
# apply.sh: entries of a list of faults (list.txt says how one is written): texts of files, each with another that
# replaces it. The old text must occur in its file exactly once.
#   sh test/data/mutants/apply.sh LIST NAME TREE    replaces the text of the entry NAME in its file of TREE
#   sh test/data/mutants/apply.sh check LIST...     does every entry still apply? No two may have the same name.
name= tree=.
if [ "$1" = check ]; then shift; else
    name=$2 tree=$3
    set -- "$1"
fi
awk -v only="$name" -v tree="$tree" '
    function entry(    path, line, text, at, rest) {
        if (name == "" || (only != "" && name != only)) return
        path = tree "/" file
        while ((getline line < path) > 0) text = text line "\n"
        close(path)
        n++
        at = index(text, old)
        rest = substr(text, at + length(old))
        if (seen[name]++ || old == "" || at == 0 || index(rest, old)) {
            print name ": " file " does not hold the text to be replaced exactly once, or the name is taken"
            bad++
        } else if (only != "")
            printf "%s%s%s", substr(text, 1, at - 1), new, rest > path
    }
    FNR == 1 { entry(); name = ""; lists++ }
    /^#/ { next }
    /^[^-+ \t]/ && NF > 3 { entry(); name = $1; file = $2; old = new = ""; next }
    /^-/ { old = old (old == "" ? "" : "\n") substr($0, 3) }
    /^\+/ { new = new (new == "" ? "" : "\n") substr($0, 3) }
    END {
        entry()
        if (only == "") print "mutants, variants and plants: " n - bad " of " n " apply"
        else if (n == 0) print only ": no such mutant"
        exit bad > 0 || n == 0 || lists != ARGC - 1
    }' "$@"

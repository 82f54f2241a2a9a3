#!/bin/sh
# apply.sh LIST NAME TREE: replace a text in a file of the tree, as the entry NAME of the list (list.txt says how it is
# written) asks. Prints an error unless the old text occurs exactly once.
awk -v name="$2" -v tree="$3" '
    /^#/ { next }
    /^[^-+ \t]/ && NF > 3 { here = ($1 == name); if (here) file = $2; next }
    !here || /^$/ { next }
    /^-/ { old = old (old == "" ? "" : "\n") substr($0, 3) }
    /^\+/ { new = new (new == "" ? "" : "\n") substr($0, 3) }
    END {
        if (file == "") { print name ": no such mutant"; exit 1 }
        path = tree "/" file
        while ((getline line < path) > 0)
            text = text line "\n"
        close(path)
        at = index(text, old)
        if (old == "" || at == 0) { print name ": " file " does not hold the text to be replaced"; exit 1 }
        rest = substr(text, at + length(old))
        if (index(rest, old)) { print name ": " file " holds the text to be replaced more than once"; exit 1 }
        printf "%s%s%s", substr(text, 1, at - 1), new, rest > path
    }'  "$1"

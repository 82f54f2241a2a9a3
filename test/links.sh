#!/bin/sh
# links.sh [TOP]: does what the documents point to exist? (A program given as the argument, as other tests take one,
# stands for its folder.) Checked in every Markdown file of TOP, outside of code:
#   1. a relative link [text](path) leads to a file;
#   2. [`FILE: FUNCTION`](path) leads to a file of that name in which FUNCTION( occurs;
#   3. mutant `NAME` is in test/mutants/list.txt, `build/test NAME` in test/main.c.
# Prints what is wrong, or one line; exit status 0 only if nothing is.
top=${1:-.}
[ -d "$top" ] || top=$(dirname "$top")
LC_ALL=C awk -v top="$top" '
    function wrong(text) { print FILENAME ":" FNR ": " text; bad = 1 }

    # The text of a file, read once; "" if there is none or it is empty.
    function text_of(path,    line, all) {
        if (!(path in text)) {
            all = ""
            while ((getline line < path) > 0) all = all line "\n"
            close(path)
            text[path] = all
        }
        return text[path]
    }
    function holds_call(path, name,    all, at, before) {
        all = text_of(path)
        while (at = index(all, name "(")) {
            before = at > 1 ? substr(all, at - 1, 1) : " "
            if (before !~ /[A-Za-z0-9_]/) return 1
            all = substr(all, at + length(name))
        }
        return 0
    }
    # "a/b/../c" relative to the folder of FILENAME.
    function resolve(target,    folder) {
        folder = FILENAME
        sub(/[^\/]*$/, "", folder)
        return folder target
    }
    function link(label, target,    path, colon, name) {
        if (target ~ /^(https?:|mailto:|#)/) return
        sub(/#.*/, "", target)
        n_links++
        path = resolve(target)
        if (text_of(path) == "" && system("test -e \"" path "\"") != 0) { wrong("there is no " target); return }
        if (label !~ /^`[A-Za-z0-9_.]+: [a-z0-9_A-Z]+`$/) return
        colon = index(label, ": ")
        name = substr(label, colon + 2, length(label) - colon - 2)
        if (target != substr(label, 2, colon - 2) && target !~ ("/" substr(label, 2, colon - 2) "$"))
            wrong(label " leads to " target)
        if (!holds_call(path, name)) wrong(target " has no function " name)
        n_functions++
    }
    # All links of a line. A label holds no bracket.
    function links(line,    at, label, target) {
        while (match(line, /\[[^][]*\]\([^() ]*\)/)) {
            label = substr(line, RSTART + 1, RLENGTH - 1)
            target = label
            line = substr(line, RSTART + RLENGTH)
            sub(/\]\(.*/, "", label)
            sub(/^.*\]\(/, "", target)
            sub(/\).*$/, "", target)
            link(label, target)
        }
    }
    # Every `NAME` that PREFIX stands before.
    function names(line, pattern, file, shape, what,    name) {
        while (match(line, pattern)) {
            name = substr(line, RSTART, RLENGTH)
            line = substr(line, RSTART + RLENGTH)
            gsub(/^.*[ `]([^ `]+`$)/, "&", name)
            sub(/`$/, "", name)
            sub(/^.*[ `]/, "", name)
            if (index(text_of(top "/" file), sprintf(shape, name)) == 0) wrong("there is no " what " " name)
            n_names++
        }
    }
    FNR == 1 { fence = 0 }
    /^ *```/ { fence = !fence; next }
    fence || /^(    |\t)/ { next }
    {
        links($0)
        names($0, "mutant `[a-zA-Z0-9-]+`", "test/mutants/list.txt", "\n%s ", "mutant")
        names($0, "`build/test [a-z0-9-]+`", "test/main.c", "{\"%s\"", "test")
    }
    END {
        if (n_links == 0) { print "links: no documents"; bad = 1 }
        if (!bad) print "links: " n_links " links, " n_functions " functions and " n_names " tests and mutants exist"
        exit bad
    }' $(find "$top" \( -name 'build*' -o -name out -o -name .git \) -prune -o -name '*.md' -print | sort)

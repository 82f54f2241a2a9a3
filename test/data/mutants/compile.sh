#!/bin/sh
# compile.sh: does every fault of list.txt still compile? One that does not is caught by nothing.
#   sh test/data/mutants/compile.sh [WORKERS]      in the root of the tree, after make build/test; some 30 s of CPU
# A .c is checked alone, a header with three of the files that include it. Files of other kinds are not compiled.
set -u
list=test/data/mutants/list.txt
workers=${1:-2}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

# users FILE: what is compiled to check it.
users() {
    case $1 in
    *.c) echo "$1" ;;
    *.h) find src test -name '*.c' -exec grep -l "\"\(.*/\)*${1##*/}\"" {} + | sort | head -n 3 ;;
    esac
}

# compiles FILE: does it, or do those that include it?
compiles() {
    for c in $(users "$1"); do
        ${CC:-cc} -std=c99 -Isrc -Itest -Itest/lab -Itest/unit -Ibuild -Werror=implicit-function-declaration \
            -fsyntax-only "$c" || return
    done
}

# worker NUMBER: every WORKERS-th fault in a tree of its own.
worker() {
    mkdir "$work/$1" "$work/$1/build" && cp -R Makefile src test doc "$work/$1" && cp build/suites.h "$work/$1/build" &&
        cd "$work/$1" || exit
    awk -v n="$1" -v workers="$workers" '/^[^-+# \t]/ && NF > 3 && ++i % workers == n % workers { print $1, $2 }' $list |
        while read -r name file; do
            cp "$file" saved
            sh test/data/mutants/apply.sh $list "$name" . && compiles "$file" && echo "$name" >>../good ||
                echo "$name: does not apply or compile"
            cp saved "$file"
        done
}

for w in $(seq "$workers"); do worker "$w" & done
wait
good=$(wc -l <"$work/good") all=$(awk '/^[^-+# \t]/ && NF > 3' $list | wc -l)
echo "$((good)) of $((all)) mutants compile"
[ "$((good))" = "$((all))" ]

#!/bin/sh
# references_test.sh: do references.sh and columns.sh notice? Plants an unknown key, a key across two lines, a place
# that is none, entries that nobody uses, out of order or twice, a long line and a character beyond ASCII into copies of
# the tree.
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
failures=0

# plant CHECK WORD TEXT FILE: with TEXT at the end of FILE, CHECK must fail and say WORD.
plant() {
    rm -rf "$dir/tree"
    mkdir -p "$dir/tree/doc" "$dir/tree/scenes"
    cp -r src test "$dir/tree"
    cp -r scenes/generate "$dir/tree/scenes"
    cp doc/references.md "$dir/tree/doc"
    cp .clang-format "$dir/tree"
    printf '%b\n' "$3" >>"$dir/tree/$4"
    if sh "test/$1" "$dir/tree" >"$dir/out" || ! grep -q "$2" "$dir/out"; then
        echo "$1 does not notice: $3 in $4"
        failures=1
    fi
}
plant references.sh 'Nobody 1900. is not in' '/* [Nobody 1900] */' src/base/vec.h
plant references.sh 'van Nobody 1900. is not in' '/* [0,1) and\n * [van\n * Nobody 1900] */' test/test.h
plant references.sh 'V96 10. is not in' 'int v; /* "x" [V97 10] [V96 10] */' test/main.c
plant references.sh 'is no place in V97' '/* [V97 10, 11] */' src/base/vec.h
plant references.sh 'nothing refers to' '- **[Zzz 1900]** Nobody.' doc/references.md
plant references.sh 'must stand before' '- **[V98]** Nobody.' doc/references.md
plant references.sh 'stands twice' '- **[V97]** Nobody.' doc/references.md
plant columns.sh 'vec.h:[0-9]*: 121 characters' "$(printf '/*%117s*/' '')" src/base/vec.h
plant columns.sh 'model.c:[0-9]*: a character' '/* \0303\0244 */' scenes/generate/model.c
[ $failures -eq 0 ] && echo "references and columns: planted faults are found"
exit $failures

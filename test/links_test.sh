#!/bin/sh
# links_test.sh: does links.sh find what it is there to find? Each document below has one fault, but for the first.
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir -p "$dir/test/mutants" "$dir/src"
printf 'int join(void) { return 0; }\n' >"$dir/src/a.c"
printf '\nlost src/a.c a something\n' >"$dir/test/mutants/list.txt"
printf '{"alias", test_alias, false}\n' >"$dir/test/main.c"
good='[`a.c: join`](src/a.c) and [text](src/a.c#L1), mutant `lost`, `build/test alias`'
failures=0
# expect STATUS TEXT: links.sh ends with STATUS on a document that holds the good line and TEXT.
expect() {
    printf '%s\n%s\n' "$good" "$2" >"$dir/page.md"
    sh test/links.sh "$dir" >/dev/null
    [ $? -eq "$1" ] || { echo "links_test: $2: expected status $1"; failures=1; }
}
expect 0 '[web](https://example.org/nothing.md)'
expect 0 '    [code](nothing.c)'
expect 1 '[text](nothing.c)'
expect 1 '[good](src/a.c), [`a.c: oin`](src/a.c)'
expect 1 '[`b.c: join`](src/a.c)'
expect 1 'mutant `los`'
expect 1 '`build/test al`'
exit $failures

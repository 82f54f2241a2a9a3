#!/bin/sh
# lto.sh CC: print the options for link-time optimisation if this compiler, its linker and its run-time can do it, and
# can link the same objects without it, as the tests are linked.
dir=$(mktemp -d) || exit 0
echo 'int main(void) { return 0; }' >"$dir/a.c"
lto="-flto=auto -ffat-lto-objects"
{
    "$@" $lto -c -o "$dir/a.o" "$dir/a.c" && "$@" -fno-lto -o "$dir/a" "$dir/a.o" && "$dir/a" &&
        "$@" $lto -o "$dir/a" "$dir/a.o" && "$dir/a"
} >/dev/null 2>&1 && echo "$lto"
rm -rf "$dir"

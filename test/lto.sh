#!/bin/sh
# lto.sh CC: print the option for link-time optimisation if this compiler, its linker and its run-time can do it.
dir=$(mktemp -d) || exit 0
echo 'int main(void) { return 0; }' >"$dir/a.c"
"$@" -flto=auto -o "$dir/a" "$dir/a.c" >/dev/null 2>&1 && "$dir/a" && echo -flto=auto
rm -rf "$dir"

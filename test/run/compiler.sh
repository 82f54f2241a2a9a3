#!/bin/sh
# compiler.sh lto CC:    print the options for link-time optimisation if this compiler, its linker and its run-time can
#                        do it, and can link the same objects without it, as all but the renderer is linked; and if
#                        there is an objcopy, which the library needs then.
# compiler.sh depend CC: print the options that write which headers a file includes, if this compiler has them.
wanted=$1
shift
dir=$(mktemp -d) || exit 0
trap 'rm -rf "$dir"' EXIT
echo 'int main(void) { return 0; }' >"$dir/a.c"
case $wanted in
lto)
    options="-flto=auto -ffat-lto-objects"
    command -v objcopy && "$@" $options -c -o "$dir/a.o" "$dir/a.c" && "$@" -fno-lto -o "$dir/a" "$dir/a.o" && "$dir/a" &&
        "$@" $options -o "$dir/a" "$dir/a.o" && "$dir/a"
    ;;
depend)
    options="-MMD -MP"
    "$@" $options -c -o "$dir/a.o" "$dir/a.c" && [ -f "$dir/a.d" ]
    ;;
esac >/dev/null 2>&1 && echo "$options"

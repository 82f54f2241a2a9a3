#!/bin/sh
# builds.sh: README's one-line build gives the pictures of `make`, byte for byte, by whichever compilers and for
# whichever processors are at hand: with fused multiply-add, which compilers like to contract a * b + c to, and with a
# 32-bit long.
# Run from the top: [COMPILERS="gcc clang"] sh test/builds.sh ./asbdpt
program=$1
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
line=$(sed -n 's/^Without make: `cc \([^`]*\)-o asbdpt \([^`]*\)`.*/\1-o "$dir\/other" \2/p' README.md)
[ -n "$line" ] || { echo "FAIL: README.md has no line \"Without make\""; exit 1; }
failures=0

# pictures PROGRAM NAME: a scene of many textures and shapes, and one block without an end.
pictures() {
    "$1" render scenes/living-room.pbrt --res 32x24 --spp 2 --quiet -o "$dir/$2-room.pfm" &&
        "$1" render scenes/cornell-box.pbrt --res 24x24 --spp 4 --quiet --integrator asbdpt \
            -P select=bins -P restart=0 -o "$dir/$2-bins.pfm"
}

# try COMPILER FLAG...: passed over where the compiler cannot make such programs, or the machine not run them.
try() {
    echo 'int main(void) { volatile double a = 2; return !(__builtin_fma(a, a, a) + a * a > 0); }' >"$dir/a.c"
    if ! "$@" -o "$dir/a" "$dir/a.c" -lm >"$dir/log" 2>&1 || ! "$dir/a" >"$dir/log" 2>&1; then
        echo "not tried: $*"
        return
    fi
    eval '"$@" '"$line" || { echo "FAIL: $* does not compile it"; failures=$((failures + 1)); return; }
    pictures "$dir/other" other
    for picture in room bins; do
        cmp "$dir/make-$picture.pfm" "$dir/other-$picture.pfm" && continue
        echo "FAIL: $*: other bytes than make's ($picture)"
        failures=$((failures + 1))
    done
}

pictures "$program" make || exit 1
for compiler in ${COMPILERS:-gcc clang}; do
    try $compiler
    try $compiler -march=haswell
    try $compiler -m32 -msse2 -mfpmath=sse
done
[ $failures -eq 0 ] && echo "builds: the same bytes by all"
exit $((failures > 0))

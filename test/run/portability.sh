#!/bin/sh
# portability.sh [NAME...]: the one-line builds of doc/portability.md, by whichever compilers are at hand, for whichever
# machines these or emulators can run: all of them make the pictures of test/run/hashes.txt, byte for byte. Of every
# target one line is said: the same bytes, skipped (and why), or FAIL. Where there is no fork the suites that need
# none are run too. With NAMEs only those. Run from the top.
chosen=" $* "
dir=build-portability.$$ # its path has no blanks, for it is in lines that are split there
mkdir "$dir" || exit 1
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
failures=0

# line WORDS: the build line of doc/portability.md that follows these WORDS.
line() { tr '\n' ' ' <doc/portability.md | sed -n "s/.*- $1: \`\([^\`]*\)\`.*/\1/p"; }
plain=$(line 'Any Unix') windows=$(line Windows) wasi=$(line WASI)
[ -n "$plain" ] && [ -n "$windows" ] && [ -n "$wasi" ] || { echo "doc/portability.md has no line for each"; exit 1; }

say() { printf '%-14s %s\n' "$1" "$2"; }
failed() {
    say "$1" "FAIL: $2"
    head -5 "$dir/log" | tr -d '\r'
    failures=$((failures + 1))
}

# asked NAME: is this target wanted?
asked() { case $chosen in "  " | *" $1 "*) ;; *) return 1 ;; esac; }

# able NAME RUNNER BUILD FLAG...: can a small program be built like this, and run? If not, it is said.
able() {
    name=$1 runner=$2 build=$3
    shift 3
    for tool in "${build%% *}" ${runner%% *}; do
        command -v "$tool" >/dev/null || { say "$name" "skipped: no $tool"; return 1; }
    done
    printf '#include <errno.h>\n#include <math.h>\n#include <stdio.h>\n' >"$dir/a.c"
    echo 'int main(void) { volatile double a = 2; return !(fma(a, a, sqrt(a)) + a * a > errno); }' >>"$dir/a.c"
    trial=$(echo "$build" | sed "s|src/[^ ]*\.c|$dir/a.c|; s|-o [^ ]*|-o $dir/$name.exe|")
    $trial "$@" >"$dir/log" 2>&1 && $runner "$dir/$name.exe" </dev/null >"$dir/log" 2>&1 && return
    say "$name" "skipped: no program for it can be compiled, or run, here"
    return 1
}

# try NAME RUNNER COMPILER BUILD FLAG...: BUILD is such a line; its compiler and output are replaced, FLAGs added.
try() {
    name=$1 runner=$2 compiler=$3 build=$4
    shift 4
    asked "$name" || return
    program=$dir/$name.exe
    command=$(echo "$build" | sed "s|^[^ ]*|$compiler|; s|-o [^ ]*|-o $program|")
    able "$name" "$runner" "$command" "$@" || return
    if ! $command "$@" 2>"$dir/log"; then
        failed "$name" "does not compile"
    elif ! sh test/run/hashes.sh "${runner:+$runner }$program" >"$dir/log"; then
        failed "$name" "other bytes"
    else
        said="the same bytes"
        ! grep -q 'not compared' "$dir/log" || said="the exception: $(head -1 "$dir/log")"
        say "$name" "$said"
    fi
    rm -f "$program"
}

# suites NAME RUNNER BUILD SUITE...: the test program, built as BUILD builds the other, passes them.
suites() {
    name=$1 runner=$2 build=$3
    shift 3
    asked "$name" && able "$name" "$runner" "$build" || return
    program=$dir/$name.exe
    sources="test/fuzz/hostile.c test/fuzz/lists.c $(ls test/unit/*.c test/lab/*.c test/lab/*/*.c | grep -v -e devices -e fuzz -e hostile)
        $(ls src/*/*.c | grep -v -e src/cli/main.c -e src/cli/program.c -e src/render/rows.c)"
    awk -f test/unit/suites.awk $sources >"$dir/suites.h"
    command=$(echo "$build" | sed "s|-o [^ ]*|-Itest -Itest/lab -Itest/unit -I$dir -o $program|
        s|src/[^ ]*\.c|$(echo $sources)|")
    if ! $command 2>"$dir/log"; then
        failed "$name" "the tests do not compile"
    elif $runner "$program" "$@" </dev/null >"$dir/said" 2>&1; then
        say "$name" "$(tail -1 "$dir/said" | tr -d '\r')"
    else
        grep -A 1 FAIL "$dir/said" >"$dir/log"
        failed "$name" "$(tail -1 "$dir/said" | tr -d '\r')"
    fi
    rm -f "$program"
}

for compiler in gcc clang; do
    try $compiler '' $compiler "$plain"
    try $compiler-O0 '' $compiler "$plain" -O0
    try $compiler-fma '' $compiler "$plain" -march=haswell
    try $compiler-i386 '' $compiler "$plain" -m32 -msse2 -mfpmath=sse
done
try clang-pragma '' clang "$plain" -march=haswell -ffp-contract=on
try gcc-Os '' gcc "$plain" -Os
try gcc-O3-lto '' gcc "$plain" -O3 -flto
try gcc-c11 '' gcc "$plain" -std=c11
try gcc-c17 '' gcc "$plain" -std=c17
try gcc-serial '' gcc "$plain" -DASBDPT_SERIAL
try gcc-x87 '' gcc "$plain" -m32 -mfpmath=387
try musl '' musl-gcc "$plain" -static
try tcc '' tcc "$plain"
export WINEDEBUG=-all # no log of its own
wine=$(command -v wine64 || echo wine) node='node --no-warnings test/run/wasi.mjs'
quick='maths vec warp stats alias zlib image hdr sheet file ply features format shape smooth subdivide kdtree texture lobe bsdf
    material light light-sent camera film parser sampler mis options render part trace pictures aov threads'
try windows "$wine" x86_64-w64-mingw32-gcc "$windows"
suites windows-suites "$wine" "$windows" $quick
try wasi "$node" clang "$wasi"
suites wasi-suites "$node" "$wasi" $quick report plan coverage equal-time # Windows counts CPU time in 64ths of a second, too few for this one
try arm64 qemu-aarch64 aarch64-linux-gnu-gcc "$plain" -static
try armhf qemu-arm arm-linux-gnueabihf-gcc "$plain" -static
try riscv64 qemu-riscv64 riscv64-linux-gnu-gcc "$plain" -static
try ppc64el qemu-ppc64le powerpc64le-linux-gnu-gcc "$plain" -static
try s390x qemu-s390x s390x-linux-gnu-gcc "$plain" -static
try mips64el qemu-mips64el mips64el-linux-gnuabi64-gcc "$plain" -static
try mips qemu-mips mips-linux-gnu-gcc "$plain" -static
exit $((failures > 0))

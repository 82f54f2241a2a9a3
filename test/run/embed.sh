#!/bin/sh
# embed.sh PROGRAM [DRIVER]: the library as others use it: the header in C and C++, doc/embed's program and module, the
# one file of C; memory does not grow from render to render. DRIVER, of `make inject`, does all that the
# library does, while every allocation, write, open, close, rename and thread fails once. FULL=yes: the one file by all
# compilers at hand, the library of it linked, and the notebook's pictures made. BRIEF=yes: without the module, and
# without the many renders. Run from the top after make lib.
. test/run/expect.sh
driver=$2
case $driver in '' | /*) ;; *) driver=$top/$driver ;; esac
cc=${CC:-cc} build=$top/${BUILD:-build}
libs="-lm -lpthread"
ln -s "$top/scenes" scenes
cp "$top/doc/embed/embed.c" .
header="-I$top/src/library"

check $cc -std=c99 -pedantic -Wall -Wextra -Werror "$header" -o embed embed.c "$build/libasbdpt.a" $libs
cat >room.pbrt <<'END'
Film "image" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "infinite"
WorldEnd
END
prints '^8x8 pixels, 16 samples' ./embed room.pbrt room.png
expect 1 'none.pbrt: cannot open' ./embed none.pbrt room.png
printf '#include "asbdpt.h"\n#include <cstdio>\nint main() { return std::puts(asbdpt_version()) < 0; }\n' >a.cpp
if command -v "${CXX:-c++}" >/dev/null; then
    check "${CXX:-c++}" -Wall -Wextra -pedantic -Werror "$header" -o plus a.cpp "$build/libasbdpt.a" $libs
    prints '^asbdpt ' ./plus
fi

# The one file, as program and library, without a word of any compiler that is at hand.
sh -c "cd '$top' && sh doc/embed/amalgamate.sh '$dir/one'" || fault "the one file cannot be made"
cmp -s one/asbdpt.h "$top/src/library/asbdpt.h" || fault "its header is another"
for compiler in $cc ${FULL:+gcc clang tcc}; do
    command -v $compiler >/dev/null || continue
    pedantic="-std=c99 -pedantic -Wall -Werror"
    [ $compiler = tcc ] && pedantic="-std=c99 -Wall"
    check $compiler $pedantic -O0 -ffp-contract=off -o one/asbdpt one/asbdpt.c $libs
    expect 0 '' ./one/asbdpt scenes/cornell-box.pbrt --res 16 --spp 2 --quiet -o one.pfm
    expect 0 '' "$program" scenes/cornell-box.pbrt --res 16 --spp 2 --quiet -o own.pfm
    check cmp one.pfm own.pfm
done
check $cc -std=c99 -pedantic -Wall -Werror -DASBDPT_LIBRARY -fsyntax-only one/asbdpt.c
if [ -n "${FULL-}" ]; then
    check $cc -std=c99 -O0 -ffp-contract=off -DASBDPT_LIBRARY -Ione -c -o one/library.o one/asbdpt.c
    check $cc -std=c99 -Ione -o embed embed.c one/library.o $libs
    prints '^8x8 pixels, 16 samples' ./embed room.pbrt room.png
fi

if [ -z "${BRIEF-}" ] && command -v python3 >/dev/null; then
    ASBDPT_LIBRARY=$build/libasbdpt.so
    export ASBDPT_LIBRARY
    prints '^errors asbdpt 1:' python3 "$top/doc/embed/examples.py" pictures
    check awk '/^errors/ { split($3, a, ":"); split($8, b, ":"); bad += b[2] > 0.8 * a[2]; n++ }
               /^weights/ { bad += $4 <= 0 || $4 > 1; n++ }
               /^strategies/ { bad += $8 + 0 > 1e-4; n++ } END { exit bad || n < 6 }' stdout.txt
    check [ "$(ls pictures | tr '\n' ' ')" = "errors.png strategies.png weights.png " ]
    cat >notebook.py <<'END'
import json, os, sys
sys.path.insert(0, "doc/embed")
import examples # whose pictures are made above
if not os.environ.get("FULL"):
    for name in ("errors", "weights", "strategies"):
        assert callable(getattr(examples, name))
        setattr(examples, name, lambda directory, name=name: "asbdpt " + name)
cells = json.load(open(sys.argv[1]))["cells"]
lines = "".join("".join(c["source"]) + "\n" for c in cells if c["cell_type"] == "code").split("\n")
exec("\n".join(line for line in lines if "Image" not in line))
END
    ln -s "$top/doc" doc
    prints asbdpt python3 notebook.py doc/embed/examples.ipynb
fi

check $cc -std=c99 -I"$top/src" -o many "$top/test/fuzz/embed.c" "$build/libasbdpt.a" $libs
if [ -z "${BRIEF-}" ]; then
    # Of a leak memory grows again and again. What a system's allocator takes when two threads first meet comes once.
    expect 0 '' ./many room.pbrt -n 1600
    check awk 'NR > 1 && $1 > last + 24 { grown++ } { last = $1 } END { exit !(NR == 4 && grown < 2) }' stdout.txt
fi
mkdir files
prints '^4 samples' ./many scenes/cornell-box.pbrt files
check [ "$(ls files | tr '\n' ' ')" = "a.checkpoint a.exr a.part a.pfm a.png a.ppm " ]

if [ -n "$driver" ]; then
    ASAN_OPTIONS=detect_leaks=0 # what fails may end the process
    export ASAN_OPTIONS
    rm -rf out && mkdir out
    INJECT=count "$driver" room.pbrt out >/dev/null 2>counts.txt || fault "without a fault: $(cat counts.txt)"
    runs=0
    while read -r word kind n; do
        [ "$word" = inject ] || continue
        i=0
        while [ $((i += 1)) -le "$n" ]; do
            rm -rf out && mkdir out
            INJECT=$kind:$i "$driver" room.pbrt out >stdout.txt 2>stderr.txt
            status=$?
            runs=$((runs + 1))
            { [ $status -eq 0 ] || { [ $status -eq 1 ] && [ -s stderr.txt ]; }; } ||
                fault "$kind $i of $n: status $status, $(cat stderr.txt)"
            grep -q Sanitizer stderr.txt && fault "$kind $i: $(cat stderr.txt)"
            find out -name '*.tmp*' | grep -q . && fault "$kind $i: a temporary file stays"
        done
    done <counts.txt
    echo "embed: $runs faults injected"
fi
[ $failures -eq 0 ] && echo "embed: all as expected"
exit $((failures > 0))

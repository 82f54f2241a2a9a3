#!/bin/sh
# inject.sh PROGRAM: every allocation, write, open, close, rename and thread fails once, one run each, of a small
# render, verify, merge and experiment. PROGRAM is built by `make inject`, see test/fuzz/inject.c. Each run must end
# with 0 or 1, with a message if 1, without a file half-written; a run that ends with 0 leaves the picture that it must.
# ALL=1 tries every call; without, of the many of a kind the first, the last 15 and 30 between.
. test/expect.sh
cat >scene.pbrt <<'END'
Film "image" "integer xresolution" 4 "integer yresolution" 3
WorldBegin
Translate 0 0 3
Texture "t" "float" "checkerboard"
Material "plastic" "texture roughness" "t"
AreaLightSource "diffuse"
Shape "sphere"
WorldEnd
END
runs=0

fail() {
    fault "$*"
    cat stderr.txt
}

# try KIND N OUTPUT COMMAND...: one run; OUTPUT is what it leaves when it ends well, as good/OUTPUT is.
try() {
    kind=$1 n=$2 output=$3
    shift 3
    rm -rf work && cp -r start work && cd work || exit 1
    INJECT=$kind:$n "$@" >/dev/null 2>../stderr.txt
    status=$?
    cd ..
    runs=$((runs + 1))
    what="$kind $n of $*: ended with $status"
    case $status in
    0) [ ! -e "good/$output" ] || cmp -s "work/$output" "good/$output" || fail "$what, $output differs" ;;
    1)
        [ -s stderr.txt ] || fail "$what, without a word"
        if [ -e "work/$output" ]; then
            cmp -s "work/$output" "good/$output" || cmp -s "work/$output" "start/$output" || fail "$what, half $output"
        fi
        ;;
    *) fail "$what" ;;
    esac
    [ -z "$(find work -name '.asbdpt-*')" ] || fail "$what, and leaves a temporary file"
}

# all OUTPUT COMMAND...: every call of every kind.
all() {
    output=$1
    shift
    rm -rf good && cp -r start good && cd good || exit 1
    INJECT=count "$@" >/dev/null 2>../counts.txt || { cat ../counts.txt; exit 1; }
    cd ..
    for kind in memory write close store open rename thread; do
        calls=$(sed -n "s/^inject $kind //p" counts.txt)
        step=1
        [ -z "$ALL" ] && [ "$calls" -gt $((first + 45)) ] && step=$(((calls - first - 15) / 30 + 1))
        n=1
        while [ "$n" -le "$calls" ]; do
            try $kind $n "$output" "$@"
            if [ "$n" -lt "$first" ] || [ "$n" -ge $((calls - 15)) ]; then n=$((n + 1)); else n=$((n + step)); fi
        done
        echo "$(basename "$1") $2: $kind: $calls calls"
    done
}

first=100
mkdir start
cp scene.pbrt start
all out.png "$program" render scene.pbrt --spp 1 -j3 --quiet -o out.png -o other.exr
cp good/out.png start # an old picture stays as it is, or is replaced by a whole one
all out.png "$program" render scene.pbrt --spp 2 -j1 --quiet -o out.png --checkpoint film.part
"$program" render scene.pbrt --spp 2 --samples 0:1 --quiet -o start/a.part 2>/dev/null
"$program" render scene.pbrt --spp 2 --samples 1:2 --quiet -o start/b.part 2>/dev/null
all sum.pfm "$program" merge -o sum.pfm a.part b.part
all none "$program" verify scene.pbrt --methods pt,bdpt --batches 4 --spp 1
first=15
all none "$program" experiment scene.pbrt -o results --res 4x3 --spp 1 --seeds 1 --reference-spp 4 --quiet
echo "$runs runs, $failures failed"
[ $failures -eq 0 ]

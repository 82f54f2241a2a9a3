#!/bin/sh
# inject.sh PROGRAM: every allocation, write (of a buffer), open, close, store, rename and thread fails once, one run
# each, of a small render, verify, merge and experiment. PROGRAM is built by `make inject`, see test/fuzz/inject.c. Each
# run must end with 0, and what it leaves and prints must be what it is without the fault, or with 1 and a message,
# leaving no file but whole ones. An experiment that has ended with 1 is started again, and must end as if nothing had
# been. Two runs at a time (WORKERS=2).
[ -w /dev/shm ] && export TMPDIR=/dev/shm # where storing a file takes no time
. test/run/expect.sh
workers=${WORKERS:-2}
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

fail() {
    fault "$*"
    cat stderr.txt
}

# What of work/OUTPUT, a file or a directory, is not as in good/OUTPUT, or, if it is an old file, in start/OUTPUT.
wrong() {
    [ -e "work/$output" ] || return
    cmp -s "work/$output" "start/$output" 2>/dev/null && return
    diff -rq "good/$output" "work/$output" | grep -v '^Only in good'
}

# Is work/OUTPUT what it must be where the run ended well? A render kept from before that cannot be opened is done
# again: its pictures are the same, its times are not.
same() {
    if [ $kind = open ] && [ -d "good/$output/images" ]; then
        diff -rq "good/$output/images" "work/$output/images" >/dev/null &&
            ! diff -rq "good/$output" "work/$output" | grep -q '^Only in'
    else
        diff -rq "good/$output" "work/$output" >/dev/null
    fi
}

# try KIND N COMMAND...: one run.
try() {
    kind=$1 n=$2
    shift 2
    rm -rf work && cp -r start work && cd work || exit 1
    INJECT=$kind:$n "$@" >../stdout.txt 2>../stderr.txt
    status=$?
    cd ..
    runs=$((runs + 1))
    what="$kind $n of $*: ended with $status"
    [ -z "$(find work -name '.asbdpt-*')" ] || fail "$what, and leaves a temporary file"
    case $status in
    0)
        survived=$((survived + 1))
        same || fail "$what, $output differs"
        [ -z "$prints" ] || cmp -s stdout.txt good.txt || fail "$what, and says something else"
        ;;
    1)
        [ -s stderr.txt ] || fail "$what, without a word"
        [ -z "$(wrong)" ] || fail "$what, and leaves: $(wrong | head -n 3)"
        if [ -n "$again" ] && [ $kind != memory ]; then
            (cd work && "$@" >/dev/null 2>../stderr.txt) || fail "$what, and so when started again"
            diff -rq "good/$output" "work/$output" >/dev/null || fail "$what, and started again its $output differs"
        fi
        ;;
    *) fail "$what" ;;
    esac
}

# all OUTPUT COMMAND...: every call of every kind, of which some are this worker's. Where `rest` has counts: but for the
# last so many, less 30.
all() {
    output=$1
    shift
    rm -rf good && cp -r start good && cd good || exit 1
    INJECT=count "$@" >../good.txt 2>../counts.txt || { cat ../counts.txt; exit 1; }
    cd ..
    [ "$worker" -gt 0 ] || echo "$(basename "$1") $2, calls: $(sed -n 's/^inject //p' counts.txt | tr '\n' ' ')"
    for kind in memory write close store open rename thread; do
        calls=$(sed -n "s/^inject $kind //p" counts.txt)
        [ -z "$rest" ] || calls=$((calls - $(sed -n "s/^inject $kind //p" "$rest") + 30))
        n=1
        while [ "$n" -le "$calls" ]; do
            turn=$((turn + 1))
            [ $((turn % workers)) -ne "$worker" ] || try $kind $n "$@"
            n=$((n + 1))
        done
    done
}

# work NUMBER: all faults that are this worker's, in a directory of its own. The experiment is tried twice, as what it
# does after its renders, and their times, are the same if these are there already.
work() {
    worker=$1 runs=0 survived=0 failures=0 turn=0 rest= again= prints=
    mkdir "$worker" && cd "$worker" && mkdir start && cp ../scene.pbrt start || exit 1
    all out.png "$program" render scene.pbrt --spp 1 -j3 --quiet -o out.png -o other.exr
    cp good/out.png start # an old picture stays as it is, or is replaced by a whole one
    all out.png "$program" render scene.pbrt --spp 2 -j1 --quiet -o out.png --checkpoint film.part
    (cd start && "$program" render scene.pbrt --spp 2 --samples 0:1 --quiet -o a.part 2>/dev/null)
    (cd start && "$program" render scene.pbrt --spp 2 --samples 1:2 --quiet -o b.part 2>/dev/null)
    all sum.pfm "$program" merge -o sum.pfm a.part b.part
    prints=yes
    all scene.pbrt "$lab" verify scene.pbrt --methods pt,bdpt --batches 4 --spp 1
    prints=
    set -- "$lab" experiment scene.pbrt -o results --res 2x1 --spp 1 --maxdepth 1 --seeds 1 --reference-spp 4 \
        --quiet
    (cd start && "$@" >/dev/null 2>&1)
    rm -rf start/results/results.* start/results/report.html start/results/images/*.png
    all results "$@"
    cp counts.txt report.txt
    rm -rf start/results
    rest=report.txt again=yes
    all results/images "$@"
    echo "$runs $survived $failures" >result.txt
}

k=0
while [ $k -lt "$workers" ]; do
    (work $k) &
    k=$((k + 1))
done
wait
cat [0-9]*/result.txt | awk -v workers="$workers" '{ runs += $1; survived += $2; failed += $3 }
    END { printf "%d faults: %d survived, %d ended it, %d failed\n", runs, survived, runs - survived, failed
          exit NR == workers && runs > 2000 && survived > 0 && failed == 0 ? 0 : 1 }'

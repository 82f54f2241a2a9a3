#!/bin/sh
# make-ref.sh: render the stored references again; `make ref` calls it.  sh ref/make-ref.sh [PROGRAM [WORK [SCENE...]]]
#
# Every scene is rendered by two methods, pt and bdpt where pt can, each in 16 independent batches of 256 to 1024 samples
# per pixel (4096 to 16384 in all) with seeds of their own. `asbdpt-lab verify --files` tests that the two agree, tile by tile, and only then stores
#     ref/NAME.pfm        the mean of both methods, weighted by the inverse of their variances
#     ref/NAME.error.pfm  its standard errors
#     ref/NAME.txt        how it was made: commands, seeds, version, mean, p-values
# The scene "demo" is the picture that `make demo` measures against, ref/demo/veach-ajar.png: larger, for the eye, and by
# bdpt alone. Batches are kept in WORK: a run that was interrupted goes on where it stopped. One thread takes about an hour and a quarter.
set -e
program=${1:-./asbdpt} lab=${1:-./asbdpt}-lab
work=${2:-build/ref}
[ $# -gt 2 ] && shift 2 || set -- demo cornell-box cornell-box-modified living-room veach-ajar bathroom \
    caustic-glass sky spot corridor many-lights forest
batches=16

# The resolution of a scene's reference: a tenth of its own, or thereabouts.
resolution() {
    case $1 in
        cornell-box*) echo 32x32 ;;
        living-room | veach-ajar) echo 48x27 ;;
        *) echo 36x24 ;;
    esac
}

# Samples per pixel and batch: fewer where they are dear or err little.
samples() {
    case $1 in
        forest) echo 256 ;;
        corridor | many-lights) echo 512 ;;
        *) echo 1024 ;;
    esac
}

# The two methods. A spot light's caustic through glass is beyond pt, and beyond lt what is seen by way of glass.
methods() {
    case $1 in
        caustic-glass) echo bdpt asbdpt ;;
        *) echo pt bdpt ;;
    esac
}

# render SCENE METHOD FIRST_SEED: the batches that are still missing.
render() {
    i=0
    while [ $i -lt $batches ]; do
        file=$work/$1-$2-$i.pfm
        if [ ! -f "$file" ]; then
            "$program" render "scenes/$1.pbrt" --integrator "$2" --res "$(resolution "$1")" --filter box \
                --spp "$(samples "$1")" --seed $(($3 + i)) --nthreads 1 --quiet -o "$work/part.pfm"
            mv "$work/part.pfm" "$file"
        fi
        i=$((i + 1))
    done
}

# demo: four renders by bdpt, two against two.
demo() {
    for seed in 3000 3001 3002 3003; do
        [ -f "$work/demo-$seed.pfm" ] && continue
        "$program" render scenes/veach-ajar.pbrt --integrator bdpt --res 240x135 --filter box --spp 384 --seed $seed \
            --quiet -o "$work/part.pfm"
        mv "$work/part.pfm" "$work/demo-$seed.pfm"
    done
    "$lab" verify scenes/veach-ajar.pbrt --files "$work"/demo-300[01].pfm --against "$work"/demo-300[23].pfm \
        --store "$work/veach-ajar" --note "$("$program" --version), ref/make-ref.sh demo: bdpt with seeds 3000 to 3003, \
each with 384 samples per pixel, 240x135 pixels, box filter"
    mkdir -p ref/demo
    "$program" convert "$work/veach-ajar.pfm" -o ref/demo/veach-ajar.png
    cp "$work/veach-ajar.txt" ref/demo/
}

mkdir -p "$work"
for scene; do
    [ "$scene" = demo ] && { demo; continue; }
    pair=$(methods "$scene")
    a=${pair% *} b=${pair#* }
    render "$scene" "$a" 1000
    render "$scene" "$b" 2000
    note="$("$program" --version), ref/make-ref.sh: $a with seeds 1000 to $((999 + batches)) and $b with seeds 2000"
    note="$note to $((1999 + batches)), each with $(samples "$scene") samples per pixel, $(resolution "$scene") pixels, box filter"
    "$lab" verify "scenes/$scene.pbrt" --files "$work/$scene-$a-"*.pfm --against "$work/$scene-$b-"*.pfm \
        --store "ref/$scene" --note "$note"
done

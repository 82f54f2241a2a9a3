#!/bin/sh
# make-ref.sh: render the stored references again; `make ref` calls it.  sh ref/make-ref.sh [PROGRAM [WORK [SCENE...]]]
#
# Every scene is rendered by pt and by bdpt, each in 16 independent batches of 1024 samples per pixel (16384 in all) with
# seeds of their own. `asbdpt verify --files` tests that the two agree, tile by tile, and only then stores
#     ref/NAME.pfm        the mean of both methods, weighted by the inverse of their variances
#     ref/NAME.error.pfm  its standard errors
#     ref/NAME.txt        how it was made: commands, seeds, version, mean, p-values
# Batches are kept in WORK: a run that was interrupted goes on where it stopped. One thread takes about an hour.
set -e
program=${1:-./asbdpt}
work=${2:-build/ref}
[ $# -gt 2 ] && shift 2 || set -- cornell-box cornell-box-modified living-room veach-ajar bathroom
batches=16
spp=1024

# The resolution of a scene's reference: a tenth of its own, or thereabouts.
resolution() {
    case $1 in
        cornell-box*) echo 32x32 ;;
        bathroom) echo 36x24 ;;
        *) echo 48x27 ;;
    esac
}

# render SCENE METHOD FIRST_SEED: the batches that are still missing.
render() {
    i=0
    while [ $i -lt $batches ]; do
        file=$work/$1-$2-$i.pfm
        if [ ! -f "$file" ]; then
            "$program" render "scenes/$1.pbrt" --integrator "$2" --res "$(resolution "$1")" --filter box --spp $spp \
                --seed $(($3 + i)) --nthreads 1 --quiet -o "$work/part.pfm"
            mv "$work/part.pfm" "$file"
        fi
        i=$((i + 1))
    done
}

mkdir -p "$work"
for scene; do
    render "$scene" pt 1000
    render "$scene" bdpt 2000
    note="$("$program" --version), ref/make-ref.sh: pt with seeds 1000 to $((999 + batches)) and bdpt with seeds 2000"
    note="$note to $((1999 + batches)), each with $spp samples per pixel, $(resolution "$scene") pixels, box filter"
    "$program" verify "scenes/$scene.pbrt" --files "$work/$scene-pt-"*.pfm --against "$work/$scene-bdpt-"*.pfm \
        --store "ref/$scene" --note "$note"
done

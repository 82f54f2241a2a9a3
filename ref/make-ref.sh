#!/bin/sh
# make-ref.sh: render the stored references again; `make ref` calls it.  sh ref/make-ref.sh [PROGRAM [WORK [SCENE...]]]
#
# Every scene is rendered by two methods, pt and bdpt where pt can, each in 16 independent batches of 256 to 1024 samples
# per pixel (4096 to 16384 in all) with seeds of their own. `asbdpt-lab verify --files` tests that the two agree, tile by tile, and only then stores
#     ref/NAME.pfm        the mean of both methods, weighted by the inverse of their variances
#     ref/NAME.error.pfm  its standard errors
#     ref/made.txt        how each was made: commands, seeds, version, mean, p-values
# SCENES=DIR takes DIR/NAME/scene.pbrt of another folder instead, REFS=DIR keeps what is made there, RES=, SPP= (of a batch)
# and MAXDEPTH= choose size, samples and longest path:
#     SCENES=published REFS=published/refs RES=128 SPP=256 MAXDEPTH=8 sh ref/make-ref.sh ./asbdpt build/pub cornell-box
# The scene "demo" is the picture that `make demo` measures against, ref/demo/corridor.png: larger, for the eye, and by
# asbdpt alone. Batches are kept in WORK: a run that was interrupted goes on where it stopped. One thread takes about an hour and a quarter.
set -e
program=${1:-./asbdpt} lab=${1:-./asbdpt}-lab
work=${2:-build/ref}
[ $# -gt 2 ] && shift 2 || set -- demo cornell-box cornell-box-modified living-room veach-ajar bathroom \
    caustic-glass sky spot corridor many-lights forest
batches=16 refs=${REFS-ref}

# The file of a scene.
file() { [ -z "${SCENES-}" ] && echo "scenes/$1.pbrt" || echo "$SCENES/$1/scene.pbrt"; }

# The resolution of a scene's reference: a tenth of its own, or thereabouts.
resolution() {
    case ${RES-$1} in
        [0-9]*) echo "$RES" ;;
        cornell-box*) echo 32x32 ;;
        living-room | veach-ajar) echo 48x27 ;;
        *) echo 36x24 ;;
    esac
}

# Samples per pixel and batch: fewer where they are dear or err little.
samples() {
    case ${SPP-$1} in
        [0-9]*) echo "$SPP" ;;
        forest) echo 256 ;;
        corridor | many-lights) echo 512 ;;
        *) echo 1024 ;;
    esac
}

# The two methods, as `asbdpt-lab verify --methods` names them. A spot light's caustic through glass is beyond pt; bdpt and
# asbdpt miss the part of it that is seen through glass.
methods() {
    case $1 in
        caustic-glass) echo caustics caustics:with=asbdpt ;;
        *) echo pt bdpt ;;
    esac
}

# render SCENE METHOD FIRST_SEED: the batches that are still missing.
render() {
    i=0
    parameter=${2#"${2%%:*}"}
    while [ $i -lt $batches ]; do
        file=$work/$1-$2-$i.pfm
        if [ ! -f "$file" ]; then
            "$lab" render "$(file "$1")" ${MAXDEPTH:+--maxdepth "$MAXDEPTH"} --integrator "${2%%:*}" ${parameter:+-P "${parameter#:}"} --filter box \
                --res "$(resolution "$1")" --spp "$(samples "$1")" --seed $(($3 + i)) --nthreads 1 --quiet --unclamped \
                -o "$work/part.pfm"
            mv "$work/part.pfm" "$file"
        fi
        i=$((i + 1))
    done
}

# demo: one render by asbdpt, which is clean where bdpt would need twenty times as long. For the eye. How noisy it is
# another one tells.
demo() {
    mkdir -p ref/demo
    for seed in 3000 3001; do
        "$program" render scenes/corridor.pbrt --integrator asbdpt --res 240x160 --filter box --spp 96 --seed $seed \
            --quiet -o "$work/demo-$seed.png"
    done
    cp "$work/demo-3000.png" ref/demo/corridor.png
    {
        echo "origin $("$program" --version), ref/make-ref.sh demo: asbdpt with seed 3000, 96 samples per pixel, 240x160 \
pixels, box filter"
        echo "scene scenes/corridor.pbrt"
        awk '/^== / { here = $2 == "corridor" } here && /^content /' ref/made.txt
        echo "resolution 240x160"
        echo "maxdepth 10"
        "$lab" compare "$work/demo-3000.png" "$work/demo-3001.png" |
            awk '$1 == "rmse8" { printf "noise8 %.3g\n", $2 / sqrt(2) }'
    } >ref/demo/corridor.txt
}

# note SCENE: its text becomes the last of the list.
note() {
    {
        [ ! -f "$refs/made.txt" ] || awk -v name="$1" '/^== / { other = $2 != name } other' "$refs/made.txt"
        echo "== $1"
        cat "$refs/$1.txt"
    } >"$work/made.txt"
    mv "$work/made.txt" "$refs/made.txt"
    rm "$refs/$1.txt"
}

mkdir -p "$work" "$refs"
for scene; do
    [ "$scene" = demo ] && { demo; continue; }
    pair=$(methods "$scene")
    a=${pair% *} b=${pair#* }
    render "$scene" "$a" 1000
    render "$scene" "$b" 2000
    how="$("$program" --version), ref/make-ref.sh: $a with seeds 1000 to $((999 + batches)) and $b with seeds 2000"
    how="$how to $((1999 + batches)), each with $(samples "$scene") samples per pixel, $(resolution "$scene") pixels, box filter"
    "$lab" verify "$(file "$scene")" ${MAXDEPTH:+--maxdepth "$MAXDEPTH"} --files "$work/$scene-$a-"*.pfm --against "$work/$scene-$b-"*.pfm \
        --store "$refs/$scene" --note "$how"
    note "$scene"
done

#!/bin/sh
# references.sh OUT: the dissertation's five published scenes by pbrt-v3, as REFERENCES of what is measured: for each
# OUT/NAME.pfm, the mean of BATCHES (8, an even number) renders, and
# OUT/NAME.txt, its longest path and its noise. What is there stays.
#   PEERS=DIR PUBLISHED=DIR sh test/measure/references.sh OUT [NAME...]
# Needs pbrt-v3 (test/measure/peers.sh build) and some four hours of one thread. SPP= takes other numbers of samples.
# pbrt-v3 has no seeds: each tile begins with the same random numbers. So each batch takes one sample more than the one
# before it. Then all pixels but the first of a tile get other random numbers.
set -eu
absolute() { case $1 in /*) echo "$1" ;; *) echo "$PWD/$1" ;; esac; }
batches=${BATCHES:-8} program=$PWD/asbdpt out=$(absolute "$1") published=$(absolute "$PUBLISHED") pbrt=$(absolute "$PEERS/pbrt")
[ -x "$pbrt" ] || pbrt=$(absolute "$PEERS/pbrt-v3/build/pbrt")
mkdir -p "$out"
shift
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"

# job NAME: width, height, longest path, integrator, samples.
job() {
    case $1 in
    living-room) echo 160 90 8 path 4096 ;;
    veach-ajar) echo 160 90 8 bdpt 4096 ;;
    bathroom) echo 128 128 8 bdpt 1024 ;;
    *) echo 128 128 6 bdpt 1024 ;;
    esac
}
# batch SAMPLES: of $scene, into SAMPLES.pfm.
batch() {
    sed -E -e "s/^Integrator .*/Integrator \"$integrator\" \"integer maxdepth\" $depth/" \
        -e "s/^Sampler .*/Sampler \"random\" \"integer pixelsamples\" $1/" \
        -e 's/^PixelFilter .*/PixelFilter "box"/' \
        -e "s/^Film .*/Film \"image\" \"string filename\" \"x.exr\" \"integer xresolution\" $width \"integer yresolution\" $height/" \
        "$published/$scene/scene.pbrt" >"$scene/run.pbrt"
    (cd "$scene" && "$pbrt" --quiet run.pbrt)
    "$program" convert "$scene/x.exr" -o "$1.pfm" --quiet
}
# mean FILE IMAGE...: their mean.
mean() {
    to=$1
    shift
    "$program-lab" sum "$@" --weights "$(echo "$@" | awk '{ for (i = 1; i <= NF; i++) printf "%s%.17g", (i > 1 ? "," : ""), 1 / NF }')" \
        -o "$to" --quiet
}

[ $# -gt 0 ] || set -- cornell-box cornell-box-modified veach-ajar living-room bathroom
for scene; do
    [ ! -f "$out/$scene.txt" ] || continue
    read -r width height depth integrator spp <<JOB
$(job "$scene")
JOB
    cp -R "$published/$scene" .
    rm -f ./*.pfm
    set --
    for i in $(seq "$batches"); do
        batch $((${SPP:-$spp} / batches + i))
        set -- "$@" $((${SPP:-$spp} / batches + i)).pfm
    done
    mean "$out/$scene.pfm" "$@"
    mean first.pfm $(echo "$@" | cut -d ' ' -f 1-$((batches / 2)))
    mean second.pfm $(echo "$@" | cut -d ' ' -f $((batches / 2 + 1))-)
    {
        echo "maxdepth $depth"
        "$program-lab" compare first.pfm second.pfm |
            awk '$1 == "rmse8" { printf "noise8 %.4f\n", $2 / 2 }' # twice the noise of the mean of both
        for image; do "$program-lab" compare "$image" "$out/$scene.pfm"; done |
            awk '$1 == "mean_ratio" { n++; off += ($2 - 1) ^ 2 } END { printf "mean_error %.4f\n", sqrt(off / n / (n - 1)) }'
    } >text
    mv text "$out/$scene.txt"
    rm -rf "$scene"
done

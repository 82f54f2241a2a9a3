#!/bin/sh
# pbrt_references.sh OUT: the dissertation's five published scenes by pbrt-v3, as REFERENCES of what is measured: for
# each OUT/NAME.pfm, the mean of BATCHES (8, an even number) renders, and OUT/NAME.txt, its longest path and its noise.
# What is there stays.
#   PEERS=DIR PUBLISHED=DIR sh test/measure/pbrt_references.sh OUT [NAME...]
# Needs pbrt-v3 (test/measure/peers.sh build) and some four hours of one thread. SPP= takes other numbers of samples.
# pbrt-v3 has no seeds: each tile begins with the same random numbers. So each batch takes one sample more than the one
# before it. Then all pixels but the first of a tile get other random numbers.
set -eu
. test/measure/pbrt.sh
out=$1 batches=${BATCHES:-8}
mkdir -p "$out"
shift

# batch INTEGRATOR SAMPLES NUMBER: of $scene, into $dir/NUMBER.pfm.
batch() {
    pbrt_scene "$1" "$2"
    (cd "$dir/$scene" && "$pbrt" --quiet run.pbrt)
    ./asbdpt convert "$dir/$scene/x.exr" -o "$dir/$3.pfm" --quiet
}
# mean FILE FIRST LAST: of these batches.
mean() {
    to=$1 first=$2 last=$3
    set --
    for i in $(seq "$first" "$last"); do set -- "$@" "$dir/$i.pfm"; done
    ./asbdpt-lab sum "$@" -o "$to" --quiet --weights "$(seq "$first" "$last" |
        awk -v n=$# '{ printf "%s%.17g", (NR > 1 ? "," : ""), 1 / n }')"
}

published_scenes | while read -r scene width height depth integrator spp; do
    case " ${*:-$scene} " in *" $scene "*) ;; *) continue ;; esac
    [ ! -f "$out/$scene.txt" ] || continue
    for i in $(seq "$batches"); do batch "$integrator" $((${SPP:-$spp} / batches + i)) "$i" </dev/null; done
    mean "$out/$scene.pfm" 1 "$batches"
    mean "$dir/first.pfm" 1 $((batches / 2))
    mean "$dir/second.pfm" $((batches / 2 + 1)) "$batches"
    {
        echo "maxdepth $depth"
        ./asbdpt-lab compare "$dir/first.pfm" "$dir/second.pfm" |
            awk '$1 == "rmse8" { printf "noise8 %.4f\n", $2 / 2 }' # twice the noise of the mean of both
        for i in $(seq "$batches"); do ./asbdpt-lab compare "$dir/$i.pfm" "$out/$scene.pfm"; done |
            awk '$1 == "mean_ratio" { n++; off += ($2 - 1) ^ 2 } END { printf "mean_error %.4f\n", sqrt(off / n / (n - 1)) }'
    } >"$dir/text"
    mv "$dir/text" "$out/$scene.txt"
done

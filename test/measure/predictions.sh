#!/bin/sh
# predictions.sh DIR: is the race (integrators/race.h) right? In COUNT (30) scenes of test/unit/random_structure.h,
# from number FIRST (370) on, every runner renders after the same CPU time: RES (96x72), the time of SPP (32) samples
# of the first, SEEDS (3) seeds. Into DIR, going on with what is there: what equal-time writes, what `info --race`
# predicts, and race.txt (predictions.awk): how often the runner that was predicted to be best is, what a wrong one
# costs, and how far prices are from CPU times. Needs BUILD/test.
# Exit status 1 if prices are wrong by more than PRICE (0.12), the root of the mean square of their logarithms.
dir=$1 first=${FIRST:-370} size=${RES:-96x72}
mkdir -p "$dir/scenes" || exit 1
set --
for number in $(seq "$first" $((first + ${COUNT:-30} - 1))); do
    "${BUILD:-build}/test" --structure "$number" >"$dir/scene" || exit 1
    to=$dir/scenes/$(sed -n 's/^# structure \([0-9]*\): /\1-/p' "$dir/scene").pbrt
    mv "$dir/scene" "$to" && set -- "$@" "$to"
done
for scene; do
    echo "scene $(basename "$scene" .pbrt)"
    ./asbdpt-lab info "$scene" --race --res "$size" --quiet || exit 1
done >"$dir/predicted"
./asbdpt-lab equal-time "$@" -o "$dir" --res "$size" --spp "${SPP:-32}" --seeds "${SEEDS:-3}" --quiet --methods \
    asbdpt:race=all,asbdpt:race=quarter,asbdpt:race=path_tracer,asbdpt:race=one_point \
    >"$dir/said" || exit 1
awk -F , -v most="${PRICE:-0.12}" -f test/measure/evidence/predictions.awk "$dir/predicted" "$dir/runs.csv" "$dir/equal-time.md" \
    >"$dir/race.txt"

#!/bin/sh
# structures.sh DIR: bdpt, pt and asbdpt after the same CPU time in COUNT (40) scenes of test/unit/random_structure.h,
# from number FIRST (300) on, on which nothing was chosen: RES (128x96), the time of SPP (64) samples of bdpt, SEEDS (3)
# seeds. Into DIR, going on with what is there: what equal-time writes, and structures.txt and structures.svg
# (equal.awk). Needs BUILD/test. Exit status 1 if asbdpt surely has more than WORST (1.15) of the squared error of
# the better of the others in a scene, or more than MEAN (0.55) in the geometric mean, or no sample in that time.
# If both are set to nothing, that is not asked.
# structures.sh draw: structures.svg of structures.txt.
draw() {
    awk '/^== / { on = $2 == "data" } on && NF == 10 { print $1, $2, $3, $4, "-" }' | sort -t - -k 2,2 -k 1,1n |
        awk -v title="Squared error (mse8) in the same CPU time, relative to the better of bdpt and pt" \
            -v dot="asbdpt, with its 95 % interval" -v axis="1: as good as the better; lower is better" \
            -v least=0.1 -v most=5 -f doc/tour/dots.awk
}
[ "$1" != draw ] || { draw; exit; }
dir=$1
mkdir -p "$dir/scenes" || exit 1
set --
first=${FIRST:-300}
for number in $(seq "$first" $((first + ${COUNT:-40} - 1))); do
    "${BUILD:-build}/test" --structure "$number" >"$dir/scene" || exit 1
    to=$dir/scenes/$(sed -n 's/^# structure \([0-9]*\): /\1-/p' "$dir/scene").pbrt
    mv "$dir/scene" "$to" && set -- "$@" "$to"
done
./asbdpt-lab equal-time "$@" -o "$dir" --methods bdpt,pt,asbdpt --res "${RES:-128x96}" --spp "${SPP:-64}" \
    --seeds "${SEEDS:-3}" --quiet >"$dir/said" || exit 1
awk -f test/measure/evidence/unknown.awk "$dir/equal-time.md" >"$dir/unknown"
awk -v missing="$dir/unknown" -v kinds=yes -v worst="${WORST-1.15}" -v mean="${MEAN-0.55}" \
    -f test/measure/evidence/better.awk -f test/measure/evidence/equal.awk "$dir/runs.csv" >"$dir/structures.txt"
status=$?
draw <"$dir/structures.txt" >"$dir/structures.svg"
exit $status

#!/bin/sh
# figures.sh PROGRAM [DIR]: makes every figure of the tour in doc/tour/figures or DIR (about four minutes of CPU), except
# those of measured numbers, which test/measure/evidence.sh makes. `make figures` calls it.
program=$1
case $program in /*) ;; *) program=$PWD/$program ;; esac
lab=$program-lab
tour=$PWD/doc/tour scene=$PWD/doc/mini/rooms.pbrt out=$PWD/${2:-doc/tour/figures}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
set -e
mkdir -p "$out"
render() { "$program" render "$scene" --quiet "$@"; }
# chart NAME TITLE AXIS [TOGETHER]: table.txt as a bar chart.
chart() {
    [ -s table.txt ]
    awk -v title="$2" -v axis="$3" -v together="${4-0}" -f "$tour/chart.awk" table.txt >"$out/$1.svg"
}

# The same scene by every method, 16 samples per pixel.
for method in pt lt bdpt; do
    render --integrator $method --spp 16 -o "$out/$method.png"
done

# The same scene in the same CPU time: how many samples that is depends on the machine.
"$lab" equal-time "$scene" --spp 16 --seeds 3 --reference-spp 512 --quiet -o equal >/dev/null
cp equal/images/rooms.png "$out/equal.png"

# Every strategy alone, as it is and weighted.
"$lab" strategies "$scene" --integrator bdpt --spp 64 --res 96x96 --maxdepth 4 -o pyramid --quiet
cp pyramid/pyramid.png "$out/"

# What selection has learnt, seen from the floor.
"$lab" worth "$scene" --pixel 64,100 --spp 64 --quiet -o "$out/worth.png"

# One sample, seen in the left sphere.
(cd "$tour/../.." && "$lab" trace doc/mini/rooms.pbrt --integrator bdpt --pixel 60,80 --sample 22 --maxdepth 4 \
    --svg "$out/trace.svg" >/dev/null)

# How the error falls: root mean square of 8-bit values, of 16 x 16 pixels.
render --integrator bdpt --spp 16384 --res 16x16 --seed 7 -o truth.pfm
for method in pt bdpt asbdpt; do
    for spp in 1 4 16 64 256 1024; do
        render --integrator $method --spp $spp --res 16x16 -o x.pfm
        "$lab" compare x.pfm truth.pfm | awk -v method=$method -v spp=$spp '$1 == "rmse8" { print method, spp, $2 }'
    done
done >table.txt
awk -v title="Error over samples; dashed: proportional to 1/sqrt(N)" -f "$tour/fall.awk" table.txt >"$out/fall.svg"

# How far off the mean of bins is, for several numbers of iterations between restarts: eight seeds, two standard errors.
for restart in 0 4 8 16 32; do
    for seed in 1 2 3 4 5 6 7 8; do
        method=bdpt
        [ $restart = 0 ] || method="asbdpt -P select=bins -P restart=$restart"
        # shellcheck disable=SC2086
        render --integrator $method --spp 512 --res 16x16 --seed $seed -o x.pfm
        "$lab" compare x.pfm truth.pfm | awk '$1 == "mean_ratio" { print 100 * ($2 - 1) }'
    done | awk -v n=$restart '
        { sum += $1; square += $1 * $1 }
        END {
            mean = sum / NR; error = 2 * sqrt((square / NR - mean * mean) / (NR - 1))
            printf "%s %.2f %.3f %.3f\n", n ? "restart_" n : "bdpt", mean, mean - error, mean + error
        }'
done >table.txt
chart bias "How far the mean of bins is from the truth" "per cent of the truth; whiskers: two standard errors; at 0 no bias is shown"

# p-values of two methods that agree, and of bins.
for seed in 1 2 3 4 5 6 7 8; do
    render --integrator bdpt --spp 4 --seed 10$seed -o bdpt-$seed.pfm
    render --integrator asbdpt -P select=pool --spp 4 --seed $seed -o pool-$seed.pfm
    render --integrator asbdpt -P select=bins --spp 4 --seed $seed -o bins-$seed.pfm
done
for method in bdpt bins; do
    "$lab" verify "$scene" --files $method-*.pfm --against pool-*.pfm --tile 8 --quiet >verdict.txt || :
    awk '/^  [01]\.[0-9]-/ { print $1, $2, $3 }' verdict.txt >table.txt
    chart p-$method "p-values of $method against pool, by tenths of [0,1]" \
        "number of p-values; grey: expected if the means are equal" 3 # the colours of a square vary together
done

# The alias table, step by step.
awk -v weights="5 1 3 2 1" -f "$tour/alias.awk" </dev/null >"$out/alias.svg"

# Drawings.
sh "$tour/../../scenes/unpack.sh" "$tour/drawings.txt" drawings
for drawing in drawings/*.draw; do
    awk -f "$tour/indices.awk" -f "$tour/draw.awk" "$drawing" >"$out/$(basename "$drawing" .draw).svg"
done

# What the methods draw from what.
awk -f "$tour/indices.awk" -f "$tour/family.awk" </dev/null >"$out/family.svg"

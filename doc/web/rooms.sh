#!/bin/sh
# rooms.sh PROGRAM: the reference of the tour's scene that the page shows, rooms.pfm beside this file, with how it was made
# in rooms.txt: pt and bdpt in 8 batches each, which must agree. Run from the top; a minute of CPU.
program=${1:-./asbdpt} scene=doc/mini/rooms.pbrt
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
for k in 1 2 3 4 5 6 7 8; do
    "$program" render $scene --integrator pt --spp 512 --res 32x32 --seed 100$k --quiet -o "$dir/pt-$k.pfm" &&
        "$program" render $scene --integrator bdpt --spp 256 --res 32x32 --seed 200$k --quiet -o "$dir/bdpt-$k.pfm" ||
        exit 1
done
"$program-lab" verify $scene --files "$dir"/pt-*.pfm --against "$dir"/bdpt-*.pfm --store doc/web/rooms \
    --note "$("$program" --version), doc/web/rooms.sh: pt, 8 times 512 samples per pixel, and bdpt, 8 times 256, 32x32 pixels"
rm -f doc/web/rooms.error.pfm

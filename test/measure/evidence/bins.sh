#!/bin/sh
# bins.sh DIR: bias of select=bins for several parameters, and how its error stalls, on the published Cornell box: into
# DIR/bins.txt, lines "NAME SAMPLES RMSE8 MEAN_RATIO". What is there is not rendered again.
touch "$1/bins.txt"
measure() { # NAME SAMPLES OPTIONS
    name=$1 spp=$2
    shift 2
    grep -q "^$name $spp " "$dir/bins.txt" && return
    ./asbdpt render "$PUBLISHED/cornell-box/scene.pbrt" --res 128x128 --maxdepth 6 --filter box --seed 11 --spp "$spp" -P rrthreshold=0 \
        --quiet "$@" -o "$dir/x.pfm"
    ./asbdpt-lab compare "$dir/x.pfm" "$REFERENCES/cornell-box.pfm" | awk -v name="$name" -v spp="$spp" '
        { v[$1] = $2 } END { print name, spp, v["rmse8"], v["mean_ratio"] }' >>"$dir/bins.txt"
}
dir=$1
bins="--integrator asbdpt -P select=bins"
for spp in 32 64 128 256 512; do
    measure bdpt $spp --integrator bdpt -P lightsamplestrategy=power
    measure bins $spp $bins
done
for parameter in restart=8 restart=16 restart=64 restart=0 binpaths=2 binpaths=4 binpaths=16 binpaths=32 \
    maxage=8 maxage=0; do
    measure $parameter 128 $bins -P $parameter
done

#!/bin/sh
# runners.sh DIR: which runner the race (integrators/race.h) chose in the renders whose errors are stored, from their
# scenes, sizes and seeds: lines "ENTRY SCENE SEED RUNNER" of DIR/runners.txt. Sets of scenes that are not there are left
# out. Needs build/test, and in the directory STORED what evidence.sh puts there.
set -e
out=$1
mkdir -p "$out/scenes"

# chosen ENTRY SCENE OPTIONS...: of each seed that STORED/ENTRY.csv has of the default in this scene.
chosen() {
    entry=$1 scene=$2 name=$3
    shift 3
    awk -F , -v name="$name" '$1 == name && $2 ~ /^(asbdpt|subspaces)$/ { print $4 }' "$STORED/$entry.csv" | sort -u |
        while read -r seed; do
            ./asbdpt-lab info --race "$scene" "$@" --filter box --seed "$seed" --quiet >"$out/info"
            awk -v row="$entry $name $seed" '/ chosen$/ { print row, $1 }' "$out/info"
        done
}
names() { awk -F , 'NR > 1 && !seen[$1]++ { print $1 }' "$STORED/$1.csv"; }

{
    for name in $(names gains); do chosen gains "scenes/$name.pbrt" "$name" --res 320; done
    [ ! -d "${PUBLISHED-}" ] || for name in $(names published); do
        chosen published "$PUBLISHED/$name/scene.pbrt" "$name" --res 320 --maxdepth 8
    done
    [ ! -d "${OTHERS-}" ] || for name in $(names others); do
        chosen others "$OTHERS/$name/scene.pbrt" "$name" --res 320
    done
    for name in $(names structures); do
        build/test --structure "${name%%-*}" >"$out/scenes/$name.pbrt"
        chosen structures "$out/scenes/$name.pbrt" "$name" --res 96x72
    done
} >"$out/runners.txt" 2>"$out/said"

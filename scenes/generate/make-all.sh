#!/bin/sh
# make-all.sh: write the meshes, textures and skies of the scenes again, in their directories beside this one.
set -e
cd "$(dirname "$0")/.."
tool=$(mktemp -d)
trap 'rm -rf "$tool"' EXIT
for scene in veach-ajar bathroom living-room sky many-lights forest test; do
    mkdir -p "$scene"
    ${CC:-cc} -std=c99 -O2 -ffp-contract=off -o "$tool/$scene" "generate/$scene.c" generate/model.c -lm
    "$tool/$scene"
done

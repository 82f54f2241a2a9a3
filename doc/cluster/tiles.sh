#!/bin/sh
# tiles.sh: the CPU seconds of every tile of a picture, one a line, in the order in which they are rendered.
#
#     sh tiles.sh SCENE [OPTION OF RENDER...] >tiles.txt         # ASBDPT=./asbdpt says which program
#     awk -f threads.awk tiles.txt
#
# The picture has 320x180 pixels, its tiles 16x16; every tile is a render of its own (--cropwindow).
set -eu
scene=$1
shift
tile=$(mktemp -d) && trap 'rm -rf "$tile"' EXIT
awk 'BEGIN { for (y = 0; y < 180; y += 16) for (x = 0; x < 320; x += 16)
    print x / 320, (x + 16) / 320, y / 180, (y + 16 > 180 ? 180 : y + 16) / 180 }' |
    while read -r left right top bottom; do
        # shellcheck disable=SC2086
        "${ASBDPT:-asbdpt}" render "$scene" --res 320x180 "$@" --cropwindow $left $right $top $bottom -j 1 \
            -o "$tile/x.pfm" 2>&1 </dev/null |
            sed -n 's/.*: \([0-9]*\)x\([0-9]*\), \([0-9]*\) spp.* \([0-9.]*\) us per.*/\1 \2 \3 \4/p'
    done | awk '{ print $1 * $2 * $3 * $4 * 1e-6 }'

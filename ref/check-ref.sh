#!/bin/sh
# check-ref.sh: are the stored references still what the program converges to? `make check-ref` calls it.
# Each is rendered again by the two methods it was made with (its text names them), with fewer samples and other seeds,
# and tested tile by tile.
#   sh ref/check-ref.sh [PROGRAM [SPP]]
program=${1:-./asbdpt} lab=${1:-./asbdpt}-lab
spp=${2:-256}
failures=0
said=$(mktemp) || exit 1
trap 'rm -f "$said"' EXIT
for name in $(sed -n 's/^== //p' ref/made.txt); do
    methods=$(awk -v name="$name" '/^== / { here = $2 == name } here' ref/made.txt |
        sed -n 's/^origin .*: \([a-z:=]*\) with seeds .* and \([a-z:=]*\) with seeds .*/\1 \2/p')
    [ -n "$methods" ] || { echo "FAILED  $name: ref/made.txt names no two methods"; failures=$((failures + 1)); }
    for method in $methods; do
        if "$lab" verify "scenes/$name.pbrt" --methods $method --reference "ref/$name.pfm" --filter box --spp "$spp" \
            --batches 16 --seed 777000 --quiet >"$said"; then
            echo "ok      $name by $method: $(grep 'ratio of' "$said")"
        else
            echo "FAILED  $name by $method"
            cat "$said"
            failures=$((failures + 1))
        fi
    done
done
[ $failures -eq 0 ]

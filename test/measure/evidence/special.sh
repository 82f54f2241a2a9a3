#!/bin/sh
# special.sh PART DIR: measurements of methods that are for some scenes only, into DIR.
#   caustics   bdpt, asbdpt and caustics with both after the same CPU time, in the scenes with caustics: DIR/NAME/
#   pathgraph  what it is off by, for cells of several sizes: lines "SCENE RADIUS ERROR" of DIR/pathgraph.txt, the
#              root of the mean square of the relative error over blocks of 8x8 pixels; of radius 0 it is that of pt
#   ellipse    pt and ellipse within gates: lines "WIDTH METHOD ERROR SECONDS" of DIR/ellipse.txt, squared errors, by
#              pairs
dir=$2
set -e
render() { ./asbdpt-lab render "$@" -j1 --quiet; }

caustics() {
    sh scenes/unpack.sh scenes/test/caustics.txt "$dir/scenes"
    while read -r name res spp; do
        ./asbdpt-lab equal-time "$dir/scenes/caustic-$name.pbrt" -o "$dir/$name" --spp "$spp" --seeds 5 --res "$res" \
            -j1 --quiet --methods bdpt,caustics,asbdpt,caustics:with=asbdpt >"$dir/$name.txt"
    done <<SCENES
ball 36x36 128
diver 36x24 64
lens 36x36 128
bulb 36x24 128
pool 36x24 64
SCENES
}

pathgraph() {
    while read -r scene res; do
        render "scenes/$scene.pbrt" --integrator bdpt --spp 1024 --seed 7 --res "$res" --filter box -o "$dir/$scene.pfm"
        for radius in 0 .01 .02 .05 .1 .2 .4; do
            [ "$radius" = 0 ] && set -- --integrator pt || set -- --integrator pathgraph -P "radius=$radius"
            render "scenes/$scene.pbrt" "$@" --spp 512 --res "$res" --filter box -o "$dir/x.pfm"
            echo "$scene $radius $(./asbdpt-lab compare "$dir/x.pfm" "$dir/$scene.pfm" |
                awk '$1 == "relmse8x8" { print sqrt($2) }')"
        done
    done >"$dir/pathgraph.txt" <<SCENES
cornell-box 48x48
veach-ajar 48x27
SCENES
}

ellipse() {
    for width in 100 1 0.1; do
        end=$(echo $width | awk '{ print 2400 + $1 }')
        for method in pt ellipse; do
            for seed in 1 2; do
                set -- scenes/cornell-box.pbrt --res 24x24 --spp 1024 --seed $seed --integrator $method --filter box
                [ $method = pt ] || set -- "$@" -P from=2400 -P "to=$end"
                render "$@" -o "$dir/x$seed.pfm" --stats "$dir/x.json"
                [ $method = pt ] || continue
                ./asbdpt-lab transient "$@" --gates 1 --gate "2400:$end" -o "$dir/x$seed" -j1 --quiet
                mv "$dir/x$seed/gate000.pfm" "$dir/x$seed.pfm"
            done
            echo "$width $method" \
                "$(./asbdpt-lab compare "$dir/x1.pfm" "$dir/x2.pfm" | awk '$1 == "rmse" { print $2 * $2 / 2 }')" \
                "$(sed -n 's/.*"cpu_seconds": \([0-9.]*\).*/\1/p' "$dir/x.json")"
        done
    done >"$dir/ellipse.txt"
}

"$1"
rm -rf "$dir"/x*

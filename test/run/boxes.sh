#!/bin/sh
# boxes.sh PROGRAM: do pictures that PROGRAM makes with the kd-tree have the bytes that they have with a tree of boxes
# (test/boxes/boxes.c)? Of each scene of hashes.txt the first picture is compared, and one of instances that share
# their object. Run from the top.
program=$1 boxes=${BUILD:-build}/boxes
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
[ "$boxes" -nt "$program" ] || make -s "$boxes" >/dev/null || exit
sh scenes/unpack.sh scenes/test "$dir/scenes/test" || exit # some lie in lists
awk '/^[0-9]/ && !seen[$2]++ { $1 = ""; print }' test/run/hashes.txt >"$dir/list"
# Below what is seen lie 2^18 triangles in one place: instances are copies until a scene has so many.
cat >"$dir/shared.pbrt" <<'END'
LookAt 0 2 -9  0 1 0  0 1 0
Camera "perspective" "float fov" 50
WorldBegin
ObjectBegin "filler"
Shape "loopsubdiv" "integer levels" 9 "integer indices" [ 0 1 2 ] "point P" [ 0 0 0 1 0 0 0 1 0 ]
ObjectEnd
AttributeBegin Translate 0 -90 0 Scale .01 .01 .01 ObjectInstance "filler" AttributeEnd
AttributeBegin AreaLightSource "diffuse" Translate 0 6 0 Rotate 90 1 0 0 Shape "disk" "float radius" 2 AttributeEnd
ObjectBegin "things"
Shape "sphere" "float radius" .5
Translate .8 0 0 Shape "loopsubdiv" "integer levels" 3 "integer indices" [ 0 1 2 0 2 3 0 3 1 3 2 1 ]
    "point P" [ 0 0 0 1 0 0 0 1 0 0 0 1 ]
ObjectEnd
ObjectInstance "things"
Translate -2 0 1 Rotate 40 0 1 1 ObjectInstance "things"
Translate 3 1 0 Scale 1 2 -1 ObjectInstance "things"
WorldEnd
END
echo "shared.pbrt --integrator bdpt" >>"$dir/list"
while read -r scene options; do
    [ -f "$dir/$scene" ] && file=$dir/$scene || file=$scene
    for by in "$program" "$boxes"; do
        # shellcheck disable=SC2086
        $by render "$file" --res 20x15 --spp 2 -j 2 --quiet --unclamped $options -o - </dev/null >"$dir/${by##*/}" ||
            exit
    done
    cmp -s "$dir/${program##*/}" "$dir/boxes" && echo same || echo "FAIL: $scene $options: the kd-tree meets something else"
done <"$dir/list" >"$dir/said"
! grep -v '^same$' "$dir/said" || exit 1
n=$(grep -c . "$dir/said")
[ "$n" -gt 30 ] || { echo "FAIL: only $n pictures were compared"; exit 1; }
echo "boxes: $n pictures are the same by a tree of boxes"

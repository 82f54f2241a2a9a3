#!/bin/sh
# conform.sh: the scenes of scenes/conform as files, for other renderers, too: sh scenes/generate/conform.sh DIR
#     DIR/pbrt-v3/NAME.pbrt    as they are
#     DIR/pbrt-v4/NAME.pbrt    what pbrt-v4 can say: no mirror, no latitude-longitude maps
#     DIR/mitsuba/NAME.xml     what Mitsuba 3 can say: no spot of this profile, one sky, no lights in groups;
#                              left out, too: meshes, textures, media
# Mitsuba takes a quadrilateral for the parallelogram that it is in all these scenes. pbrt's images are mirrored in a
# right-handed view of the world; so the camera is, too. Depth counts edges there, reflections here.
set -e
to=${1:?where the scenes go} from=$1/pbrt-v3
sh scenes/unpack.sh scenes/conform "$from"
mkdir -p "$to/pbrt-v4" "$to/mitsuba"
for name in $(sed '/^#/d; s/ .*//' ref/conform/list.txt); do
    grep -Eq '"mirror"|mapname' "$from/$name.pbrt" || sed -E \
        -e 's/^Film "image"/Film "rgb"/' -e 's/^Sampler "random"/Sampler "independent"/' \
        -e 's/"float (.)width" 2/"float \1radius" 2/g; s/"float alpha" 2/"float sigma" .5/' \
        -e 's/"point (P|from|to)"/"point3 \1"/g; s/"float uv"/"point2 uv"/; s/texture bumpmap/texture displacement/' \
        -e 's/"matte"/"diffuse"/; s/rgb Kd/rgb reflectance/' -e 's/"glass"/"dielectric"/; s/"metal"/"conductor"/' \
        -e 's/"string namedmaterial1" .*/"string materials" ["a" "b"] "float amount" .7/' \
        -e 's/ "string aamode" "none"//; s/^Material ""/Material "interface"/' \
        -e '/^WorldEnd/d' "$from/$name.pbrt" >"$to/pbrt-v4/$name.pbrt"
    grep -Eq '"spot"|mapname|bumpmap|alpha" "holes"|"normal N"|MakeNamedMedium' "$from/$name.pbrt" && continue
    [ $name = lamp-instance ] || awk -f scenes/generate/conform.awk "$from/$name.pbrt" >"$to/mitsuba/$name.xml"
done

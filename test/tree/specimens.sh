#!/bin/sh
# specimens.sh: is every kind of thing in use somewhere in the tests? Each row of the tables of kinds needs
#   unit       a specimen in a suite of its room
#   random     a place in the generator of random scenes (test/unit/random_*.c)
#   features   a scene that shows it (scenes/features; of media scenes/media)
# What is not looked for: lobes come into scenes by materials, which are rows of their own; files of a picture's format
# are read before a scene knows of them, and formats that are only written are in no scene. The list `without` at the
# end names single rows that have no place somewhere, and why. A row there that has one is an error.
# Run from the top. A companion renames one row of each table, which must be noticed.
work=$(mktemp -d) || exit
trap 'rm -rf "$work"' EXIT
unit=test/unit

# kinds DIR: all rows, in lines "KIND NAME WORD": NAME as scenes have it, WORD as the unit suites may have it, too.
kinds() {
    sed -n '/^enum lobe_kind/,/^}/s/^ *LOBE_\([A-Z_]*\).*/lobe LOBE_\1 LOBE_\1/p' "$1/material/lobe.h"
    sed -n 's/^const struct lobe_form form_\([a-z]*\) = .*/lobe form_\1 form_\1/p' "$1"/material/*.c
    sed -n '/ material_rows/,/NULL/p' "$1/material/material.c" | tr , '\n' |
        sed -n 's/.*&material_\([a-z]*\).*/material \1 \1/p'
    sed -n 's/^ *{"\([a-z]*\)",.*, \(LIGHT_[A-Z]*\),.*/light \1 \1/p' "$1/parser/parse_light.c"
    sed -n 's/.*{"\([a-z]*\)", [A-Z]*, \(TEXTURE_[A-Z]*\),.*/texture \1 \2/p' "$1/parser/parse_texture.c"
    sed -n 's/.*{"\([a-z]*\)", [A-Z]*, \(QUADRIC_[A-Z]*\),.*/shape \1 \2/p' "$1/parser/parse_shape.c"
    sed -n '/ shape_rows/,/NULL/p' "$1/geometry/mesh.c" | tr , '\n' | sed -n 's/.*&shape_\([a-z]*\).*/shape \1 \1/p'
    sed -n -e 's/.*{"\([a-z]*\)", [A-Z]*, FILTER_.*/filter \1 \1/p' \
        -e 's/.*{"\([a-z]*\)", [A-Z +0-9]*, \(CAMERA_[A-Z]*\),.*/camera \1 \2/p' "$1/parser/parse_options.c"
    sed -n 's/^ *{"\(\.[a-z.]*\)", .*_read, .*/format \1 \1/p' "$1/image/image.c"
    sed -n 's/.*strcmp(type, "\([a-z]*\)") != 0.*/medium \1 \1/p' "$1/parser/parse_medium.c"
    sed -n 's/.*{"\([A-Z][A-Za-z]*\)", [A-Z_]*, [a-z_]*, [A-Z_]*}.*/directive \1 \1/p' "$1"/parser/*.c
}

# files KIND PLACE: where a kind is looked for; nothing: nowhere.
files() {
    case $1.$2 in
    lobe.unit) echo $unit/test_bsdf.c $unit/test_lobe.c ;;
    lobe.* | format.random | format.features) ;;
    material.unit) echo $unit/test_material.c ;;
    light.unit) echo $unit/test_emission.c $unit/test_light_sent.c ;;
    texture.unit) echo $unit/test_texture.c ;;
    shape.unit) echo $unit/test_shape.c $unit/test_curve.c $unit/test_mesh.c ;;
    filter.unit) echo $unit/test_film.c ;;
    camera.unit) echo $unit/test_camera.c ;;
    format.unit) echo $unit/test_file.c $unit/test_image.c $unit/test_hdr.c ;;
    medium.unit) echo $unit/test_medium.c ;;
    directive.unit) echo $unit/test_parser.c $unit/parser_*.c test/data/fixtures/scenes.txt ;; # suite `parser`
    *.random) echo $unit/random_parts.c $unit/random_scene.c ;;
    medium.features) echo scenes/media/*.pbrt ;;
    *.features) echo scenes/features/*.txt ;;
    esac
}

# plain FILE...: their text without comments of C, or of scenes.
plain() {
    for file in "$@"; do
        case $file in
        *.c) sed -e 's,/\*.*\*/,,g' -e '/^ *\/\*/d' -e '/^ \*/d' "$file" ;;
        *) sed 's/#.*//' "$file" ;;
        esac
    done
}

# missing: of the rows of standard input, those that are not in a place, in lines "KIND NAME PLACE".
missing() {
    while read -r kind name word; do
        for place in unit random features; do
            text=$work/$kind.$place
            # shellcheck disable=SC2046 # file names without blanks
            [ -f "$text" ] || plain $(files "$kind" $place) >"$text"
            [ -s "$text" ] || continue
            [ $place = unit ] || word=$name
            case $kind in
            lobe | directive) found="(^|[^A-Za-z_]|\\\\n)$word([^A-Za-z_]|\$)" ;;
            format) found="\\$name\"" ;;
            *) found="\"$name(\\\\)?\"|(^|[^A-Z_])$word([^A-Z_a-z\"\\\\]|\$)" ;;
            esac
            grep -Eq "$found" "$text" || echo "$kind $name $place"
        done
    done
}

# judge: the lines of `missing` against those of $without. Status 0: they are the same.
judge() {
    sort >"$work/missing"
    echo "$without" | sed 's/:.*//' | sort >"$work/without"
    comm -23 "$work/missing" "$work/without" | sed 's/\(.*\) \(.*\) \(.*\)/\1 \2: nothing for it in \3/'
    comm -13 "$work/missing" "$work/without" | sed 's/$/: said to be missing, but found/'
    cmp -s "$work/missing" "$work/without"
}

without='directive ActiveTransform features: nothing moves here: a warning, which test/data/fixtures/scenes.txt shows
directive ActiveTransform random: the same
directive Include random: a random scene is one file
directive TransformTimes features: as ActiveTransform
directive TransformTimes random: the same
light exinfinite features: another name of infinite
light exinfinite random: the same
light exinfinite unit: the same'

kinds src >"$work/kinds"
missing <"$work/kinds" | judge
status=$?
[ "$(cut -d ' ' -f 1 "$work/kinds" | sort -u | wc -l)" -eq 10 ] || { echo "specimens: a table is not found"; status=1; }
[ $status -eq 0 ] && echo "specimens: $(wc -l <"$work/kinds" | tr -d ' ') kinds of things, all in use"

# The companion: of each table one row has a name that nobody uses.
mkdir "$work/src"
for folder in material parser geometry image; do
    mkdir "$work/src/$folder"
    for file in src/$folder/*.[ch]; do
        sed -e 's/LOBE_OREN_NAYAR,/LOBE_PLANTED,/' -e 's/form_coat = {/form_planted = {/' \
            -e 's/&material_disney,/\&material_planted,/' \
            -e 's/{"spot", SPOT/{"planted", SPOT/' \
            -e 's/{"bilerp", BILERP, TEXTURE_BILERP/{"planted", P, TEXTURE_PLANTED/' \
            -e 's/&shape_curve,/\&shape_planted,/' -e 's/{"sinc", SINC/{"planted", SINC/' \
            -e 's/{"\.png", png/{".planted", png/' \
            -e 's/{"environment", ENVIRONMENT, CAMERA_ENVIRONMENT/{"planted", P, CAMERA_PLANTED/' \
            -e 's/"homogeneous") != 0/"unplanted") != 0/' -e 's/{"Rotate", ANY/{"Planted", ANY/' "$file" \
            >"$work/src/$folder/${file##*/}"
    done
done
n=$(kinds "$work/src" | missing | grep -ic planted)
[ "$n" -eq 27 ] || { echo "specimens: of rows without specimens $n are noticed, not 27"; status=1; }
exit $status

#!/bin/sh
# kit.sh: the scenes of the kit by some renderer, from the top of the tree:
#   sh test/measure/conform/kit.sh RENDERER OUT METHOD [PICTURES [SPP [SCENE...]]]
# renders, of each scene that the renderer's format can say (scenes/generate/conform.sh), OUT/SCENE-1.pfm ...
# OUT/SCENE-PICTURES.pfm (8) with SPP (64) samples per pixel, and judges them. If the program is not there it says so.
#   ours      METHOD is an integrator, with parameters as in asbdpt:select=bins; PROGRAM is the program; SEED is added
#             to the numbers of the pictures
#   pbrt-v3   path, volpath, bdpt ...; PBRT. It has no seed: unless a build reads PBRT_SEED, all pictures are one, and
#             the kit says so
#   pbrt-v4   volpath, bdpt ...; PBRT4
#   mitsuba3  path ...; MITSUBA, of the variant scalar_rgb
#   cycles    four of the scenes, made anew by cycles.py: cycles; BLENDER
renderer=${1:?the name of a renderer} out=${2:?where the pictures go} method=${3:?the name of a method}
pictures=${4:-8} spp=${5:-64}
[ $# -gt 5 ] && shift 5 || set -- $(sed '/^#/d; s/ .*//' ref/conform/list.txt)
lab=${LAB:-./asbdpt-lab}
case $renderer in
ours) program=${PROGRAM:-./asbdpt-lab} ;;
pbrt-v3) program=${PBRT:-pbrt} ;;
pbrt-v4) program=${PBRT4:-pbrt-v4} ;;
mitsuba3) program=${MITSUBA:-mitsuba} ;;
cycles) program=${BLENDER:-blender} ;;
*) echo "kit: there is no renderer $renderer" >&2; exit 2 ;;
esac
command -v "$program" >/dev/null || { echo "skipped: $renderer: no program $program"; exit 0; }
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
sh scenes/generate/conform.sh "$work" || exit

# by: a scene of pbrt by the chosen integrator.
by() {
    sed -e "s/^Integrator \"bdpt\"/Integrator \"$method\"/" -e "s/pixelsamples\" .*/pixelsamples\" $spp/" "$1" >"$2"
}
# picture SCENE NUMBER FILE.pfm: one picture with a seed of its own; a scene that cannot be said makes none.
picture() {
    case $renderer in
    ours)
        parameters=${method#"${method%%:*}"}
        "$program" render "$work/pbrt-v3/$1.pbrt" --integrator "${method%%:*}" ${parameters:+-P "${parameters#:}"} \
            --spp "$spp" --seed $((${SEED:-0} + $2)) -j 1 --quiet --unclamped -o "$3"
        ;;
    pbrt-v3)
        by "$work/pbrt-v3/$1.pbrt" "$work/pbrt-v3/run.pbrt"
        (cd "$work/pbrt-v3" && PBRT_SEED=$2 "$program" --quiet --nthreads=1 --outfile="$3" run.pbrt)
        ;;
    pbrt-v4)
        by "$work/pbrt-v4/$1.pbrt" "$work/run.pbrt" &&
            "$program" --quiet --nthreads 1 --seed "$2" --spp "$spp" --outfile "$3" "$work/run.pbrt"
        ;;
    mitsuba3)
        [ -f "$work/mitsuba/$1.xml" ] && "$program" -m scalar_rgb -t 1 -D "integrator=$method" -D "spp=$spp" \
            -D "seed=$2" -o "$3" "$work/mitsuba/$1.xml"
        ;;
    cycles)
        case $1 in area | sky | distant | mirror) ;; *) return 1 ;; esac
        "$program" -b --factory-startup -t 1 -P test/measure/conform/cycles.py -- "$1" "$spp" "$2" "${3%.pfm}.exr"
        ;;
    esac
}

mkdir -p "$out"
out=$(cd "$out" && pwd)
for name; do
    none=
    for k in $(seq "$pictures"); do
        [ -n "$none" ] || [ -f "$out/$name-$k.pfm" ] ||
            picture "$name" "$k" "$out/$name-$k.pfm" </dev/null >>"$work/said" 2>&1 || none=yes
        echo "$name"
    done
done | "$lab" progress --parts $(($# * pictures))
"$lab" conform "$out"

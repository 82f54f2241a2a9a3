#!/bin/sh
# make-conform.sh: render the references of scenes/conform again.  sh ref/make-conform.sh [PROGRAM [WORK [SCENE...]]]
#
# Every scene is rendered by two methods, bdpt and pt, or lt where no path from the camera finds the light, each in 16
# batches of 512 samples per pixel with seeds of their own. `asbdpt-lab verify` tests that they agree. Then are stored,
# with one channel:
#     ref/conform/references.pfm   of each scene a row (test/lab/conform.h): the mean of both, or the closed form of
#                                  every pixel that the scene has; its standard errors; and, by bdpt alone, 16 batches
#                                  of 128, what a renderer with each mistake that shows another picture would make of it
#     ref/conform/made.txt         for every scene its mean, the relative error of that, and p of the agreement
# Renders are kept in WORK: a run that was interrupted goes on where it stopped. One thread takes 20 minutes.
set -e
program=${1:-./asbdpt} lab=${1:-./asbdpt}-lab work=${2:-build/conform} out=ref/conform
[ $# -gt 2 ] && shift 2 || set -- $(sed '/^#/d; s/ .*//' "$out/list.txt")
sh scenes/unpack.sh scenes/conform "$work/scenes"

# grey FILE.pfm OUT.pfm: its first channel alone.
grey() {
    { printf 'Pf\n32 32\n-1\n'; printf "$(od -An -v -to1 -j "$(head -3 "$1" | wc -c)" "$1" |
        awk '{ for (i = 1; i <= NF; i++) if (n++ % 12 < 4) printf "\\%s", $i }')"; } >"$2"
}
# render OUT FIRST_SEED METHOD SPP FILE OPTIONS...: the batches that are still missing.
render() {
    to=$1 seed=$2 method=$3 spp=$4 from=$5
    shift 5
    for i in 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
        [ -f "$to-$i.pfm" ] && continue
        "$program" render "$from" --integrator "$method" "$@" --spp "$spp" --seed $((seed + i)) -j 1 --quiet --unclamped -o "$work/part.pfm" \
            2>>"$work/messages"
        mv "$work/part.pfm" "$to-$i.pfm"
    done
}
# variant MISTAKE FILE OPTIONS...: what bdpt makes of it with these, the next of `pictures`.
variant() {
    of=$1 changed=$2
    shift 2
    pictures="$pictures $work/$name.$of.grey"
    render "$work/$name.$of" 3000 bdpt 128 "$changed" "$@"
    "$lab" verify "$file" --files "$work/$name.$of"-?.pfm --against "$work/$name.$of"-1?.pfm --store "$work/$name.$of" \
        >/dev/null
    grey "$work/$name.$of.pfm" "$work/$name.$of.grey"
}
# turned DEGREES: the scene's file with all its skies turned, beside their map.
turned() {
    sed "s/^LightSource \"infinite\".*/AttributeBegin $1 & AttributeEnd/" "$file" >"$work/scenes/$name.turned.pbrt"
}
# dark: the scene's file with nothing that reflects.
dark() {
    sed 's/"rgb Kd" \[[^]]*\]/"rgb Kd" [0 0 0]/; s/"rgb sigma_s" \[[^]]*\]/"rgb sigma_s" [0 0 0]/' "$file" >"$work/scenes/$name.dark.pbrt"
}
# constant VALUE FILE.pfm: a picture of it.
constant() {
    echo "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 32 PixelFilter \"box\"
        Camera \"perspective\" WorldBegin LightSource \"infinite\" \"rgb L\" [$1 $1 $1] WorldEnd" >"$work/constant.pbrt"
    "$program" render "$work/constant.pbrt" --integrator pt --spp 1 --quiet -o "$work/constant.pfm"
    grey "$work/constant.pfm" "$2"
}

# one NAME: the references of a scene.
one() {
    name=$1 file=$work/scenes/$1.pbrt
    depth=$(sed -n 's/^Integrator .*maxdepth" //p' "$file")
    case $name in mirror-sun | glass-sun | caustic) other=lt ;; *) other=pt ;; esac
    render "$work/$name-bdpt" 1000 bdpt 512 "$file"
    render "$work/$name-other" 2000 $other 512 "$file"
    "$lab" verify "$file" --files "$work/$name-bdpt"-*.pfm --against "$work/$name-other"-*.pfm --store "$work/$name" \
        >"$work/$name.said" || { cat "$work/$name.said" >&2; exit 1; }
    grey "$work/$name.pfm" "$work/$name.grey"
    grey "$work/$name.error.pfm" "$work/$name.error.grey"
    pictures="$work/$name.grey $work/$name.error.grey"
    closed=$(sed -n 's/^# closed form: //p' "$file")
    [ -z "$closed" ] || constant "$closed" "$work/$name.grey" # of which the kit knows that it has no error
    if [ "$depth" = 1 ]; then # at depth 0, what shines alone is seen
        dark
        variant less "$work/scenes/$name.dark.pbrt"
    else
        variant less "$file" --maxdepth $((depth - 1))
    fi
    variant more "$file" --maxdepth $((depth + 1))
    case $name in
    filter) variant box "$file" --filter box ;;
    *) variant gaussian "$file" --filter gaussian ;;
    esac
    case $name in sky-map | two-skies)
        for angle in 90 180 270; do
            turned "Rotate $angle 0 0 1"
            variant turned$angle "$work/scenes/$name.turned.pbrt"
        done
        turned "Scale -1 1 1"
        variant mirrored "$work/scenes/$name.turned.pbrt"
    esac
    printf "$(for picture in $pictures; do tail -c 4096 "$picture" | od -An -v -to1; done | awk '
        { for (i = 1; i <= NF; i++) byte[n++] = $i }
        END {
            split("000 000 200 277", none, " ") # -1: there is no such picture
            for (y = 0; y < 32; y++) for (k = 0; k < 9; k++) for (x = 0; x < 128; x++) {
                i = 4096 * k + 128 * y + x
                printf "\\%s", (i < n ? byte[i] : none[1 + x % 4])
            }
        }')" >"$work/$name.row"
    awk -v name="$name" '$1 == "mean" { mean = $2 } $1 == "mean_error" { error = $2 } $1 == "agreement" { p = $3 + 0 }
        END { printf "%-14s mean %.6g  relative error %.2g  p of the agreement %.2g\n", name, mean, error, p }' "$work/$name.txt" \
        >"$work/$name.made"
}
rm -f "$work/all"
{
    for scene; do one "$scene"; echo "$scene"; done
    : >"$work/all" # none had an error
} | "$lab" progress --parts $#
[ -f "$work/all" ]
cat "$work"/*.made >"$out/made.txt"
# The rows that are new, the others as they are; the lowest first, as in PFM.
{
    set -- $(sed '/^#/d; s/ .*//' "$out/list.txt" | awk '{ name[NR] = $0 } END { for (i = NR; i > 0; i--) print name[i] }')
    printf 'Pf\n288 %d\n-1\n' $((32 * $#))
    at=16
    for scene; do
        [ -f "$work/$scene.row" ] || tail -c +$at "$out/references.pfm" | head -c 36864 >"$work/$scene.row"
        cat "$work/$scene.row"
        at=$((at + 36864))
    done
} >"$work/references.pfm"
mv "$work/references.pfm" "$out/references.pfm"

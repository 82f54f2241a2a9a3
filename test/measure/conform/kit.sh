# kit.sh: what the drivers of this directory share; they read it from the top of the tree, with their arguments:
#   sh test/measure/conform/PROGRAM.sh OUT METHOD [PICTURES [SPP [SCENE...]]]
# renders, of each scene that the program's format can say, OUT/SCENE-1.pfm ... OUT/SCENE-PICTURES.pfm (8) with SPP (64)
# samples per pixel, and judges them. A driver defines
#   picture SCENE NUMBER FILE.pfm   one picture with a seed of its own; a scene that cannot be said makes none
# and finds the scenes in $work, as conform.sh makes them.
out=${1:?where the pictures go} method=${2:?the name of a method} pictures=${3:-8} spp=${4:-64}
[ $# -gt 4 ] && shift 4 || set -- $(sed '/^#/d; s/ .*//' ref/conform/list.txt)
names=$* lab=${LAB:-./asbdpt-lab}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
sh scenes/generate/conform.sh "$work" || exit
# need PROGRAM: ends here, with a line, if there is none.
need() { command -v "$1" >/dev/null || { echo "skipped: $(basename "$0" .sh): no program $1"; exit 0; }; }
kit() {
    mkdir -p "$out"
    out=$(cd "$out" && pwd)
    # shellcheck disable=SC2086
    set -- $names
    for name; do
        none=
        for k in $(seq "$pictures"); do
            [ -n "$none" ] || [ -f "$out/$name-$k.pfm" ] ||
                picture "$name" "$k" "$out/$name-$k.pfm" </dev/null >>"$work/said" 2>&1 || none=yes
            echo "$name"
        done
    done | "$lab" progress --parts $(($# * pictures))
    "$lab" conform "$out"
}

#!/bin/sh
# tune.sh: how good is asbdpt with another constant, or without one of its parts?
#   sh test/lab/tune.sh [DIR [NAME...]]      NAME: an entry of tune.txt; default: all; DIR: default build-tune
# Every variant is built and renders the training scenes for the CPU time that bdpt takes for SPP samples, by SEEDS
# seeds; its squared error, relative to bdpt's, stands in DIR/table.txt: geometric mean and worst of the scenes. What is
# there already is not made again. The scenes and seeds on which a claim is made are others (doc/selection.md).
list=test/lab/tune.txt
dir=${1:-build-tune}
[ $# -gt 0 ] && shift
only=" $* "
train="cornell-box bathroom living-room caustic-glass many-lights sky forest spot features/light-point \
    features/light-infinite"
scenes=${SCENES:-$(printf 'scenes/%s.pbrt ' $train)}
SPP=${SPP:-64} SEEDS=${SEEDS:-3} RES=${RES:-96x64}

names() {
    echo as-it-is
    awk -v only="$only" '/^[^-+# \t]/ && NF > 3 && (only == "  " || index(only, " " $1 " ")) { print $1 }' $list
}

# measure NAME: build the variant and let its laboratory measure it.
measure() {
    tree=$dir/tree
    cp -Rp src test "$tree/"
    [ "$1" = as-it-is ] || sh test/mutants/apply.sh $list "$1" "$tree" || return 1
    make -s -C "$tree" asbdpt-lab >"$dir/log.txt" 2>&1 || return 1
    "$tree/asbdpt-lab" equal-time $scenes --methods bdpt,asbdpt --spp "$SPP" --seeds "$SEEDS" --res "$RES" \
        --reference-spp 2048 --quiet -o "$dir/$1" >"$dir/log.txt" 2>&1
}

# row NAME: its line of the table.
row() {
    about=$(awk -v name="$1" '$1 == name { for (i = 4; i <= NF; i++) printf "%s ", $i }' $list)
    awk -F '|' -v name="$1" -v about="$about" '
        /geometric mean/ { mean = $5 }
        /WORST/ { worst = $5 }
        END {
            gsub(/\*\*/, "", mean)
            gsub(/\*\*/, "", worst)
            printf "| %s |%s|%s| %s|\n", name, mean, worst, about
        }' \
        "$dir/$1/equal-time.md"
}

mkdir -p "$dir/tree"
cp -R Makefile scenes "$dir/tree/"
for name in $(names); do
    [ -f "$dir/$name/equal-time.md" ] || measure "$name" || { echo "$name: see $dir/log.txt"; exit 1; }
done
{
    echo "| variant | squared error, rmse8, of bdpt's at equal time | worst | |"
    echo "|---|---:|---:|---|"
    for name in $(names); do
        row "$name"
    done
} | tee "$dir/table.txt"

#!/bin/sh
# tune.sh: how good is asbdpt with another constant, or without one of its parts?
#   sh test/lab/tune.sh [DIR [NAME...]]      NAME: an entry of tune.txt, bdpt or pt; default: all entries;
#                                            DIR: default build-tune
# Every variant renders the training scenes with SPP samples by SEEDS. Beside each other stand its squared error and its
# CPU time, both relative to the tree as it is, seed by seed; of a scene the time is the least of its seeds'. What DIR
# holds already is not made again: references (of which several DIRs may share one, TRUTH) and programs stay, and
# renders are lines of DIR/runs.txt. The table goes to DIR/tune.md. The scenes and seeds on which a claim is made are
# others (doc/results.md).
list=test/lab/tune.txt
dir=${1:-build-tune}
[ $# -gt 0 ] && shift
names="as-it-is ${*:-$(awk '/^[^-+# \t]/ && NF > 3 { print $1 }' $list)}"
SCENES=${SCENES:-cornell-box bathroom living-room caustic-glass many-lights sky forest spot features/light-point \
    features/light-infinite}
SEEDS=${SEEDS:-61 62 63} SPP=${SPP:-64} RES=${RES:-72x48} REFERENCE_SPP=${REFERENCE_SPP:-1024}
TRUTH=${TRUTH:-$dir/reference}

# build NAME: its program is DIR/programs/NAME. The tree is then as it was, and make sees by its dates what was another.
build() {
    file=$(awk -v name="$1" '$1 == name && NF > 3 { print $2 }' $list) program=asbdpt
    [ "$1" != asbdpt-lab ] || program=asbdpt-lab
    [ -z "$file" ] || sh test/data/mutants/apply.sh $list "$1" "$dir/tree" || return
    make -s -C "$dir/tree" LTO= $program >"$dir/log.txt" 2>&1 &&
        mv "$dir/tree/$program" "$dir/programs/$1"
    built=$?
    [ -z "$file" ] || cp "$file" "$dir/tree/$file"
    return $built
}

# render NAME SCENE SEED SPP FILE: the CPU time goes to FILE.json.
render() {
    integrator=asbdpt
    case $1 in bdpt | pt) integrator=$1 ;; esac
    from=$dir/scenes/$2.pbrt # that lies in a list
    [ -f "$from" ] || from=scenes/$2.pbrt
    "$dir/programs/$1" render "$from" --integrator $integrator --res "$RES" --spp "$4" --seed "$3" -j1 \
        -o "$5" --stats "$5.json" >"$dir/log.txt" 2>&1
}

# measure NAME SCENE SEED: a line "NAME SCENE SEED rmse8 relmse blocks seconds" of runs.txt.
measure() {
    reference=$TRUTH/$(echo "$2" | tr / -).pfm picture=$dir/$1-$3.pfm
    grep -q "^$1 $2 $3 " "$dir/runs.txt" && return
    [ -f "$reference" ] || {
        render as-it-is "$2" 1 "$REFERENCE_SPP" "$picture" && mv "$picture" "$reference" # only if it is complete
    } || return
    render "$1" "$2" "$3" "$SPP" "$picture" || return
    errors=$("$dir/programs/asbdpt-lab" compare "$picture" "$reference") || return
    seconds=$(sed -n 's/.*"cpu_seconds": \([0-9.e-]*\).*/\1/p' "$picture.json")
    errors=$(echo "$errors" | awk '/^(rmse8|relmse|relmse8x8) / { printf "%s ", $2 }')
    echo "$1 $2 $3 $errors$seconds" >>"$dir/runs.txt"
    rm "$picture" "$picture.json"
}

mkdir -p "$dir/tree" "$dir/programs" "$TRUTH"
sh scenes/unpack.sh scenes/features "$dir/scenes/features" || exit 1
touch "$dir/runs.txt"
cp -R Makefile src test "$dir/tree/"
for name in asbdpt-lab $names; do
    [ -x "$dir/programs/$name" ] || build "$name" || { echo "$name: see $dir/log.txt"; exit 1; }
done
for seed in $SEEDS; do
    for scene in $SCENES; do
        for name in $names; do
            measure "$name" "$scene" "$seed" || { echo "$name, $scene, $seed: see $dir/log.txt"; exit 1; }
        done
    done
done
awk -v names="$names" -f test/lab/tune.awk $list "$dir/runs.txt" | tee "$dir/tune.md"

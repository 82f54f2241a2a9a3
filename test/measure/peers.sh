#!/bin/sh
# peers.sh: bdpt of this program beside that of others, on the same scenes.
#   PEERS=DIR sh test/measure/peers.sh build         fetches and builds, in DIR, what is not there
#   PEERS=DIR PUBLISHED=DIR sh test/measure/peers.sh measure OUT
#       CPU time of a sample path, gain of two threads, memory, into OUT/peers.txt; what is there is not measured again
#   sh test/measure/peers.sh table <OUT/peers.txt    as a table
#   PUBLISHED=DIR sh test/measure/peers.sh rays OUT  rays beside those of Embree 3 (Debian: libembree-dev), into OUT
#   sh test/measure/peers.sh rays_table <OUT/rays.txt
# DIR/pbrt-v3 and DIR/SmallVCM are their repositories; a program DIR/pbrt or DIR/smallvcm is taken as it is. PUBLISHED
# has the published scenes in pbrt-v3's format; the room of SmallVCM is scenes/test/smallvcm-1.pbrt.
# A sample path costs what more samples cost, so that reading and building are not in it: the least of five runs, of
# all programs in turn.
set -u
. test/measure/pbrt.sh
smallvcm=$PEERS/smallvcm
[ -x "$smallvcm" ] || smallvcm=$PEERS/SmallVCM/smallvcm

# fetch NAME OWNER: its repository, if it is not there.
fetch() { [ -d "$PEERS/$1" ] || git clone -q --recursive "https://github.com/$2/$1" "$PEERS/$1"; }
build() {
    mkdir -p "$PEERS"
    [ -x "$pbrt" ] || {
        fetch pbrt-v3 mmp && cmake -S "$PEERS/pbrt-v3" -B "$PEERS/pbrt-v3/build" -DCMAKE_BUILD_TYPE=Release &&
            cmake --build "$PEERS/pbrt-v3/build" --target pbrt_exe -j 2
    }
    [ -x "$smallvcm" ] || { fetch SmallVCM SmallVCM && make -C "$PEERS/SmallVCM"; }
}

# cpu COMMAND...: seconds of CPU of a command and its threads.
cpu() {
    ("$@" >"$dir/said" 2>&1 </dev/null || { echo "fails: $*" >&2; cat "$dir/said" >&2; }
    times) | awk 'NR == 2 { for (i = 1; i <= 2; i++) { split($i, t, "m"); s += 60 * t[1] + t[2] } print s }'
}
# peak COMMAND...: MiB, where the system can tell.
peak() {
    if [ -x /usr/bin/time ] && /usr/bin/time -f %M -o "$dir/peak" "$@" >/dev/null 2>&1 </dev/null; then
        awk '{ printf "%.0f\n", $1 / 1024 }' "$dir/peak"
    else
        echo -
    fi
}
# The commands: theirs and ours, with SAMPLES and THREADS. job has SCENE, its size and depth, and where it lies.
pbrt_run() {
    pbrt_scene bdpt "$1"
    (cd "$dir/$scene" && "$3" "$pbrt" --quiet --nthreads="$2" run.pbrt)
}
small_run() { (cd "$dir" && OMP_NUM_THREADS=$2 "$3" "$smallvcm" -s 1 -a bpt -i "$1" -o x.bmp); }
ours_run() {
    "$3" ./asbdpt render "$file" --integrator bdpt --filter box --spp "$1" --maxdepth "$depth" \
        --res "${width}x$height" -j "$2" --quiet -o "$dir/x.pfm"
}
# costs RUN FEW MORE: of theirs and of ours: microseconds of CPU for a path with one thread, with two; MiB.
costs() {
    for threads in 1 1 1 1 1 2 2 2 2 2; do
        for run in "$1" ours_run; do
            echo "$run $threads $($run "$2" $threads cpu) $($run "$3" $threads cpu)"
        done
    done >"$dir/costs"
    for run in "$1" ours_run; do
        awk -v run="$run" -v paths=$((width * height * ($3 - $2))) '
            $1 == run && (!($2 in few) || $3 < few[$2]) { few[$2] = $3 }
            $1 == run && (!($2 in more) || $4 < more[$2]) { more[$2] = $4 }
            function cost(n) { return 1e6 * (more[n] - few[n]) / paths }
            END { printf "%.3g %.3g ", cost(1), cost(2) }' "$dir/costs"
        $run "$2" 1 peak
    done
}
# compare PEER RUN FEW MORE: a line of peers.txt.
compare() {
    grep -q "^$1 $scene " "$out" && return
    echo "$1 $scene ${width}x$height $depth "$(costs "$2" "$3" "$4") >>"$out"
}
measure() {
    out=$1/peers.txt
    mkdir -p "$1"
    touch "$out"
    while read -r scene width height depth _; do
        file=$PUBLISHED/$scene/scene.pbrt
        [ -x "$pbrt" ] && [ -f "$file" ] || { echo "pbrt-v3, $scene: not there" >&2; continue; }
        compare pbrt-v3 pbrt_run 1 9
    done <<SCENES
$(published_scenes)
SCENES
    scene=smallvcm-1 width=512 height=512 depth=9 file=scenes/test/smallvcm-1.pbrt
    if [ -x "$smallvcm" ]; then compare SmallVCM small_run 1 3; else echo "SmallVCM: not there" >&2; fi
}
table() {
    echo '| scene | peer | its us | ours, us | ours / its | gain of two threads: its | ours | its MiB | ours |'
    echo '|---|---|---:|---:|---:|---:|---:|---:|---:|'
    awk '{ printf "| %s, %s, depth %s | %s | %s | %s | %.2f | %.2f | %.2f | %s | %s |\n", $2, $3, $4, $1, $5, $8,
        $8 / $5, 2 * $5 / $6, 2 * $8 / $9, $7, $10 }'
}

# rays OUT: see test/measure/peers/embree.c.
rays() {
    mkdir -p "$1"
    : >"$1/rays.txt"
    echo '#include <embree3/rtcore.h>' | ${CC-cc} -E - >/dev/null 2>&1 || { echo "Embree 3: not there" >&2; return; }
    make -s build/embree >&2 || return
    for scene in cornell-box veach-ajar living-room bathroom; do
        build/embree "$PUBLISHED/$scene/scene.pbrt" | sed "s|^.*/scene.pbrt|$scene|" >>"$1/rays.txt"
    done
}
rays_table() {
    echo '| scene | triangles | first hit: ours, Embree, Mray/s | ratio | any hit | ratio | between two places | ratio |'
    echo '|---|---:|---:|---:|---:|---:|---:|---:|'
    awk '{ printf "| %s | %s | %s, %s | %s | %s, %s | %s | %s, %s | %s |\n", $1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11 }'
}

case ${1-} in
build) build ;;
measure) measure "$2" ;;
rays) rays "$2" ;;
table | rays_table) "$1" ;;
*) sed -n '2,8s/^# *//p' "$0"; exit 2 ;;
esac

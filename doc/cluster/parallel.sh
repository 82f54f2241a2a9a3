#!/bin/sh
# parallel.sh: one picture by GNU parallel, on this machine or over ssh.
#
#     sh parallel.sh SCENE SPP PARTS DIR OUT [OPTION OF PARALLEL...]
#     sh parallel.sh room.pbrt 4096 64 room.parts room.exr -S 4/left,8/right --workdir .
#
# Other machines need the program and the scene under the same path, and DIR on a file system that they share. A part
# that fails is tried three times, and goes on from its checkpoint.
set -eu
scene=$1 spp=$2 parts=$3 dir=$4 out=$5
shift 5
asbdpt=${ASBDPT:-asbdpt}
mkdir -p "$dir"
for i in $(seq 0 $((parts - 1))); do
    echo "$i $((spp * i / parts)):$((spp * (i + 1) / parts))"
done | parallel --colsep ' ' --retries 3 --halt soon,fail=1 "$@" \
    "'$asbdpt' render '$scene' --spp $spp --samples {2} -j 1 -o '$dir/{1}.part'" \
    "--checkpoint '$dir/{1}.state' --resume '$dir/{1}.state' --quiet"
"$asbdpt" merge "$dir"/*.part -o "$out"

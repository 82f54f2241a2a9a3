#!/bin/sh
# experiments.sh OUT: chapter 4 and appendix A of the dissertation, measured again, into OUT/report.html; `make
# experiments` calls it. On the five scenes of this tree: 96 pixels wide, 8 to 128 samples per pixel, 3 seeds (one for
# the sweeps), references of 1024 samples. SPP= and RES= change that.
#   PUBLISHED=DIR   on the published scenes instead, DIR/NAME/scene.pbrt; those that are not there are left out
#   REFERENCES=DIR  against DIR/NAME.pfm, at their sizes (ref/make-ref.sh makes such); else rendered here
lab=./asbdpt-lab
names="veach-ajar cornell-box cornell-box-modified bathroom living-room"

spp=${SPP-128}
set -- "$1" --res "${RES-96}" --reference-spp 1024
scenes=
for name in $names; do
    file=scenes/$name.pbrt
    [ -z "${PUBLISHED-}" ] || file=$PUBLISHED/$name/scene.pbrt
    if [ ! -f "$file" ]; then echo "experiments: there is no $file, left out"; else scenes="$scenes $file"; fi
done
[ -n "$scenes" ] || { echo "experiments: no scenes, nothing measured"; exit 0; }
[ -z "${PUBLISHED-}" ] || set -- "$1" --maxdepth 8 --res "${RES-96}" --reference-spp 1024
[ -z "${REFERENCES-}" ] || set -- "$1" --reference "$REFERENCES"
out=$1
shift
ASBDPT_COMMIT=$(git rev-parse --short HEAD 2>/dev/null)
export ASBDPT_COMMIT
bins=asbdpt:select=bins
# shellcheck disable=SC2086 # paths of scenes hold no blanks
exec $lab experiment $scenes --spp "$spp" --seeds 3 --methods bdpt,$bins,asbdpt "$@" -o "$out" \
    --sweep $bins:binpaths=4/16/32 --sweep $bins:restart=0/8/16

#!/bin/sh
# pbrt-v3.sh: the kit's scenes by pbrt-v3 (kit.sh): METHOD is path, volpath, bdpt ... PBRT is the program. pbrt-v3 has
# no seed: unless a build reads PBRT_SEED, all pictures are one, and the kit says so.
. test/measure/conform/kit.sh
need "${PBRT:-pbrt}"
picture() {
    sed -e "s/^Integrator \"bdpt\"/Integrator \"$method\"/" -e "s/pixelsamples\" .*/pixelsamples\" $spp/" \
        "$work/pbrt-v3/$1.pbrt" >"$work/pbrt-v3/run.pbrt"
    (cd "$work/pbrt-v3" && PBRT_SEED=$2 "${PBRT:-pbrt}" --quiet --nthreads=1 --outfile="$3" run.pbrt)
}
kit

#!/bin/sh
# pbrt-v4.sh: the kit's scenes by pbrt-v4 (kit.sh), as far as it can say them: METHOD is an
# integrator, as volpath or bdpt. PBRT4 is the program.
. test/measure/conform/kit.sh
need "${PBRT4:-pbrt-v4}"
picture() {
    sed "s/^Integrator \"bdpt\"/Integrator \"$method\"/" "$work/pbrt-v4/$1.pbrt" >"$work/run.pbrt" &&
        "${PBRT4:-pbrt-v4}" --quiet --nthreads 1 --seed "$2" --spp "$spp" --outfile "$3" "$work/run.pbrt"
}
kit

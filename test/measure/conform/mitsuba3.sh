#!/bin/sh
# mitsuba3.sh: the kit's scenes by Mitsuba 3 (kit.sh), as far as it can say them: METHOD is an
# integrator, as path. MITSUBA is the program, of the variant scalar_rgb.
. test/measure/conform/kit.sh
need "${MITSUBA:-mitsuba}"
picture() {
    [ -f "$work/mitsuba/$1.xml" ] && "${MITSUBA:-mitsuba}" -m scalar_rgb -t 1 -D "integrator=$method" \
        -D "spp=$spp" -D "seed=$2" -o "$3" "$work/mitsuba/$1.xml"
}
kit

#!/bin/sh
# ours.sh: the kit's scenes by this program (kit.sh): METHOD is an integrator, with parameters as in asbdpt:select=bins.
# PROGRAM is the program; SEED is added to the numbers of the pictures.
. test/measure/conform/kit.sh
picture() {
    parameters=${method#"${method%%:*}"}
    "${PROGRAM:-./asbdpt-lab}" render "$work/pbrt-v3/$1.pbrt" --integrator "${method%%:*}" \
        ${parameters:+-P "${parameters#:}"} --spp "$spp" --seed $((${SEED:-0} + $2)) -j 1 --quiet --unclamped -o "$3"
}
kit

#!/bin/sh
# cycles.sh: four of the kit's scenes by Blender's Cycles (kit.sh), made anew by cycles.py: METHOD is its word, cycles.
# BLENDER is the program.
. test/measure/conform/kit.sh
need "${BLENDER:-blender}"
picture() {
    case $1 in area | sky | distant | mirror) ;; *) return 1 ;; esac
    "${BLENDER:-blender}" -b --factory-startup -t 1 -P test/measure/conform/cycles.py -- "$1" "$spp" "$2" "${3%.pfm}.exr"
}
kit

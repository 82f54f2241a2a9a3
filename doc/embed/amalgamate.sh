#!/bin/sh
# amalgamate.sh DIR: the program and the library as one file, DIR/asbdpt.c, and its header, DIR/asbdpt.h:
#
#     cc -std=c99 -O2 -ffp-contract=off asbdpt.c -lm -lpthread -o asbdpt      the program
#     cc -std=c99 -O2 -ffp-contract=off -DASBDPT_LIBRARY -c asbdpt.c          the library
#
# amalgamate.awk puts headers before what includes them, each once, and renames what a file has for itself where
# another file has the same name. System headers keep their places. Run from the top; `make amalgamation` calls it.
out=${1:-out}
mkdir -p "$out" || exit
cp src/library/asbdpt.h "$out/asbdpt.h" || exit
list=
for room in $(cat src/LAYERS); do
    for file in src/"$room"/*.c; do
        case $file in
        src/base/os*.c | src/cli/*) ;;
        *) [ -f "$file" ] && list="$list $file" ;;
        esac
    done
done
program=$(ls src/cli/*.c)
# What needs the system's own headers comes last: their names are many.
LC_ALL=C awk -f doc/embed/amalgamate.awk src/*/*.h $list library: $program main: src/base/os*.c >"$out/asbdpt.c"

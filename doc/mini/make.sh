#!/bin/sh
# make.sh [DIR]: the eight programs of steps.in, into DIR (here). A line of steps.in has a margin of three columns: the
# first step that has it, and the last, "." if that is the end. Run from anywhere.
cd "$(dirname "$0")" || exit 1
out=${1:-.}
step=0
for name in 1-rays 2-paths 3-direct 4-light 5-bdpt 6-choice 7-vertices asbdpt; do
    step=$((step + 1))
    awk -v step=$step '
        { from = substr($0, 1, 1); to = substr($0, 2, 1) }
        step >= from && (to == "." || step <= (to ~ /[1-8]/ ? to : from)) { print substr($0, 4) }' \
        steps.in >"$out/$name.c" || exit 1
done

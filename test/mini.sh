#!/bin/sh
# mini.sh PROGRAM [CC...]: do doc/mini/asbdpt.c, the renderer in one file, and subspaces.c, which adds a method to it,
# compile without a warning under every compiler at hand, and make the pictures that PROGRAM makes of the same scene?
#
# Each side renders 8 pictures with seeds of their own; `verify` (test/lab/verify.h) tests the mean, every block of 8x8
# pixels and the uniformity of the p-values, corrected for their number. LEVEL makes one false alarm in 1,000 of all 9
# comparisons. Of the mini's methods pt, bdpt, pool, vertices and subspaces must agree with PROGRAM's
# bdpt, pt also with its pt; bins, which is biased, must differ from both bdpt but agree with PROGRAM's own bins.
. test/expect.sh
[ $# -gt 0 ] && shift
scene=$top/doc/mini/rooms.pbrt source=$top/doc/mini/asbdpt.c addition=$top/doc/mini/subspaces.c
compilers=${*:-$(command -v gcc clang || echo cc)}
LEVEL=1.1e-4 SEEDS="1 2 3 4 5 6 7 8"

for cc in $compilers; do
    for file in "$source" "$addition"; do
        warnings=$($cc -std=c99 -pedantic -Wall -Wextra -Wshadow -Wconversion -O2 -o mini "$file" -lm 2>&1) ||
            fault "$cc does not compile $file"
        [ -z "$warnings" ] || fault "$cc warns: $warnings"
    done
done
[ "$(wc -l <"$addition")" -le 150 ] || fault "$addition has more than 150 lines"
[ "$(wc -l <"$source")" -le 500 ] || fault "$source has more than 500 lines"
./mini 2>/dev/null && fault "no usage is printed"
./mini pt 0 x.pfm 2>/dev/null && fault "no samples are taken for some"
./mini pt 1 no/such/x.pfm 2>/dev/null && fault "an impossible output is not noticed"

# mini METHOD SPP, main METHOD SPP OPTION...: pictures of all seeds.
mini() { for k in $SEEDS; do ./mini "$1" "$2" "mini-$1-$k.pfm" "$k"; done; }
main() {
    method=$1 spp=$2
    shift 2
    for k in $SEEDS; do
        "$program" render "$scene" --quiet -j 1 --spp "$spp" --seed "$k" "$@" -o "main-$method-$k.pfm"
    done
}
# compare A B VERDICT: agree or DIFFER.
compare() {
    "$lab" verify "$scene" --files "$1"-*.pfm --against "$2"-*.pfm --tile 8 --alpha $LEVEL --quiet >verdict.txt 2>&1
    grep -q "^verdict: $3" verdict.txt ||
        fault "$1 and $2 should $3: $(cat verdict.txt); repeat with: sh test/mini.sh ./asbdpt"
}

{ mini pt 4; mini bdpt 1; mini bins 1; mini pool 1; mini vertices 1; mini subspaces 1; } &
main pt 4 --integrator pt
main bdpt 1 --integrator bdpt
main bins 1 --integrator asbdpt -P select=bins
wait
for method in pt bdpt pool vertices subspaces; do
    compare mini-$method main-bdpt agree
done
compare mini-pt main-pt agree
compare mini-bins main-bins agree
compare mini-bins main-bdpt DIFFER
compare mini-bins mini-bdpt DIFFER
[ $failures -eq 0 ] && echo "mini: one file and an addition, the same pictures"
[ $failures -eq 0 ]

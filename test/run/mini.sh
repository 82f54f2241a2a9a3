#!/bin/sh
# mini.sh PROGRAM: do the eight programs of doc/mini compile without a warning under every compiler at hand,
# draw the pictures of their page, and have the expectation that PROGRAM has of the same scene?
#
# Each side renders 8 pictures with seeds of their own; `verify` (test/lab/verify.h) tests the mean, every block of 8x8
# pixels and the uniformity of the p-values, corrected for their number. LEVEL makes one false alarm in 1,000 of all 16
# comparisons. What is unbiased must agree with PROGRAM's bdpt; bins, which is biased, must differ from it and agree
# with PROGRAM's own bins; light tracing, which sees nothing in a mirror, must differ. A method that two programs share
# makes the same bytes in both. PICTURES=all compares pictures of full size, of the page's figures too; otherwise the
# pictures have half the width. BRIEF=yes: two seeds, of which no verdict is expected: how it works with a sh and awk.
. test/run/expect.sh
mini=$top/doc/mini scene=$top/doc/mini/rooms.pbrt
steps="1-rays 2-paths 3-direct 4-light 5-bdpt 6-choice 7-vertices asbdpt"
compilers=$(command -v gcc clang || echo cc)
LEVEL=6.2e-5 SEEDS="1 2 3 4 5 6 7 8"
size=64
[ -z "${PICTURES-}" ] || size=128
[ -z "${BRIEF-}" ] || SEEDS="1 8"

before=90
for step in $steps; do
    grep -q 'SIZE = 128' "$mini/$step.c" || fault "$step.c does not say how large its pictures are"
    case $step in 1-rays) cp "$mini/$step.c" . ;; *) sed "s/SIZE = 128/SIZE = $size/" "$mini/$step.c" >$step.c ;; esac
    made="-O2 -lm -o $step" # by the first of the compilers
    for cc in $compilers; do
        # shellcheck disable=SC2086
        warnings=$($cc -std=c99 -pedantic -Wall -Wextra -Wshadow -Wconversion $step.c $made 2>&1) ||
            fault "$cc does not compile $step.c"
        [ -z "$warnings" ] || fault "$cc warns: $warnings"
        made=-fsyntax-only
    done
    lines=$(wc -l <"$mini/$step.c" | tr -d ' ')
    more=$((lines - before)) # doc/mini/README.md says how many
    { [ $more -ge 38 ] && [ $more -le 102 ]; } || fault "$step.c has $more lines more than the one before it"
    grep -q "($step.c).* | $lines |$" "$mini/README.md" || fault "doc/mini/README.md: $step.c has $lines lines"
    before=$lines
done
grep -q "one file of $lines lines" "$top/README.md" || fault "README.md: the whole method has $lines lines"

{
    ./1-rays p1.png &&
        { [ -z "${PICTURES-}" ] || { ./2-paths 64 p2.png && ./3-direct 64 p3.png && ./4-light lt 64 p4.png &&
            ./5-bdpt bdpt 64 p5.png && ./6-choice pool 64 p6.png &&
            ./7-vertices vertices 64 p7.png && ./asbdpt subspaces 64 p8.png; }; } ||
        fault "a program ends with an error"
} 2>/dev/null
for picture in p?.png; do
    k=${picture#p}
    "$lab" compare "$picture" "$mini/figures/$k" >compare.txt 2>&1
    awk '$1 == "rmse8" { good = $2 < 1 } END { exit !good }' compare.txt ||
        fault "figures/$k is another: $(cat compare.txt)"
done
"$lab" compare p1.png "$mini/figures/3.png" | awk '$1 == "rmse8" { other = $2 > 1 } END { exit !other }' ||
    fault "another picture is not noticed"

# mini STEP METHOD SPP, main METHOD SPP OPTION...: pictures of all seeds.
mini() { for k in $SEEDS; do ./$1 $2 "$3" "$1-${2:-pt}-$k.pfm" "$k" 2>/dev/null; done; }
main() {
    method=$1 spp=$2
    shift 2
    for k in $SEEDS; do
        "$program" render "$scene" --quiet -j 1 --res ${size}x$size --spp "$spp" --seed "$k" "$@" \
            -o "main-$method-$k.pfm"
    done
}
# compare A B VERDICT [TILE]: agree or DIFFER.
compare() {
    "$lab" verify "$scene" --files "$1"-*.pfm --against "$2"-*.pfm --tile "${4:-8}" --alpha $LEVEL \
        --quiet >verdict.txt 2>&1
    [ -z "${BRIEF-}" ] || set -- "$1" "$2" ''
    grep -q "^verdict: $3" verdict.txt ||
        fault "$1 and $2 should $3: $(cat verdict.txt); repeat with: sh test/run/mini.sh ./asbdpt"
}

same() { cmp -s "$1" "$2" || fault "$1 and $2 differ"; } # one method by two programs

{
    mini 2-paths "" 24; mini 3-direct "" 4; mini 5-bdpt bdpt 1; mini 6-choice pool 2
    mini 4-light lt 24
} &
{
    mini asbdpt pt 4; mini asbdpt bdpt 8; mini asbdpt pool 2; mini asbdpt vertices 2
    mini asbdpt subspaces 1
    # The bias of bins is small.
    [ -n "${BRIEF-}" ] || SEEDS="$SEEDS 9 10 11 12 13 14 15 16"
    mini asbdpt bins 3
    SEEDS=8
    mini 4-light pt 4; mini 6-choice bdpt 8; mini 7-vertices pool 2; mini 7-vertices vertices 2
} &
main bdpt 12 --integrator bdpt
main bins 3 --integrator asbdpt -P select=bins
wait
compare 2-paths-pt main-bdpt agree 32 # of so few finds the means of small squares are no normal numbers
for one in 3-direct-pt 5-bdpt-bdpt 6-choice-pool asbdpt-pt asbdpt-bdpt asbdpt-pool asbdpt-vertices asbdpt-subspaces; do
    compare $one main-bdpt agree
done
same 4-light-pt-8.pfm 3-direct-pt-8.pfm
for one in 6-choice-bdpt 7-vertices-pool 7-vertices-vertices; do
    same $one-8.pfm asbdpt-${one##*-}-8.pfm
done
compare asbdpt-bins main-bins agree
compare asbdpt-bins main-bdpt DIFFER
compare asbdpt-bins asbdpt-bdpt DIFFER
compare 4-light-lt main-bdpt DIFFER
[ $failures -eq 0 ] && echo "mini: eight programs, the same pictures"
[ $failures -eq 0 ]

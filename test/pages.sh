#!/bin/sh
# pages.sh: is what the documents take from elsewhere still what stands there? The programs of doc/mini are what
# steps.in makes. Prints what is wrong, or one line; exit status 0 only if nothing is. Run from the top.
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
bad=0
wrong() { echo "$*"; bad=1; }

# steps SOURCE: the programs that are not what SOURCE, a steps.in, makes.
steps() {
    cp doc/mini/make.sh "$dir/" && cp "$1" "$dir/steps.in" && sh "$dir/make.sh" || echo "no program is made"
    for program in "$dir"/*.c; do
        cmp -s "$program" "doc/mini/${program##*/}" || echo "${program##*/}"
    done
}
for program in $(steps doc/mini/steps.in); do
    wrong "doc/mini/$program is not what steps.in makes: sh doc/mini/make.sh"
done
sed 's/EPSILON = 1e-9/EPSILON = 1e-8/' doc/mini/steps.in >"$dir/other"
[ "$(steps "$dir/other" | wc -l | tr -d ' ')" = 8 ] || wrong "another source is not noticed"
[ $bad -eq 0 ] && echo "pages: the programs of doc/mini are what steps.in makes"
exit $bad

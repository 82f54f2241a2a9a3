#!/bin/sh
# pages.sh: is what the documents take from elsewhere still what stands there? The programs of doc/mini are what
# steps.in makes; the code in the tour is that of the sources; what page 7 works out by hand is what `trace` prints, if
# ./asbdpt-lab has been built. Prints what is wrong, or one line; exit status 0 only if nothing is. Run from the top.
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

# code: the pages whose code is not that of the sources.
code() {
    rm -rf "$dir/tour" && mkdir "$dir/tour" && sh doc/tour/code.sh "$dir/tour" || echo "no page is made"
    for page in "$dir"/tour/*.md; do
        cmp -s "$page" "$1/${page##*/}" || echo "${page##*/}"
    done
}
for page in $(code doc/tour); do
    wrong "doc/tour/$page shows other code than the sources have: sh doc/tour/code.sh"
done
grep -L '^```c$' doc/tour/[01]*.md | while read -r page; do echo "$page shows no code"; done | grep . && bad=1
cp -R doc/tour "$dir/damaged" &&
    sed 's/poor->alias = rich_index/poor->alias = 0/' doc/tour/03-alias.md >"$dir/damaged/03-alias.md"
[ "$(code "$dir/damaged")" = 03-alias.md ] || wrong "other code in a page is not noticed"

# The path that page 7 works out: its command, then lines that the program must print.
sed -n 's/^    \(  [z(y].*\)$/\1/p' doc/tour/07-weights.md >"$dir/worked"
[ "$(wc -l <"$dir/worked" | tr -d ' ')" = 5 ] || wrong "page 7 has no five lines of trace"
if [ -x asbdpt-lab ]; then
    $(sed -n 's/^    \(\.\/asbdpt-lab trace .*\)/\1/p' doc/tour/07-weights.md) >"$dir/told"
    while IFS= read -r line; do
        grep -qF -e "$line" "$dir/told" || wrong "trace does not print what page 7 has: $line"
    done <"$dir/worked"
fi
# heart README: files of the heart that the README does not name once under "Reading the source".
heart() {
    for file in $(ls src/transport/*.[ch] src/integrators/*.[ch] src/tables/*.[ch] src/learning/*.[ch] src/bins/*.c |
        sed 's|src/||; s|\.[ch]$||' | sort -u); do
        [ "$(sed -n '/^## Reading the source/,/^## What/p' "$1" | grep -o "\`$file\`" | grep -c .)" = 1 ] || echo "$file"
    done
}
for file in $(heart README.md); do wrong "README.md does not name $file once where it says how to read the source"; done
sed 's|`transport/path`|`transport/paths`|' README.md >"$dir/README.md"
[ "$(heart "$dir/README.md")" = transport/path ] || wrong "a file that the README leaves out is not noticed"

[ $bad -eq 0 ] && echo "pages: programs of doc/mini, code of the tour and page 7's path are what they are made of"
exit $bad

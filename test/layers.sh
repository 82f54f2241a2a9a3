#!/bin/sh
# layers.sh [SRC [CC...]]: the folders of SRC are rooms; SRC/LAYERS lists them, bottom up. Checked:
#   1. every file lies in a room that is listed, and includes only files of its own room and of rooms below;
#   2. inside a room there is no circle, a .c and its .h counting as one;
#   3. every header compiles alone.
# ABOVE names a folder elsewhere that is a room over all these, and that they know nothing of.
# Prints what is wrong; exit status 0 only if nothing is.
src=${1:-src}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- cc
pairs=$(mktemp) || exit 1
trap 'rm -f "$pairs" "$pairs.circle"' EXIT

awk -v pairs="$pairs" -v top="$src/" -v above="$ABOVE" '
    NR == FNR { rank[$1] = NR; next }
    FNR == 1 {
        if (n++ == 0 && above != "") rank[last_part(above)] = 1000
        me = above != "" && index(FILENAME, above "/") == 1 ? last_part(above) substr(FILENAME, length(above) + 1) : \
            substr(FILENAME, length(top) + 1)
        sub(/\.[ch]$/, "", me)
        room = me
        if (!sub(/\/.*/, "", room) || !(room in rank)) { print FILENAME ": not in a room of LAYERS"; bad = 1 }
        print me, me > pairs
    }
    /^[ \t]*#[ \t]*include[ \t]*"/ {
        dep = $0
        sub(/^[^"]*"/, "", dep)
        sub(/\.h".*/, "", dep)
        other = dep
        if (!sub(/\/.*/, "", other) || !(other in rank)) {
            print FILENAME ":" FNR ": " dep ".h is in no room"
            bad = 1
            next
        }
        if (rank[other] > rank[room]) {
            print FILENAME ":" FNR ": " room " is below " other " and may not include " dep ".h"
            bad = 1
        }
        if (other == room && dep != me) print me, dep > pairs
    }
    function last_part(path) { sub(/.*\//, "", path); return path }
    END { exit bad }' "$src/LAYERS" $(find "$src" $ABOVE -name '*.[ch]' | sort) || exit 1

if ! tsort "$pairs" >/dev/null 2>"$pairs.circle" || [ -s "$pairs.circle" ]; then
    echo "$src: files of a room include each other in a circle:"
    cat "$pairs.circle"
    exit 1
fi

for header in "$src"/*/*.h ${ABOVE:+"$ABOVE"/*.h}; do
    printf '#include "%s/%s"\nint main(void);\n' "$(basename "$(dirname "$header")")" "$(basename "$header")" |
        "$@" -std=c99 -pedantic "-I$src" ${ABOVE:+"-I$ABOVE/.."} -fsyntax-only -x c - || {
        echo "$header does not compile alone"
        exit 1
    }
done

#!/bin/sh
# layers.sh: src/LAYERS lists the modules bottom up; a file may include only its own header and earlier modules.
# Then every header must compile alone. Run from the top: sh test/layers.sh [CC]
awk 'NR == FNR { rank[$1] = NR; next }
     FNR == 1 { me = FILENAME; sub(/.*\//, "", me); sub(/\.[ch]$/, "", me)
                if (!(me in rank)) { print FILENAME ": not listed in src/LAYERS"; bad = 1 } }
     /^[ \t]*#[ \t]*include[ \t]*"/ {
                dep = $0; sub(/^[^"]*"/, "", dep); sub(/\.h".*/, "", dep)
                if (dep != me && !(dep in rank && rank[dep] < rank[me])) {
                    print FILENAME ":" FNR ": " me " may not include " dep; bad = 1 } }
     END { exit bad }' src/LAYERS src/*.[ch] || exit 1
for header in src/*.h; do
    printf '#include "%s"\n' "$header" | ${1:-cc} -std=c99 -pedantic -I. -fsyntax-only -x c - || {
        echo "$header does not compile alone"
        exit 1
    }
done

#!/bin/sh
# layers.sh [SRC [CC...]]: the folders of SRC are rooms; SRC/LAYERS lists them, bottom up. Checked:
#   1. every file lies in a room that is listed, and includes only files of its own room and of rooms below;
#   2. inside a room there is no circle, a .c and its .h counting as one;
#   3. every header compiles alone: its own .c file includes it before all else, or it is tried;
#   4. what a header offers is called in SRC: whatever only others call, they bring, except for the library's header. A planted function is not missed.
# ABOVE names folders elsewhere that are rooms over all these, bottom up, and that they know nothing of.
# Prints what is wrong; exit status 0 only if nothing is.
src=${1:-src}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- cc
pairs=$(mktemp) || exit 1
trap 'rm -f "$pairs" "$pairs.circle" "$pairs.first" "$pairs.h"' EXIT
: >"$pairs.first"

awk -v pairs="$pairs" -v first="$pairs.first" -v top="$src/" -v above="$ABOVE" '
    NR == FNR { rank[$1] = NR; next }
    FNR == 1 {
        if (n++ == 0)
            for (i = split(above, over, " "); i > 0; i--) rank[last_part(over[i])] = 1000 + i
        me = last_part(FILENAME)
        room = substr(FILENAME, 1, length(FILENAME) - length(me) - 1)
        sub(/\.[ch]$/, "", me)
        if (!((room = last_part(room)) in rank)) { print FILENAME ": not in a room of LAYERS"; bad = 1 }
        me = room "/" me
        print me, me > pairs
        began = FILENAME ~ /\.h$/
    }
    !began && /^[ \t]*#/ {
        began = 1
        if ($2 == "\"" me ".h\"") print me > first
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
    END { exit bad }' "$src/LAYERS" $(find "$src" $ABOVE -name '*.[ch]' | sort -u) || exit 1

if ! tsort "$pairs" >/dev/null 2>"$pairs.circle" || [ -s "$pairs.circle" ]; then
    echo "$src: files of a room include each other in a circle:"
    cat "$pairs.circle"
    exit 1
fi

for room in "$src"/*/ $ABOVE; do
    set -- "$@" "-I$room/.."
done
for header in $(find "$src" $ABOVE -name '*.h' | sort -u); do
    name=${header%.h} folder=${header%/*}
    name=${folder##*/}/${name##*/}
    grep -qxF "$name" "$pairs.first" && continue
    printf '#include "%s.h"\nint main(void);\n' "$name" |
        "$@" -std=c99 -pedantic -fsyntax-only -x c - || {
        echo "$header does not compile alone"
        exit 1
    }
done

# uncalled FILE...: a line that begins with a type declares or defines a function; all other words are uses.
uncalled() {
    awk -f "$(dirname "$0")/pieces.awk" "$@" | awk -F '\t' '
    $3 == "code" {
        line = $4
        if (line ~ /^[a-z][^=;]*[a-z0-9_]\(/ && line !~ /^typedef/) {
            name = line
            sub(/\(.*/, "", name)
            line = substr(line, length(name) + 1)
            sub(/.*[^A-Za-z0-9_]/, "", name)
            if ($1 ~ /\.h$/) where[name] = $1 ":" $2
        }
        n = split(line, word, /[^A-Za-z0-9_]+/)
        for (i = 1; i <= n; i++) used[word[i]] = 1
    }
    END {
        for (name in where)
            if (!(name in used) && name !~ /^os_/ && where[name] !~ /\/asbdpt\.h:/) {
                # the system is called in base/os*.c for all who need it; a library by others
                print where[name] ": nobody calls " name "() in these rooms; it belongs to those who do"
                bad = 1
            }
        exit bad
    }'
}
echo 'int planted(int x);' >"$pairs.h"
if uncalled "$pairs.h" >/dev/null; then
    echo "a function without a caller is not noticed"
    exit 1
fi
uncalled $(find "$src" -name '*.[ch]' | sort)

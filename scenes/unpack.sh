#!/bin/sh
# unpack.sh: the small files that lie in the lists of a folder, *.txt, as files of their own:
#     sh scenes/unpack.sh scenes/features        beside the lists
#     sh scenes/unpack.sh scenes/features DIR    into DIR, with copies of the folder's other files
#     sh scenes/unpack.sh LIST.txt DIR           of one list
# How lists are read test/fuzz/lists.h says, whose program does the same for the tests.
from=${1:?a folder with lists} to=${2:-$1}
[ -d "$from" ] && set -- "$from"/* || set -- "$from"
mkdir -p "$to" || exit
for file; do
    case $file in
    *.txt)
        awk -v to="$to/" '
            function end() { if (file && !bare) print "" >file; close(file); n = 0 }
            /^== / { end(); bare = sub(/!$/, "", $2); file = to $2 ($3 == "packed" ? ".packed" : ""); next }
            file { printf "%s%s", (n++ ? "\n" : ""), $0 >file }
            END { end() }' "$file" || exit
        ;;
    *) [ "$from" = "$to" ] || [ -d "$file" ] || cp "$file" "$to" || exit ;;
    esac
done
for packed in "$to"/*.packed; do
    [ -f "$packed" ] || continue
    # shellcheck disable=SC2059
    while IFS= read -r line; do printf "$line"; done <"$packed" >"${packed%.packed}" && rm "$packed" || exit
done

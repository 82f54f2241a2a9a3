#!/bin/sh
# columns.sh [TOP]: no line of src, test and scenes/generate is longer than the ColumnLimit of .clang-format, and all
# of them are printable ASCII. (Fixtures and what is fuzzed with may hold what they like.) Prints what is wrong; exit
# status 0 only if nothing is.
top=${1:-.}
limit=$(sed -n 's/^ColumnLimit: *//p' "$top/.clang-format")
find "$top/src" "$top/test" "$top/scenes/generate" \( -name fixtures -o -name corpus \) -prune -o -type f -print |
    sort |
    while IFS= read -r file; do
        LC_ALL=C awk -v limit="${limit:-0}" '
            length($0) > limit { print FILENAME ":" FNR ": " length($0) " characters, more than " limit }
            /[^ -~]/ { print FILENAME ":" FNR ": a character that is not printable ASCII" }' "$file"
        echo
    done | awk '/./ { print; bad = 1 } END { exit bad || NR == 0 }'

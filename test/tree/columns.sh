#!/bin/sh
# columns.sh: which lines of src, test and scenes/generate are longer than the ColumnLimit of .clang-format, or not
# printable ASCII, and which sources have more than 500 lines? (Fixtures and what is fuzzed with may hold what they
# like.) Run from the top.
LC_ALL=C
export LC_ALL
limit=$(sed -n 's/^ColumnLimit: *//p' .clang-format)
find src test scenes/generate \( -name fixtures -o -name corpus.txt \) -prune -o -type f -exec awk -v limit="$limit" '
    FNR == 501 && FILENAME ~ /\.[ch]$/ { print FILENAME ": more than 500 lines" }
    length($0) > limit { print FILENAME ":" FNR ": " length($0) " characters, more than " limit }
    /[^ -~]/ { print FILENAME ":" FNR ": a character that is not printable ASCII" }' {} + | sort

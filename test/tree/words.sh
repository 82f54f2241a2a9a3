#!/bin/sh
# words.sh [TOP [LISTS]]: are the documents short enough, and easy to read? It checks
#   - the words of each page, without measured tables, against words/limits.txt;
#   - the words of each sentence (at most 35) and their mean over a page (below 18);
#   - that no phrase of words/phrases.txt is in a page, or in a comment or a string of src and test/lab.
# words/exceptions.txt lists what may stay. Prints the words of each row of limits.txt, then what it has found.
awk=$(cd "$(dirname "$0")/words" && pwd) && lists=$(cd "${2:-$awk}" && pwd) && cd "${1:-.}" || exit 2
LC_ALL=C
export LC_ALL
{
    find . \( -name 'build*' -o -name out -o -name .git \) -prune -o -name '*.md' -print | sed 's/^\.\///' | sort |
        xargs awk -f "$awk/pages.awk"
    find src test/lab -name '*.[ch]' | sort | xargs awk -f "$awk/../pieces.awk" | awk -f "$awk/sources.awk"
} | awk -F '\t' -f "$awk/check.awk" "$lists/limits.txt" "$lists/phrases.txt" "$lists/exceptions.txt" -

#!/bin/sh
# tree_stats.sh: how large the tree is: for every room of src and every other part, its files, lines, lines of code and
# share of comment; and words of the documents. Some totals have a goal, which is shown beside them. Run from the top.
# A line of code holds something else than comment. Words to be read are those outside of tables; pages that are looked
# up are not counted, as in words.txt. Scripts are shell and awk.
set -u
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
if git rev-parse >/dev/null 2>&1; then git ls-files; else find . -type f ! -path './build*' ! -path './out/*'; fi |
    sed 's|^\./||' | while IFS= read -r file; do [ ! -f "$file" ] || echo "$file"; done >"$work/files"

# count NAME PATTERN [GOAL-FOR-LINES [GOAL-FOR-CODE]]: files whose path matches the extended regexp. "-": no goal.
count() {
    grep -E "$2" "$work/files" | tr '\n' '\0' | xargs -0 cat /dev/null | awk -v name="$1" -v most="${3:--}" \
        -v most_code="${4:--}" -v files="$(grep -cE "$2" "$work/files")" -v script="$(echo "$2" | grep -c awk)" '
        function beside(n, goal) {
            if (goal != "-" && n > goal) mark = "  above"
            return goal == "-" ? sprintf("%7d %8s", n, "") : sprintf("%7d of %5d", n, goal)
        }
        {
            line = $0
            comment = inside
            kept = ""
            while (1)
                if (inside) {
                    if (!(at = index(line, "*/"))) { line = ""; break }
                    line = substr(line, at + 2); inside = 0
                } else {
                    if (script || !(at = index(line, "/*"))) break
                    comment = inside = 1
                    kept = kept substr(line, 1, at - 1); line = substr(line, at + 2)
                }
            if (script && line ~ /^[ \t]*#/) comments++
            else if (kept line ~ /[^ \t]/) code++
            else if (comment) comments++
        }
        END {
            printf "%-30s %5d  %s %s %3d %%%s\n", name, files, beside(NR, most), beside(code, most_code),
                100 * comments / (code + comments + !NR), mark
        }'
}

# words NAME GOAL: of standard input.
words() { awk '{ for (i = 1; i <= NF; i++) n += $i ~ /[A-Za-z0-9]/ } END { print n }' | total "$@"; }
# total NAME GOAL: a number of standard input.
total() {
    awk -v name="$1" -v most="$2" '{ printf "%-37s %7d of %5d%s\n", name, $1, most, ($1 > most ? "  above" : "") }'
}
documents() {
    looked_up='^(src|test|scenes)/|^doc/(references|portability)\.md|^doc/(cluster|course/teacher)/'
    grep '\.md$' "$work/files" | grep -vE "$looked_up" | tr '\n' '\0' | xargs -0 cat
}

{
    printf '%-30s %5s  %7s %8s %7s %8s %5s\n' part files lines '' code '' comment
    for room in $(cat src/LAYERS); do
        count "src/$room" "^src/$room/.*\.[ch]$"
    done
    count 'transport, methods' '^src/(transport/|integrators/([^s]|subspaces)).*\.[ch]$' - 1800
    count 'learning, tables, techniques' '^src/(learning/|tables/|integrators/services).*\.[ch]$' - 1350
    count 'src' '^src/.*\.[ch]$' 22500 18900
    count 'laboratory' '^test/lab/.*\.[ch]$' 13300
    count 'tests' '^test/unit/[^/]*\.[ch]$' 19500
    count 'scripts of tests' '^test/.*\.(sh|awk)$' 4200
    count 'scripts of documents' '^doc/.*\.(sh|awk)$'
    documents | grep -v '^|' | words 'words to be read' 40000
    documents | words 'words with tables' 50000
    wc -l <"$work/files" | total files 1500
}

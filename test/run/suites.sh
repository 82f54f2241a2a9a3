#!/bin/sh
# suites.sh: runs tests, as many at a time as there are cores.
#   sh test/run/suites.sh COMMAND...
# A command without a blank is a test program: it stands for all its suites that are not slow, the last first, which are
# the long ones. Of each command that passes one line is said. What the others have said comes last, their messages
# before their results, above "N passed, N failed"; the status is 0 only if nothing failed.
# So that no test depends on it, the tree and TMPDIR have paths with blanks and an umlaut here, and umask is 077.
set -u
umask 077
cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
odd=$(printf '%s/two w\303\266rds' "$work")
mkdir "$odd" && ln -s "$(pwd -P)" "$odd/the tree" && cd "$odd/the tree" || exit 1
TMPDIR=$odd
export TMPDIR
for command; do
    case $command in
    *' '*) echo "$command" ;;
    *) "$command" -l >"$work/suites" &&
        awk -v program="$command" '!/slow/ { all = program " " $1 "\n" all } END { printf "%s", all }' "$work/suites" ;;
    esac || { echo "FAILED: $command -l" >&2; exit 1; }
done >"$work/commands" || exit
: >"$work/failed"
tr '\n' '\0' <"$work/commands" | xargs -0 -n 1 -P "$cores" sh -c '
    said=$0/$$ begun=$(date +%s)
    if sh -c "$1" >"$said" 2>"$said.messages"; then
        why=$(grep -h "^skipped: " "$said" | tr "\n" ";")
        echo "passed, $(($(date +%s) - begun)) s: $1${why:+; ${why%;}}"
    else
        echo "FAILED: $1"
        { echo "== $1" && cat "$said.messages" "$said"; } >>"$0/failed.$$"
        echo "$0/failed.$$" >>"$0/failed"
    fi' "$work"
all=$(wc -l <"$work/commands") failed=$(wc -l <"$work/failed")
while IFS= read -r said; do cat "$said"; done <"$work/failed"
echo "$((all - failed)) passed, $((failed)) failed"
[ "$all" -gt 0 ] && [ "$failed" = 0 ]

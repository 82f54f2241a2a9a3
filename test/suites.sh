#!/bin/sh
# suites.sh: runs tests, as many at a time as there are cores.
#   sh test/suites.sh COMMAND...
# A command without a blank is a test program: it stands for all its suites that are not slow, the last first, which are
# the long ones. What a test says comes in one piece when it has ended. The last line is "N passed, N failed"; the
# status is 0 only if nothing failed.
set -u
cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
for command; do
    case $command in
    *' '*) echo "$command" ;;
    *) "$command" -l | awk -v program="$command" '!/slow/ { all = program " " $1 "\n" all } END { printf "%s", all }' ;;
    esac
done >"$work/commands"
: >"$work/failed"
tr '\n' '\0' <"$work/commands" | xargs -0 -n 1 -P "$cores" sh -c '
    sh -c "$1" >"$0/$$" 2>&1 || echo "failed: $1" >>"$0/failed"
    grep -Ev "^[0-9]+ (checks|passed)" "$0/$$"
    true' "$work"
cat "$work/failed"
all=$(wc -l <"$work/commands") failed=$(wc -l <"$work/failed")
echo "$((all - failed)) passed, $((failed)) failed"
[ "$all" -gt 0 ] && [ "$failed" = 0 ]

#!/bin/sh
# suites.sh: runs the suites of the test program, as many at a time as there are cores, the long ones, which stand at
# the end, first.
#   sh test/suites.sh build/test [SUITE...]      all that are not slow, unless some are named
# What a suite says comes in one piece when it has ended. The last line is "N passed, N failed"; the status is 0 only if
# nothing failed.
set -u
test=$1
shift
cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
[ $# -gt 0 ] || set -- $("$test" -l | awk '!/slow/ { all = $1 " " all } END { print all }')
for suite; do echo "$suite"; done | xargs -n 1 -P "$cores" sh -c '
    "$0" "$2" >"$1/$2" 2>&1 || echo "$2" >>"$1/failed"
    grep -Ev "^[0-9]+ (checks|passed)" "$1/$2"' "$test" "$work"
failed=0
[ ! -e "$work/failed" ] || failed=$(wc -l <"$work/failed")
echo "$(($# - failed)) passed, $((failed)) failed"
[ "$failed" = 0 ]

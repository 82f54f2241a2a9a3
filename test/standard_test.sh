#!/bin/sh
# standard_test.sh: does standard.sh find what it is for, and only that?
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir -p "$dir/src/room"
failures=0

# try STATUS TEXT
try() {
    printf '%s\n' "$2" >"$dir/src/room/a.c"
    sh test/standard.sh "$dir" >"$dir/log"
    [ $? -eq "$1" ] && return
    echo "FAIL: standard.sh should have exit status $1 for: $2"
    failures=1
}

try 0 'double f(double x) { return m_sin(x) + sqrt(x) + cylinder_pow(x); } /* sin(x) */'
try 0 'const char *s = "Math.exp(x)"; /* of
cos(x) */ double cos_max;'
try 1 'double f(double x) { return sin(x); }'
try 1 'double f(double x) { return /* a */ 2 * expf (x); }'
try 1 '/* of
this */ double f(double x) { return pow(x, 2); }'
try 0 '#include <stdio.h>'
try 1 '#include <unistd.h>'
try 1 '# define _POSIX_C_SOURCE 200809L'
exit $failures

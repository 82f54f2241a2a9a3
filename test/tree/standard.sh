#!/bin/sh
# standard.sh: all that is written keeps to what is the same everywhere. Of src and test/lab:
#   1. it calls no function of libm that every library rounds in its own way, which would give pictures other bytes on
#      another machine: base/maths.h has them. What IEEE 754 or C99 defines to the last bit (sqrt, fabs, floor, ceil,
#      fmin, fmax, fmod, frexp, ldexp, nextafter) may be called;
#   2. it includes no header that C99 does not have, except in base/os.c and os_thread.c, nor asks there for what
#      headers may show;
#   3. it prints messages by say_line() alone (base/error.h), which lets no control character of a file through.
# Scripts have no feature of one shell, one awk or GNU's tools alone, as far as a line shows it: each row below is a
# pattern (extended regular expression) and, after a tab, a line that it must find. What no line shows is found by
# test/run/tools.sh, which runs the scripts with other tools.
# Prints what is wrong; exit status 0 only if nothing is. Run from the top.
export LC_ALL=C
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
bad=0 n=0
awk -f test/tree/pieces.awk $(find src test/lab -name '*.[ch]' | sort) | awk -F '\t' '
    BEGIN {
        n = split("sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 exp10 expm1 log log2 " \
                  "log10 log1p pow sincos hypot cbrt erf erfc lgamma tgamma fma j0 j1 jn y0 y1 yn", name, " ")
        for (i = 1; i <= n; i++) rough[name[i]] = rough[name[i] "f"] = rough[name[i] "l"] = 1
        n = split("assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdarg " \
                  "stdbool stddef stdint stdio stdlib string tgmath time wchar wctype", name, " ")
        for (i = 1; i <= n; i++) standard[name[i] ".h"] = 1
    }
    $3 != "code" { next }
    $1 !~ /base\/os(_thread)?\.c$/ && $4 ~ /^ *# *(include *<|define _)/ {
        header = $4
        gsub(/^[^<]*<|>.*/, "", header)
        if (!(header in standard)) { print $1 ":" $2 ": " $4 " belongs in base/os.c"; bad = 1 }
    }
    $1 !~ /base\/(error|mem|progress)\.c$/ && $4 ~ /(printf|puts|putc|fwrite).*stderr/ {
        print $1 ":" $2 ": messages are printed by say_line()"
        bad = 1
    }
    {
        while (match($4, /[A-Za-z_][A-Za-z_0-9]*/)) {
            word = substr($4, RSTART, RLENGTH)
            $4 = substr($4, RSTART + RLENGTH)
            if (word in rough && $4 ~ /^ *[(]/) {
                print $1 ":" $2 ": " word "() differs from machine to machine; see base/maths.h"
                bad = 1
            }
        }
    }
    END { exit bad || NR == 0 }' || bad=1

cat >"$dir/rows" <<'END'
(^|[ !;&|])\[\[ 	if [[ $a = b* ]]; then
\[ [^]]* == 	[ "$a" == b ]
<<<	cat <<<"$text"
[a-z0-9")] &>>?[a-z"/$]	command &>file
[ (][<>]\([a-z]	diff <(sort a) <(sort b)
^ *\(\([a-z]|[;&|] *\(\([a-z]	((n = n + 1))
\$\{[A-Za-z_]+(//|\^|,|:[0-9])	echo "${name//a/b}"
\$RANDOM|\$\{?(BASH|PIPESTATUS|SECONDS)	echo "$RANDOM"
^ *(local|declare|typeset|shopt|pushd|mapfile|readarray) 	    local name=$1
^ *function [a-z_]+ *\{	function name {
^ *set .*pipefail	set -o pipefail
(^|[;|&]) *source [a-z./$"]	source file.sh
(^|[ ;|{])echo -[en]	echo -n text
(^|[ ;|])read (-[adnpstu]|-r?[adnpstu])	read -a words
printf [^|]*%[q(]	printf %q "$name"
=\$'	name=$'\n'
(gensub|patsplit|strftime|systime|mktime|asorti?|lshift|rshift) *\([a-z/]	x = gensub(/a/, "b", 1)
PROCINFO|BEGINFILE|ENDFILE|IGNORECASE|FPAT|FIELDWIDTHS	BEGIN { IGNORECASE = 1 }
\|& *getline	"date" |& getline now
(^|[ ;|(])grep (-[a-zA-Z]+ )*-[a-zA-Z]*P	grep -oP 'a\d'
(^|[ ;|(])sed (-[a-zA-Z]+ )*-[a-zA-Z]*[irz]	sed -i s/a/b/ file
(grep|sed) [^|]*[^\\]\\[<>bBwWsS+?]	grep 'a\+' file
sort (-[a-zA-Z]+ )*-[a-zA-Z]*[Vh]	sort -V names
(^|[ ;|(])(date -d|readlink -f|stat -[cf]|realpath|nproc|tac|cp -a|xargs -r)([ )]|$)	cores=$(nproc)
find .* -(printf|quit|readable|executable)	find . -printf '%s'
END
# found PATTERN FILE...: the lines that have it; comments do not count.
found() { grep -nE -e "$@" /dev/null | grep -vE '^[^:]*:[0-9]*: *#'; }
scripts=$(find . \( -name 'build*' -o -name out -o -name .git \) -prune -o \( -name '*.sh' -o -name '*.awk' \) -print |
    grep -v /standard.sh | sort)
while IFS='	' read -r pattern specimen; do
    n=$((n + 1))
    printf '%s\n' "$specimen" >"$dir/specimen"
    found "$pattern" "$dir/specimen" >/dev/null || { echo "standard: not noticed: $specimen"; bad=1; }
    # shellcheck disable=SC2086
    ! found "$pattern" $scripts Makefile .ci/run doc/measured/list.txt || bad=1
done <"$dir/rows"
[ "$n" -gt 20 ] || { echo "standard: only $n patterns"; bad=1; }
[ $bad -eq 0 ] || echo "standard: the lines above have what only some shells, awks or tools understand"
exit $bad

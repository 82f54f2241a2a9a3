#!/bin/sh
# scripts.sh: scripts have no feature of one shell, one awk or GNU's tools alone, as far as a line shows it. Each row
# below is a pattern (extended regular expression) and, after a tab, a line that it must find. What no line shows is
# found by test/run/tools.sh, which runs the scripts with other tools. Prints what is wrong; exit status 0 only if
# nothing is. Run from the top.
export LC_ALL=C
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
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
bad=0 n=0
scripts=$(find . \( -name 'build*' -o -name out -o -name .git \) -prune -o \( -name '*.sh' -o -name '*.awk' \) -print |
    grep -v /scripts.sh | sort)
while IFS='	' read -r pattern specimen; do
    n=$((n + 1))
    printf '%s\n' "$specimen" >"$dir/specimen"
    found "$pattern" "$dir/specimen" >/dev/null || { echo "scripts: not noticed: $specimen"; bad=1; }
    # shellcheck disable=SC2086
    ! found "$pattern" $scripts Makefile .ci/run doc/measured/list.txt || bad=1
done <"$dir/rows"
[ "$n" -gt 20 ] || { echo "scripts: only $n patterns"; bad=1; }
[ $bad -eq 0 ] || echo "scripts: the lines above have what only some shells, awks or tools understand"
exit $bad

#!/bin/sh
# readme.sh PROGRAM: the commands of README.md and doc/*.md do what they say, at least without an error. Run are all
# indented lines that begin with ./asbdpt, make or mkdir, in order, in a scratch directory where the tree is linked, so
# that they write nothing into it. Prints how long each took. Not run, and said so:
#   - with a placeholder, a word of capitals such as SCENE or REF;
#   - those of the list below.
program=$1
case $program in /*) ;; *) program=$PWD/$program ;; esac
top=$PWD
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
for entry in "$top"/*; do
    case ${entry##*/} in out | asbdpt) ;; *) ln -s "$entry" "$dir/" ;; esac
done
ln -s "$program" "$dir/asbdpt"
cd "$dir" || exit 1

# why COMMAND: a reason not to run it, or nothing.
why() {
    case $1 in
    "make test" | "make check"* | "make mutants" | "make san" | "make tsan") echo "other tests" ;;
    "make portability" | "make ref" | "make experiments" | "make web" | "make inject") echo "over a minute" ;;
    "make install"* | "make clean") echo "changes the system or the tree" ;;
    *"--equal-time"* | *" worth "* | *"ajar.pbrt -o out/ajar.png "*) echo "over a minute" ;;
    *"verify --images A"*) echo "placeholder" ;;
    *) echo "$1" | grep -Eq '(^|[ /])[A-Z]{2,}([ ./]|$)|\.\.\.' && echo "placeholder" ;;
    esac
}

grep -hE '^    (\./asbdpt|make|mkdir)( |$)' "$top/README.md" "$top"/doc/*.md |
    sed 's/^    //; s/  *# .*//' >commands.txt
n=0 failures=0
while IFS= read -r command; do
    reason=$(why "$command")
    if [ -n "$reason" ]; then
        echo "not run ($reason): $command"
        continue
    fi
    start=$(date +%s)
    if ! sh -c "$command" >said.txt 2>&1 </dev/null; then
        echo "FAIL: $command"
        cat said.txt
        failures=$((failures + 1))
    fi
    n=$((n + 1))
    echo "$(($(date +%s) - start)) s: $command"
done <commands.txt
echo "readme: $n commands run, $failures failed"
[ $failures -eq 0 ] && [ $n -gt 10 ]

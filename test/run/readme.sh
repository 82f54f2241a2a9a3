#!/bin/sh
# readme.sh PROGRAM [DOCUMENT...]: the commands of the documents (README.md, CONTRIBUTING.md, doc/*.md,
# doc/cluster/*.md, doc/tour/*.md, doc/mini/*.md) do what these say.
# Run are all indented lines that begin as commands of this tree do, in order, in a scratch directory where the tree is
# linked, so that they write nothing into it: each must end without an error, and leave nothing that git would show as
# untracked. What follows a command in the same listing is quoted from its output: each line but "..." must be there,
# letter by letter, and if one names the place of an error in a file, the command must fail. Prints how long each took.
# Not run, and said so:
#   - with a placeholder, a word of capitals such as SCENE or REF;
#   - those of the list below.
. test/run/expect.sh
shift
all=$#
for entry in "$top"/*; do
    case ${entry##*/} in out | asbdpt | asbdpt-lab) ;; *) ln -s "$entry" . ;; esac
done
ln -s "$program" asbdpt
ln -s "$lab" asbdpt-lab
mkdir out
[ $all -gt 0 ] || set -- README.md CONTRIBUTING.md doc/*.md doc/cluster/*.md doc/tour/*.md doc/mini/*.md

# why COMMAND: a reason not to run it, or nothing.
why() {
    case $1 in
    "make test" | "make check"* | "make mutants" | "make "*san | *run.sh* | *course.sh*) echo "other tests" ;;
    "make portability" | "make ref" | "make gallery" | "make experiments" | "make web" | "make inject" | \
        "make evidence"* | *"equal-time"* | *out/gallery* | *"-lab family"* | *"tune.sh"* | \
        *"conform/measure.sh"* | *"ajar.pbrt -o out/ajar.png "*) echo "over a minute" ;;
    "make install"* | "make clean") echo "changes the system or the tree" ;;
    valgrind*) command -v valgrind >/dev/null || echo "valgrind is not there" ;;
    *resampling*) echo "a method that the page adds" ;;
    *"conform out/pbrt") command -v "${PBRT:-pbrt}" >/dev/null || echo "pbrt-v3 is not there" ;; # as kit.sh: need
    *"verify --images A"*) echo "placeholder" ;;
    *) echo "$1" | grep -Eq '(^|[ /=])[A-Z]{2,}([ ./]|$)|\.\.\.' && echo "placeholder" ;;
    esac
}

# left: is something new here, outside of out/ and of what make builds? Then it is named in left.txt, once.
mkdir "$dir.seen" && trap 'rm -rf "$dir" "$dir.seen"' EXIT
left() {
    ls -A | grep -Evx 'out|build.*|asbdpt|asbdpt-lab|(commands|said|left|wrong)\.(txt|md)' >"$dir.seen/now"
    comm -13 "$dir.seen/before" "$dir.seen/now" >left.txt
    mv "$dir.seen/now" "$dir.seen/before"
    [ ! -s left.txt ]
}
: >"$dir.seen/before"
left

# A line each: "$ COMMAND", and "> LINE" for what is quoted from its output.
awk '
    !/^    / { quoting = 0; next }
    /^    (\.\/|sh |(make|mkdir|cc|awk|valgrind)( |$)|[A-Z]+=)/ {
        sub(/^    /, "")
        sub(/ +# .*/, "")
        print "$ " $0
        quoting = 1
        next
    }
    quoting && !/^ *\.\.\.$/ { print "> " substr($0, 5) }' "$@" >commands.txt
n=0 quoted=0 reason="nothing is quoted before the first command"
while IFS= read -r line; do
    text=${line#??}
    case $line in
    "> "*)
        [ -n "$reason" ] && continue
        grep -qxF -e "$text" said.txt || fault "$command does not say: $text"
        echo "$text" | grep -Eq '^asbdpt: .*:[0-9]+:[0-9]+: ' && expected=1
        quoted=$((quoted + 1))
        continue
        ;;
    esac
    [ "${status:-0}" = "${expected:-0}" ] || { fault "status $status: $command"; cat said.txt; }
    command=$text status=0 expected=0 reason=$(why "$text")
    if [ -n "$reason" ]; then
        echo "not run ($reason): $command"
        continue
    fi
    start=$(date +%s)
    sh -c "$command" >said.txt 2>&1 </dev/null || status=$?
    left || fault "$command leaves: $(cat left.txt)"
    n=$((n + 1))
    echo "$(($(date +%s) - start)) s: $command"
done <commands.txt
[ "${status:-0}" = "${expected:-0}" ] || { fault "status $status: $command"; cat said.txt; }
echo "readme: $n commands run, $quoted lines of output compared, $failures failed"

# What must not pass: a line that is not said, a command that fails, one that should fail, and nothing at all.
wrong() {
    printf "$1" >wrong.md
    sh "$top/test/run/readme.sh" "$program" wrong.md >wrong.txt 2>&1 && fault "not noticed: $1"
}
if [ $all -gt 0 ]; then
    [ $failures -eq 0 ] && [ $n -gt 0 ]
    exit
fi
wrong '    ./asbdpt --version\n    asbdpt 0.0\n'
wrong '    ./asbdpt --nothing\n'
wrong '    ./asbdpt --version >mini\n'
wrong '    ./asbdpt --version\n    asbdpt: a.pbrt:1:1: x\n'
wrong 'nothing\n'
[ $failures -eq 0 ] && [ $n -gt 10 ] && [ $quoted -gt 5 ]

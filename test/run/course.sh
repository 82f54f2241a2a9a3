#!/bin/sh
# course.sh: assignments that build, and exercises that answer (doc/course/README.md).
#   sh test/run/course.sh list                 the assignments, and the mutants of the tour's exercises
#   sh test/run/course.sh start N [DIR]        a copy of the tree without the functions of assignment N
#   sh test/run/course.sh grade [N [DIR]]      build the copy, run its tests, measure, and explain what is still wrong
#   sh test/run/course.sh exercise MUTANT      what the fault of an exercise does: pictures, the mean, tests, reasoning
#   sh test/run/course.sh variant NUMBER       what the second parts ask of the student of that number
#   sh test/run/course.sh grade-all DIR [-j N] grade every folder of DIR, a student's files each: DIR/grades.csv
#   sh test/run/course.sh check                does every hole apply, has every exercise an answer? (seconds)
#   sh test/run/course.sh prove [N | PLANT]    is every hole, and every planted mistake, found and named? (half an hour)
# DIR is ../asbdpt-course/N if none is named; called in a copy, `grade` needs neither N nor DIR. What is known of an
# assignment or exercise is in test/course/list.txt; how a copy is judged is in test/course/judge.sh.
set -u
list=test/course/list.txt
work=$PWD/build-course
original= kept= # the original, where a student's program does not find it by chance, and its pictures: see original
SANE="-g -fsanitize=address,undefined -fno-sanitize-recover=undefined" # for what is changed

say() { printf '%s\n' "$@"; }
die() { say "course: $*" >&2; exit 2; }

# In a copy, the tree that it came from does the work: `start` wrote the assignment and the tree into .course.
if [ -f .course ]; then
    read -r name tree <.course
    case ${1-} in grade) set -- grade "${2:-$name}" "${3:-$PWD}" ;; esac
    case ${3-} in '' | /*) ;; *) set -- "$1" "$2" "$PWD/$3" ;; esac
    cd "$tree" 2>/dev/null || die "this copy came from $tree, which is gone. In another: grade $name '$PWD'"
    exec sh test/run/course.sh "$@"
fi

# get NAME KEY: what the entry says under that key, a line for each time. names KIND: all entries of a kind. files NAME:
# those in which the functions of an assignment are.
get() {
    awk -v n="$1" -v key="$2" '/^[ae]/ { here = $2 == n } here && $1 == key { sub(/^ *[a-z]+ */, ""); print }' $list
}
names() { awk -v kind="$1" '$1 == kind { print $2 }' $list; }
files() { get "$1" hole | sed 's/ .*//' | sort -u; }

# ---- copies of the tree ----
# build TREE WORD...: what make is told; a dot for each file, and what the compiler says. -O1: it is the compiler one
# waits for here. What is changed in a copy, and nothing else, is built with sanitizers: they say the line in which an
# index leaves its array.
build() {
    extra="-Wno-unused-parameter -Wno-unused-function" old=
    [ "$1" = "$original" ] || { extra="$extra $SANE" old="-o build/flags"; }
    (cd "$1" && shift && MAKEFLAGS='' ${MAKE:-make} -s -j2 CC="${CC:-cc}" BUILD=build LTO= OPT=-O1 CFLAGS="$extra" \
        $old "$@" 2>&1 || echo "It does not compile yet.") |
        awk '/^  (build|asbdpt)/ { printf "."; dots++; next } /^It does not/ { bad = 1 } { print }
            END { if (dots) print ""; exit bad }'
}

# sanitizers: none in $SANE if no program with them can be made and run here; $leaks: 1 if they see lost memory.
sanitizers() {
    echo '#include <stdlib.h>
        int main(int n, char **word) { char *lost = malloc(n); lost[0] = word[0][0]; return lost = NULL, !n; }' \
        >"$work/sane.c"
    ${CC:-cc} $SANE -o "$work/sane" "$work/sane.c" 2>/dev/null && ASAN_OPTIONS=detect_leaks=0 "$work/sane" || SANE=
    ASAN_OPTIONS=detect_leaks=1:exitcode=86 "$work/sane" >/dev/null 2>&1
    [ $? -eq 86 ] && leaks=1 || leaks=0
}

# alone: a tree has one original, so its commands wait for each other.
alone() {
    mkdir -p "$work"
    [ ! -d "$work/lock" ] ||
        say "Another course command works in this tree. This one waits. (If there is none: rmdir $work/lock)" >&2
    until mkdir "$work/lock" 2>/dev/null; do sleep 1; done
    trap 'rmdir "$work/lock"' EXIT
    trap 'exit 130' INT TERM HUP PIPE
}

# original: a copy of all that is needed, built. Others are copies of it, and compared with it. It lies in a directory
# of any name, which only $work/where tells: what a student hands in must not run it by its usual place. What is kept of
# other programs than it now has, how long they take and what they draw, goes.
original() {
    [ -z "$original" ] || return 0
    alone
    sanitizers
    home=$(cat "$work/where" 2>/dev/null)
    if [ ! -d "${home:-/none}/kept" ]; then
        home=$(mktemp -d "${TMPDIR:-/tmp}/XXXXXXXXXX") && mkdir "$home/kept" "$home/tree" || exit
        echo "$home" >"$work/where"
        say "Building the original (half a minute or more, the first time) ..."
    fi
    original=$home/tree kept=$home/kept
    (cd "$original" && rm -rf src test scenes ref doc) # what is no longer in the tree
    cp -Rp Makefile src test scenes ref doc "$original/" && build "$original" asbdpt-lab build/test ||
        die "the original does not build"
    now=$(cksum "$original/asbdpt-lab" "$original/build/test")
    [ "$now" = "$(cat "$kept/of" 2>/dev/null)" ] || { rm -rf "$kept"/* && say "$now" >"$kept/of"; }
}

# hollow FILE FUNCTION STUB PAGE: the file, with nothing but STUB in that function's body.
hollow() {
    awk -v name="$2" -v stub="$3" -v page="$4" '
        !held && $0 ~ "^[a-z].*[ *]" name "\\(" && !/;$/ { held = 1; n++ }
        held == 1 && /^[{]/ { print "{\n    /* Yours to write: " page " */\n    " stub; held = 2 }
        held == 2 && /^[}]/ { held = 0 }
        held < 2
        END { exit n != 1 }' "$1"
}

# dig N TREE: take out of the tree's files what assignment N is to write.
dig() {
    get "$1" hole | while read -r file function stub; do
        hollow "$2/$file" "$function" "$stub" "doc/course/$1.md" >"$2/hollow" && cat "$2/hollow" >"$2/$file" || exit
        rm "$2/hollow"
    done || die "assignment $1: a function is not in its file, or twice"
}

# ---- commands ----
start() {
    [ ! -e "$2" ] || die "$2 is there already: remove it, or name another folder"
    original
    mkdir -p "$(dirname "$2")" && cp -Rp "$original" "$2" && dig "$1" "$2" && say "$1 $PWD" >"$2/.course" || exit
    say "$(get "$1" title). Read doc/course/$1.md. Yours to write in $2:"
    get "$1" hole | sed 's/^\([^ ]*\) \([^ ]*\).*/    \1: \2/'
    say "Then, in that folder: sh test/run/course.sh grade"
}

grade() {
    [ -d "$2/src" ] || die "there is no $2: sh test/run/course.sh start ${1%%-*} $2"
    [ ! -f "$2/.course" ] || grep -q "^$1 " "$2/.course" || die "$2 is not a copy for assignment $1"
    original
    set -- "$1" "$(cd "$2" && pwd)"
    rm -rf "$2/report" && mkdir "$2/report" || exit
    {
        guard
        say "Building $2 ..."
        soon "$1" "$2" && build "$2" build/test && answer "$1" "$2" "$(get "$1" tests)" &&
            say "All is well: the first part is done. The page doc/course/$1.md has a second." &&
            touch "$2/report/passed"
    } | tee "$2/report/report.txt"
    page "$2/report" "$(get "$1" title)"
    [ -f "$2/report/passed" ]
}

exercise() {
    [ -n "$(get "$1" answer)" ] || die "no exercise has the mutant '$1': sh test/run/course.sh list"
    original
    tree=$work/$1
    rm -rf "$tree" && cp -Rp "$original" "$tree" && mkdir "$tree/report" || exit
    sh test/data/mutants/apply.sh test/data/mutants/list.txt "$1" "$tree" || exit
    fault=$(awk -v name="$1" '!/^[-+]/ { here = $1 == name } here' test/data/mutants/list.txt)
    {
        guard
        say "$fault" | awk 'NR == 1 { file = $2; $1 = $2 = $3 = ""; sub(/ */, ""); $0 = "In " file ": " $0 } { print }'
        build "$tree" asbdpt-lab build/test &&
            answer "$1" "$tree" "$(say "$fault" | awk 'NR == 1 { gsub(/,|mini/, " ", $3); print $3 }')"
        say "" "Is it biased, how much, and where would one see it?" "$(get "$1" answer)"
    } | tee "$tree/report/report.txt"
    page "$tree/report" "$1" && rm -rf "$tree/build"
}

# variant NUMBER: the same for the same number, and different for neighbours.
variant() {
    case $1 in '' | *[!0-9]*) die "variant NUMBER" ;; esac
    awk -v number="$1" '$1 == "assignment" { part_of = substr($2, 1, 1) }
    $1 == "second" {
        sub(/^ *second /, part_of ": ")
        n_second++
        while (match($0, /[{][^}]*[}]/)) {
            n = split(substr($0, RSTART + 1, RLENGTH - 2), part, ";")
            choice = part[(number + n_second + 1) % n + 1]
            $0 = substr($0, 1, RSTART - 1) choice substr($0, RSTART + RLENGTH)
        }
        print
    }' $list
}

. test/course/judge.sh
case ${1-} in
start | grade) name=$(names assignment | awk -v word="${2:-none}" '$0 == word || index($0, word "-") == 1')
    [ -n "$name" ] || die "the assignments are $(names assignment | tr '\n' ' ')"
    "$1" "$name" "${3:-../asbdpt-course/$2}" ;;
exercise) exercise "${2-}" ;;
variant) variant "${2-}" ;;
grade-all) . test/course/grade_all.sh && grade_all "${2:?"grade-all DIR [-j N]"}" "${4:-1}" ;;
check | prove) . test/course/check.sh && "$1" "${2-}" ;;
list) for name in $(names assignment); do say "$name: $(get "$name" title)"; done; names exercise ;;
*) sed -n '2,12s/^# \{0,1\}//p' "$0"; exit 2 ;;
esac

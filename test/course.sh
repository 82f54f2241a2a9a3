#!/bin/sh
# course.sh: assignments that build, and exercises that answer (doc/course/README.md).
#   sh test/course.sh list                 the assignments, and the mutants of the tour's exercises
#   sh test/course.sh start N [DIR]        a copy of the tree without the functions of assignment N
#   sh test/course.sh grade N [DIR]        build the copy, run its tests, measure, and explain what is still wrong
#   sh test/course.sh exercise MUTANT      what the fault of an exercise does: pictures, the mean, tests, reasoning
#   sh test/course.sh variant NUMBER       what the second parts ask of the student of that number
#   sh test/course.sh grade-all DIR [-j N] grade every folder of DIR, a student's files each: DIR/grades.csv
#   sh test/course.sh check                does every hole apply, has every exercise an answer? (seconds)
#   sh test/course.sh prove [N | PLANT]    is every hole, and every planted mistake, found and named? (half an hour)
# DIR is ../asbdpt-course/N if none is named. What is known of an assignment or exercise is in test/course/list.txt.
set -u
list=test/course/list.txt
work=$PWD/build-course
original= kept= # the original, where a student's program does not find it by chance, and its pictures: see original
watch=$(command -v timeout || command -v gtimeout) # ends a whole process group; else only CPU time is limited
SANE="-g -fsanitize=address,undefined -fno-sanitize-recover=undefined" # for what is changed

say() { printf '%s\n' "$@"; }
die() { say "course: $*" >&2; exit 2; }

# get NAME KEY: what the entry says under that key, a line for each time. names KIND: all entries of a kind.
get() {
    awk -v n="$1" -v key="$2" '/^[ae]/ { here = $2 == n } here && $1 == key { sub(/^ *[a-z]+ */, ""); print }' $list
}
names() { awk -v kind="$1" '$1 == kind { print $2 }' $list; }
fault() { awk -v name="$1" '!/^[-+]/ { here = $1 == name } here' test/mutants/list.txt; }

# ---- copies of the tree ----
# build TREE [TARGET]: a dot for each file, and what the compiler says. -O1: it is the compiler one waits for here. What
# is changed in a copy is built with sanitizers: they say the line in which an index leaves its array.
build() {
    extra="-Wno-unused-parameter -Wno-unused-function"
    [ "$1" = "$original" ] || extra="$extra $SANE"
    (cd "$1" && MAKEFLAGS='' ${MAKE:-make} -s -j2 CC="${CC:-cc}" BUILD=build LTO= OPT=-O1 CFLAGS="$extra" \
        ${2-asbdpt-lab build/test} 2>&1 || echo "no build") |
        awk '/^  (build|asbdpt)/ { printf "."; dots++; next } /^no build$/ { bad = 1; next } { print }
            END { if (dots) print ""; exit bad }'
}

# sanitizers: none in $SANE if no program with them can be made and run here; $leaks: 1 if they see lost memory.
sanitizers() {
    echo '#include <stdlib.h>
        int main(int n, char **word) { char *lost = malloc(n); lost[0] = word[0][0]; return lost = NULL, !n; }' \
        >$work/sane.c
    ${CC:-cc} $SANE -o $work/sane $work/sane.c 2>/dev/null && ASAN_OPTIONS=detect_leaks=0 $work/sane || SANE=
    ASAN_OPTIONS=detect_leaks=1:exitcode=86 $work/sane >/dev/null 2>&1
    [ $? -eq 86 ] && leaks=1 || leaks=0
}

# alone: a tree has one original, so its commands wait for each other.
alone() {
    mkdir -p $work
    [ ! -d $work/lock ] ||
        say "Another course command works in this tree. This one waits. (If there is none: rmdir $work/lock)" >&2
    until mkdir $work/lock 2>/dev/null; do sleep 1; done
    trap 'rmdir $work/lock' EXIT
    trap 'exit 130' INT TERM HUP
}

# original: a copy of all that is needed, built. Others are copies of it, and compared with it. It lies in a directory
# of any name, which only $work/where tells: what a student hands in must not run it by its usual place.
original() {
    [ -z "$original" ] || return 0
    alone
    sanitizers
    home=$(cat $work/where 2>/dev/null)
    if [ ! -d "${home:-/none}/kept" ]; then
        home=$(mktemp -d "${TMPDIR:-/tmp}/XXXXXXXXXX") && mkdir "$home/kept" "$home/tree" || exit
        echo "$home" >$work/where
        say "Building the original (half a minute or more, the first time) ..."
    fi
    original=$home/tree kept=$home/kept
    (cd "$original" && rm -rf src test scenes ref doc) # what is no longer in the tree
    cp -Rp Makefile src test scenes ref doc "$original/" && build "$original" || die "the original does not build"
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

# ---- programs that may not end ----
# run SECONDS TREE OUT COMMAND...: in that tree, with so much CPU time. It and all it starts end when this does. It is
# told nothing of where else this works.
away=$(unshare -rn true 2>/dev/null && echo "unshare -rn") # no network, where that is possible
[ -n "${GRADER-}" ] && away="setpriv --reuid=$GRADER --clear-groups $away"
guard() {
    child=
    trap '[ -n "$child" ] && kill "$child" 2>/dev/null' EXIT
    trap 'exit 130' INT TERM HUP
}
run() {
    wall=$((20 * $1 + 60)) # where it does not compute but waits
    (ulimit -t "$1" && cd "$2" && shift 3 && exec env -i PATH="$PATH" TMPDIR="${TMPDIR:-/tmp}" \
        ASAN_OPTIONS=detect_leaks=$leaks:exitcode=86 UBSAN_OPTIONS=print_stacktrace=1:exitcode=86 \
        ${watch:+$watch -k 2 $wall} $away "$@") >"$3" 2>&1 &
    child=$!
    { wait $child; } 2>/dev/null # no "Killed": told says it
    status=$?
    child=
    return $status
}

# cost FILE COMMAND...: CPU seconds, rounded up, that the original takes; asked once, and kept in FILE.
cost() {
    file=$1
    shift
    [ -s "$file" ] || (cd "$original" && "$@" >/dev/null 2>&1
        spent "$file")
    cat "$file"
}

# spent FILE: CPU seconds, rounded up, of all that this shell has waited for. (No pipe: its shell waited for nothing.)
spent() {
    times >"$1.times"
    awk 'NR == 2 { for (i = 1; i <= 2; i++) { split($i, t, /[ms]/); sum += 60 * t[1] + t[2] }; print int(sum) + 1 }' \
        "$1.times" >"$1"
}

# told STATUS: what it means, for people.
told() {
    case $1 in
    124 | 137 | 152) say "It is too slow, or endless: stopped after ten times the original's time." ;;
    86) say "It reads, writes, keeps or computes what it must not:" ;;
    132 | 134) say "It stopped itself (an assertion, or memory that was damaged before):" ;;
    136) say "It divides a whole number by zero." ;;
    138 | 139) say "It crashes: an index or a pointer leads outside." ;;
    127) say "It cannot be started." ;;
    none) say "It ends well, but before the test has come to its end." ;;
    *) say "It ends with status $1:" ;;
    esac
}

# place NAME TREE LOG: the first line of the student's files that the log names, and what stands there.
place() {
    for file in $(get "$1" hole | sed 's/ .*//' | sort -u); do
        line=$(grep -o "${file#src/}:[0-9]*" "$3" | head -n 1 | sed 's/.*://')
        [ -n "$line" ] && say "    $file, line $line: $(sed -n "${line}s/^ *//p" "$2/$file")" && break
    done
    grep -oE 'runtime error: .*|ERROR: AddressSanitizer: [A-Za-z-]*|ERROR: LeakSanitizer: [a-z ]*' "$3" | head -n 1 |
        sed 's/^[^:]*: //; s/^/    /'
}

# ---- what differs ----
# shot TREE SEED OUT: a picture of the view, by the program of that tree.
shot() {
    case $view in
    mini*) set -- "$1" "$3" ./mini "${view#mini }" 4 "$3" "$2" ;;
    *) set -- "$1" "$3" ./asbdpt-lab render $view --quiet --seed "$2" -o "$3" ;; # the words of the view are arguments
    esac
    tree=$1 out=$2
    shift 2
    run "${pictures_cost:-600}" "$tree" "$out.said" "$@"
}

# noise SIDE...: the root mean square difference of two pictures of one side, NAME-1.pfm ..., over four pairs.
noise() {
    for pair in "1 2" "3 4" "5 6" "7 8"; do
        "$original/asbdpt-lab" compare "$1-${pair% *}.pfm" "$1-${pair#* }.pfm"
    done | awk '$1 == "rmse" { sum += $2 * $2 } END { print sqrt(sum / 4) }'
}

# pictures N: the first N of the original, made once, in $shots; how long one may take goes to $pictures_cost.
pictures() {
    shots=$kept/$(echo "$view" | tr ' /' '__')
    mkdir -p "$shots"
    if [ ! -s "$shots/cost" ]; then
        pictures_cost=
        (shot "$original" 1 "$shots/before.pfm"; spent "$shots/cost") # of the same seed: the change, not noise
    fi
    pictures_cost=$((10 * $(cat "$shots/cost") + 5))
    for k in $(seq "$1"); do
        [ -s "$shots/original-$k.pfm" ] || shot "$original" "1$k" "$shots/original-$k.pfm" || return
    done
}

# verdict DIR N: of N pictures of each side. Status 0: they agree; 3: more pictures may tell.
verdict() {
    "$original/asbdpt-lab" verify doc/mini/rooms.pbrt --tile 8 --quiet --files $(seq -f "$1/yours-%g.pfm" "$2") \
        --against $(seq -f "$shots/original-%g.pfm" "$2") >"$1/verify.txt" 2>&1
    awk -v before="$(noise "$shots/original")" -v after="$(noise "$1/yours")" '
        /^ratio of the means/ { ratio = $5; error = $7 }
        /^p, smallest/ { place = $0; sub(/^.*tile/, "tile", place) }
        /^verdict:/ { verdict = $2; p = $5 }
        END {
            off = error > 0 ? (ratio - 1) / error : 0
            doubtful = verdict == "agree" && (p < 0.02 || off * off > 6)
            printf "\nMean: %s +- %s of the original, p = %s; ", ratio, error, p
            if (verdict == "") print "the pictures cannot be compared."
            else if (doubtful) print "that happens once in fifty times by chance, so this is uncertain."
            else if (verdict == "agree") print "no difference in expectation is seen."
            else if (ratio + 0 == 0 || off < -4) printf "too dark by %.1f %%.\n", 100 * (1 - ratio)
            else if (off > 4) printf "too bright by %.1f %%.\n", 100 * (ratio - 1)
            else print "nearly right as a whole, but not everywhere: see the " place "."
            if (before > 0) printf "Noise: %.2f times that of the original.\n", after / before
            exit doubtful ? 3 : verdict != "agree" }' "$1/verify.txt"
}

# measure NAME TREE DIR: pictures of the original and of TREE, and in words how they differ: of eight pictures, and of
# more where eight leave it uncertain. Status 0: they agree.
measure() {
    view=$(get "$1" view)
    [ -n "$view" ] || return 0 # nothing to be seen
    case $view in
    mini*) for tree in "$original" "$2"; do
            ${CC:-cc} -std=c99 -O2 -o "$tree/mini" "$tree/doc/mini/asbdpt.c" -lm || return
        done ;;
    *) build "$2" asbdpt-lab || return ;;
    esac
    printf 'Rendering %s:' "$view"
    for n in 8 24 64; do
        pictures $n || { say "The original does not render."; return 1; }
        for k in $(seq $n); do
            [ -s "$3/yours-$k.pfm" ] && continue
            printf ' %s' "$k"
            shot "$2" "$k" "$3/yours-$k.pfm" && continue
            say "" "$(told $status)" "$(place "$1" "$2" "$3/yours-$k.pfm.said")" "$(head -n 2 "$3/yours-$k.pfm.said")"
            return 1
        done
        verdict "$3" $n && differ=0 || differ=$?
        [ $differ -eq 3 ] || break
    done
    "$original/asbdpt-lab" compare "$3/yours-1.pfm" "$shots/before.pfm" --heatmap "$3/difference.png" >/dev/null
    "$original/asbdpt-lab" convert "$shots/before.pfm" -o "$3/original.png" >/dev/null 2>&1
    "$original/asbdpt-lab" convert "$3/yours-1.pfm" -o "$3/changed.png" >/dev/null 2>&1
    return $differ
}

# kinds: of lines that differ in numbers alone the first; a test may fail a million times in few ways.
kinds() { awk '{ kind = $0; gsub(/[-+0-9.]+(e[-+0-9]+)?/, "#", kind) } !seen[kind]++ && ++n <= 50'; }

# suites NAME TREE DIR LIST: tests of the tree, up to the first that fails, and what that means. Status 0: all pass;
# else $failed is that test, and $3/failed.txt what it says. A test of ours has passed if its last line is the number
# that it was given: a program that only ends well has not been tested.
suites() {
    failed=
    for suite in $4; do
        printf 'Test %s ... ' "$suite"
        number=$(awk -v more=$$ 'BEGIN { srand(); printf "%d%06d%d", more, 1e6 * rand(), 1e6 * rand() }')
        command="build/test --last $number $suite"
        [ -f "$2/test/$suite.sh" ] && number= command="sh test/$suite.sh ./asbdpt" && build "$2" asbdpt
        (cd "$original" && [ ! -f "test/$suite.sh" ] || build . asbdpt) >/dev/null
        run $((10 * $(cost "$kept/$suite.cost" $command) + 5)) "$2" "$3/$suite.txt" $command
        if [ $status -eq 0 ]; then
            [ -z "$number" ] || [ "$(tail -n 1 "$3/$suite.txt")" = "$number" ] && say "passed" && continue
            status=none
        fi
        failed=$suite
        grep -E 'FAIL|^ *p = ' "$3/$suite.txt" | kinds >"$3/failed.txt"
        say "FAILED."
        if [ $status != 1 ] || [ ! -s "$3/failed.txt" ]; then
            { told $status; place "$1" "$2" "$3/$suite.txt"; } | tee -a "$3/failed.txt"
        fi
        grep -E '^ *(FAIL|p = )' "$3/failed.txt" | head -n 3 | sed 's/^\(.\{150\}\).*/\1 .../; s/^ */    /'
        get "$1" "$suite"
        return 1
    done
}

# hints NAME CHECK FILE: what to think of if CHECK (a test, or "picture") fails and says what is in FILE: the hints
# whose pattern is there; if there is none, the check that failed, and those without a pattern.
hints() {
    say "" "What to think of:"
    get "$1" hint | awk -v check="$2" -v said="$3" '
        BEGIN { while ((getline line < said) > 0) { text = text line "\n"; if (first == "") first = line } }
        { split($1, wanted, "/"); if (wanted[1] != check) next }
        {
            step = $2
            sub(/^[^ ]+ [^ ]+ /, "")
            line = "- Step " step ": " $0
            if (wanted[2] != "") { if (match(text, wanted[2])) special = special line "\n" }
            else general = general line "\n"
        }
        END {
            sub(/^.*FAIL [^ ]* /, "", first)
            printf "%s", special != "" ? special : "No step is sure. " first "\nIt may be one of these:\n" general
        }'
}

# answer NAME TREE TESTS: test and measure a built tree. Status 0: all is well; else the hints, then the picture. What
# crashes or never ends draws nothing.
answer() {
    : >"$2/report/failed.txt"
    if suites "$1" "$2" "$2/report" "$3"; then
        measure "$1" "$2" "$2/report" && return
        hints "$1" picture /dev/null
    else
        hints "$1" "$failed" "$2/report/failed.txt"
        [ -n "${QUICK-}" ] || [ $status != 1 ] || { say "" "And the picture:"; measure "$1" "$2" "$2/report"; }
    fi
    return 1
}

# page DIR TITLE: DIR/index.html has the pictures and the words of DIR/report.txt.
page() {
    {
        say "<!doctype html><meta charset=utf-8><meta name=viewport content='width=device-width'><title>$2</title>"
        say "<style>body{max-width:60em;margin:auto;padding:1em;font-family:serif;color-scheme:light dark}"
        say "figure{display:inline-block;margin:0 1em 1em 0}img{width:17em;image-rendering:pixelated}"
        say "pre{white-space:pre-wrap;overflow-wrap:anywhere}</style><h1>$2</h1>"
        for picture in original changed difference; do
            [ -f "$1/$picture.png" ] && say "<figure><img src=$picture.png><figcaption>$picture</figcaption></figure>"
        done
        say "<pre>" "$(sed 's/&/\&amp;/g; s/</\&lt;/g' "$1/report.txt")" "</pre>"
    } >"$1/index.html"
    say "Pictures and words: $1/index.html"
}

# ---- commands ----
start() {
    [ ! -e "$2" ] || die "$2 is there already: remove it, or name another folder"
    original
    mkdir -p "$(dirname "$2")" && cp -Rp "$original" "$2" && dig "$1" "$2" || exit
    say "$(get "$1" title). Read doc/course/$1.md. Yours to write in $2:"
    get "$1" hole | sed 's/^\([^ ]*\) \([^ ]*\).*/    \1: \2/'
    say "Then: sh test/course.sh grade ${1%%-*} $2"
}

grade() {
    [ -d "$2/src" ] || die "there is no $2: sh test/course.sh start ${1%%-*} $2"
    original
    set -- "$1" "$(cd "$2" && pwd)"
    rm -rf "$2/report" && mkdir "$2/report" || exit
    {
        guard
        say "Building $2 ..."
        if ! build "$2" build/test; then
            say "It does not compile yet."
        elif answer "$1" "$2" "$(get "$1" tests)"; then
            say "All is well: the first part is done. The page doc/course/$1.md has a second."
            touch "$2/report/passed"
        fi
    } | tee "$2/report/report.txt"
    page "$2/report" "$(get "$1" title)"
    [ -f "$2/report/passed" ]
}

exercise() {
    [ -n "$(get "$1" answer)" ] || die "no exercise has the mutant '$1': sh test/course.sh list"
    original
    tree=$work/$1
    rm -rf "$tree" && cp -Rp "$original" "$tree" && mkdir "$tree/report" || exit
    sh test/mutants/apply.sh test/mutants/list.txt "$1" "$tree" || exit
    {
        guard
        fault "$1" | awk 'NR == 1 { file = $2; $1 = $2 = $3 = ""; sub(/ */, ""); $0 = "In " file ": " $0 } { print }'
        build "$tree" && answer "$1" "$tree" "$(fault "$1" | awk 'NR == 1 { gsub(/,/, " ", $3); print $3 }')"
        say "" "Is it biased, how much, and where would one see it?" "$(get "$1" answer)"
    } | tee "$tree/report/report.txt"
    page "$tree/report" "$1" && rm -rf "$tree/build"
}

# variant NUMBER: the same for the same number, and different for neighbours.
variant() {
    case $1 in '' | *[!0-9]*) die "variant NUMBER" ;; esac
    awk -v number="$1" '!/^#/ {
        while (match($0, /[{][^}]*[}]/)) {
            n = split(substr($0, RSTART + 1, RLENGTH - 2), part, ";")
            choice = part[(number + NR) % n + 1]
            $0 = substr($0, 1, RSTART - 1) choice substr($0, RSTART + RLENGTH)
        }
        print
    }' test/course/variants.txt
}

case ${1-} in
start | grade) name=$(names assignment | awk -v word="${2:-none}" '$0 == word || index($0, word "-") == 1')
    [ -n "$name" ] || die "the assignments are $(names assignment | tr '\n' ' ')"
    "$1" "$name" "${3:-../asbdpt-course/$2}" ;;
exercise) exercise "${2-}" ;;
variant) variant "${2-}" ;;
grade-all) . test/course/grade_all.sh && grade_all "${2:?"grade-all DIR [-j N]"}" "${4:-1}" ;;
check | prove) . test/course/check.sh && "$1" "${2-}" ;;
list) for name in $(names assignment); do say "$name: $(get "$name" title)"; done; names exercise ;;
*) sed -n '2,11s/^# \{0,1\}//p' "$0"; exit 2 ;;
esac

#!/bin/sh
# course.sh: assignments that build, and exercises that answer (doc/course/README.md).
#   sh test/course.sh list                 the assignments, and the mutants of the tour's exercises
#   sh test/course.sh start N [DIR]        a copy of the tree without the functions of assignment N
#   sh test/course.sh grade N [DIR]        build the copy, run its tests, measure, and explain what is still wrong
#   sh test/course.sh exercise MUTANT      what the fault of an exercise does: pictures, the mean, tests, reasoning
#   sh test/course.sh check                does every hole apply, has every exercise an answer? (seconds)
#   sh test/course.sh prove                does every assignment fail with its hole and pass without? (minutes)
# DIR is ../asbdpt-course/N if none is named. What is known of an assignment or exercise is in test/course/list.txt.
set -u
list=test/course/list.txt
work=build-course
SEEDS="1 2 3 4 5 6 7 8" # pictures of each side that are compared
limit=$(command -v timeout || command -v gtimeout) && limit="$limit 600" # seconds; else there is none

say() { printf '%s\n' "$@"; }
die() { say "course: $*" >&2; exit 2; }

# get NAME KEY: what the entry says under that key, a line for each time. names KIND: all entries of a kind.
get() {
    awk -v n="$1" -v key="$2" '/^[ae]/ { here = $2 == n } here && $1 == key { sub(/^ *[a-z]+ */, ""); print }' $list
}
names() { awk -v kind="$1" '$1 == kind { print $2 }' $list; }
fault() { awk -v name="$1" '!/^[-+]/ { here = $1 == name } here' test/mutants/list.txt; }

# ---- copies of the tree ----
# build TREE [TARGET]: a dot for each file, and what the compiler says. -O1: it is the compiler one waits for here.
build() {
    (cd "$1" && MAKEFLAGS='' ${MAKE:-make} -s -j2 CC="${CC:-cc}" BUILD=build LTO= OPT=-O1 \
        CFLAGS='-Wno-unused-parameter -Wno-unused-function' ${2-asbdpt-lab build/test} 2>&1 || echo "no build") |
        awk '/^  (build|asbdpt)/ { printf "."; dots++; next } /^no build$/ { bad = 1; next } { print }
            END { if (dots) print ""; exit bad }'
}

# original: a copy of all that is needed, built. Others are copies of it, and compared with it.
original() {
    [ -d $work/original ] || say "Building the original in $work (half a minute or more, the first time) ..."
    mkdir -p $work/original && (cd $work/original && rm -rf src test scenes ref doc) # what is no longer in the tree
    cp -Rp Makefile src test scenes ref doc $work/original/ && build $work/original || die "the original does not build"
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

# ---- what differs ----
# shot TREE SEED OUT: a picture of the view, by the program of that tree.
shot() {
    case $view in
    mini*) $limit "$1/mini" "${view#mini }" 4 "$3" "$2" ;;
    *) $limit "$1/asbdpt-lab" render $view --quiet --seed "$2" -o "$3" ;; # the words of the view are arguments
    esac
}

# noise DIR SIDE: the root mean square difference of two pictures of one side, over four pairs.
noise() {
    for pair in "1 2" "3 4" "5 6" "7 8"; do
        $work/original/asbdpt-lab compare "$1/$2-${pair% *}.pfm" "$1/$2-${pair#* }.pfm"
    done | awk '$1 == "rmse" { sum += $2 * $2 } END { print sqrt(sum / 4) }'
}

# measure NAME TREE DIR: pictures of the original and of TREE, and in words how they differ. Status 0: they agree.
measure() {
    view=$(get "$1" view)
    [ -n "$view" ] || return 0 # nothing to be seen
    case $view in
    mini*) for tree in $work/original "$2"; do
            ${CC:-cc} -std=c99 -O2 -o "$tree/mini" "$tree/doc/mini/asbdpt.c" -lm || return
        done ;;
    esac
    printf 'Rendering %s, original and changed:' "$view"
    for k in $SEEDS; do
        printf ' %s' "$k"
        shot $work/original "1$k" "$3/original-$k.pfm" && shot "$2" "$k" "$3/yours-$k.pfm" ||
            { say "" "The changed program does not render (status $?)."; return 1; }
    done
    shot $work/original 1 "$3/before.pfm" # of the same seed: what differs is the change, and little of it noise
    $work/original/asbdpt-lab compare "$3/yours-1.pfm" "$3/before.pfm" --heatmap "$3/difference.png" >/dev/null
    $work/original/asbdpt-lab convert "$3/before.pfm" -o "$3/original.png"
    $work/original/asbdpt-lab convert "$3/yours-1.pfm" -o "$3/changed.png"
    $work/original/asbdpt-lab verify doc/mini/rooms.pbrt --tile 8 --quiet \
        --files "$3"/yours-*.pfm --against "$3"/original-*.pfm >"$3/verify.txt" 2>&1
    awk -v before="$(noise "$3" original)" -v after="$(noise "$3" yours)" '
        /^ratio of the means/ { ratio = $5; error = $7 }
        /^p, smallest/ { place = $0; sub(/^.*tile/, "tile", place) }
        /^verdict:/ { verdict = $2 }
        END {
            printf "\nMean: %s +- %s of the original; ", ratio, error
            if (verdict == "") print "the pictures cannot be compared."
            else if (verdict == "agree") print "no difference in expectation is seen."
            else if (ratio > 1 + 4 * error) printf "too bright by %.1f %%.\n", 100 * (ratio - 1)
            else if (ratio + 0 == 0 || ratio < 1 - 4 * error) printf "too dark by %.1f %%.\n", 100 * (1 - ratio)
            else print "nearly right as a whole, but not everywhere: see the " place "."
            if (before > 0) printf "Noise: %.2f times that of the original.\n", after / before
            exit verdict != "agree" }' "$3/verify.txt"
}

# suites NAME TREE DIR LIST: tests of the tree, up to the first that fails, and what that means. Status 0: all pass.
suites() {
    for suite in $4; do
        printf 'Test %s ... ' "$suite"
        command="build/test $suite"
        [ -f "$2/test/$suite.sh" ] && command="sh test/$suite.sh ./asbdpt" && build "$2" asbdpt
        (cd "$2" && $limit $command) >"$3/$suite.txt" 2>&1 && say "passed" && continue
        say "FAILED:"
        grep -E 'FAIL|^ *p = ' "$3/$suite.txt" | head -n 3 | sed 's/^\(.\{150\}\).*/\1 .../; s/^ */    /'
        get "$1" "$suite"
        return 1
    done
}

# answer NAME TREE TESTS: measure and test a built tree. Status 0: all is well.
answer() {
    measure "$1" "$2" "$2/report"
    agree=$?
    suites "$1" "$2" "$2/report" "$3" && [ $agree -eq 0 ]
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
    mkdir -p "$(dirname "$2")" && cp -Rp $work/original "$2" && dig "$1" "$2" || exit
    say "$(get "$1" title). Read doc/course/$1.md. Yours to write in $2:"
    get "$1" hole | sed 's/^\([^ ]*\) \([^ ]*\).*/    \1: \2/'
    say "Then: sh test/course.sh grade ${1%%-*} $2"
}

grade() {
    [ -d "$2/src" ] || die "there is no $2: sh test/course.sh start ${1%%-*} $2"
    original
    rm -rf "$2/report" && mkdir "$2/report" || exit
    {
        say "Building $2 ..."
        if ! build "$2"; then
            say "It does not compile yet."
        elif answer "$1" "$2" "$(get "$1" tests)"; then
            say "All is well: the first part is done. The page doc/course/$1.md has a second."
            touch "$2/report/passed"
        else
            say "" "What to think of:"
            get "$1" hint | sed 's/^/- /'
        fi
    } | tee "$2/report/report.txt"
    page "$2/report" "$(get "$1" title)"
    [ -f "$2/report/passed" ]
}

exercise() {
    [ -n "$(get "$1" answer)" ] || die "no exercise has the mutant '$1': sh test/course.sh list"
    original
    tree=$work/$1
    rm -rf "$tree" && cp -Rp $work/original "$tree" && mkdir "$tree/report" || exit
    sh test/mutants/apply.sh test/mutants/list.txt "$1" "$tree" || exit
    {
        fault "$1" | awk 'NR == 1 { file = $2; $1 = $2 = $3 = ""; sub(/ */, ""); $0 = "In " file ": " $0 } { print }'
        build "$tree" && answer "$1" "$tree" "$(fault "$1" | awk 'NR == 1 { gsub(/,/, " ", $3); print $3 }')"
        say "" "Is it biased, how much, and where would one see it?" "$(get "$1" answer)"
    } | tee "$tree/report/report.txt"
    page "$tree/report" "$1" && rm -rf "$tree/build"
}

case ${1-} in
start | grade) name=$(names assignment | awk -v word="${2:-none}" '$0 == word || index($0, word "-") == 1')
    [ -n "$name" ] || die "the assignments are $(names assignment | tr '\n' ' ')"
    "$1" "$name" "${3:-../asbdpt-course/$2}" ;;
exercise) exercise "${2-}" ;;
check | prove) . test/course/check.sh && "$1" ;;
list) for name in $(names assignment); do say "$name: $(get "$name" title)"; done; names exercise ;;
*) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 2 ;;
esac

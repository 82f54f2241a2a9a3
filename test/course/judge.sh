# judge.sh: how a copy of the tree is judged: how it runs, how it differs from the original, and what to think of. Read
# by course.sh.

# ---- programs that may not end ----
# run SECONDS TREE OUT COMMAND...: in that tree, with so much CPU time. It and all it starts end when this does. It is
# told nothing of where else this works.
watch=$(command -v timeout || command -v gtimeout) # ends a whole process group; else only CPU time is limited
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
    [ -s "$file" ] || (cd "$original" && "$@" >/dev/null 2>&1 && spent "$file") || die "the original fails: $*"
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
    for file in $(files "$1"); do
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
        (shot "$original" 1 "$shots/before.pfm" && spent "$shots/cost") || return # the seed of "yours-1"
    fi
    pictures_cost=$((10 * $(cat "$shots/cost") + 5))
    for k in $(seq "$1"); do
        [ -s "$shots/original-$k.pfm" ] || shot "$original" $((1000 + k)) "$shots/original-$k.pfm" || return
    done
}

# verdict DIR N: of N pictures of each side. Status 0: they agree; 3: more pictures may tell.
verdict() {
    into=$1 n_pictures=$2
    set -- --files
    for k in $(seq "$n_pictures"); do set -- "$@" "$into/yours-$k.pfm"; done
    set -- "$@" --against
    for k in $(seq "$n_pictures"); do set -- "$@" "$shots/original-$k.pfm"; done
    "$original/asbdpt-lab" verify doc/mini/rooms.pbrt --tile 8 --quiet "$@" >"$into/verify.txt" 2>&1
    awk -v before="$(noise "$shots/original")" -v after="$(noise "$into/yours")" '
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
            exit doubtful ? 3 : verdict != "agree" }' "$into/verify.txt"
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
        number=$(od -An -N 7 -t u1 /dev/urandom | tr -d ' ')
        seconds=$(cost "$kept/$suite.cost" build/test "$suite") || exit
        run $((10 * seconds + 5)) "$2" "$3/$suite.txt" build/test --last "$number" "$suite"
        if [ $status -eq 0 ]; then
            [ "$(tail -n 1 "$3/$suite.txt")" = "$number" ] && say "passed" && continue
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
    [ -n "$(get "$1" hint)" ] || return 0 # an exercise has an answer instead
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
            if (special == "") print "No step is sure. " first
            printf "%s", special != "" ? special : general != "" ? "It may be one of these:\n" general : ""
        }'
}

# soon NAME TREE: the word of one suite, before half of the program, which includes a header of the student's, is built
# again: only the objects that this suite is about are. Status 0: it passes, or the assignment has none.
soon() {
    get "$1" early | while read -r suite header objects; do
        (cd "$2" && rm -f $objects)
        build "$2" build/test -o "$header" || exit
        suites "$1" "$2" "$2/report" "$suite" && continue
        hints "$1" "$suite" "$2/report/failed.txt"
        exit 1
    done
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

# page DIR TITLE: DIR/index.html has the pictures and the words of DIR/report.txt, in the style of all other reports.
page() {
    style=$(sed -n '/^static const char \*const PAGE_STYLE/,/NULL/s/^    "\(.*\)",$/\1/p' "$original/test/lab/page.c")
    [ -n "$style" ] || die "test/lab/page.c has no style"
    {
        say "<!DOCTYPE html><html lang=\"en\"><meta charset=\"utf-8\">" \
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>$2</title>" \
            "<style>" "$style" "</style>" "<h1>$2</h1>" "<div class=\"three\">"
        for picture in original changed difference; do
            [ -f "$1/$picture.png" ] && say "<figure><img src=\"$picture.png\"><figcaption>$picture</figcaption></figure>"
        done
        say "</div>" "<pre>" "$(sed 's/&/\&amp;/g; s/</\&lt;/g' "$1/report.txt")" "</pre>"
    } >"$1/index.html"
    say "Pictures and words: $1/index.html"
}

#!/bin/sh
# evidence.sh: the measured numbers of the documents, from one list, doc/measured/list.txt, whose head says how an
# entry is written. Run from the top.
#   sh test/measure/evidence.sh list           what there is, of which estimator, and what is old or missing
#   sh test/measure/evidence.sh run [NAME...]  measure, store and show (no names: all that is old or missing and can be
#                                              made); one that was stopped goes on: its output is in out/evidence/NAME
#   sh test/measure/evidence.sh take NAME DIR  store and show what the entry's command has left in DIR, wherever it ran;
#                                              MINUTES=, COMMIT=, ESTIMATOR=, MACHINE= say what is not as it is here
#   sh test/measure/evidence.sh again [NAME...] compute again what is derived from stored runs, and show it
#   sh test/measure/evidence.sh fill           put what is stored into the documents
#   sh test/measure/evidence.sh check          do the documents show what is stored, and say so where it is old? Are
#                                              they those of the stored runs? (recompute.py asks again)
# What is stored lies below a line "=== NAME": the runs in doc/measured/runs.txt, as csv; in numbers.txt a head of lines
# "key: value" and sections "== SECTION". A document shows a section between <!-- measured: NAME.SECTION --> and
# <!-- end -->: both on lines of their own, or both in a line of text.
set -u
export LC_ALL=C
kept=doc/measured
list=$kept/list.txt
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
# Here each entry has files of its own, NAME.txt and NAME.csv.
export STORED="$dir/stored"
stored=$STORED
mkdir "$stored"
for kind in numbers.txt runs.csv; do
    awk -v to="$stored/" -v end=".${kind#*.}" '/^=== / { close(file); file = to $2 end; next } { print >file }' \
        "$kept/${kind%.*}.txt"
done
# store FILE NAME KIND: FILE becomes its numbers (txt) or its runs (csv).
store() {
    [ "$3" = txt ] && into=$kept/numbers.txt || into=$kept/runs.txt
    cp "$1" "$stored/$2.$3"
    awk -v name="$2" 'FNR == NR { text = text $0 "\n"; next }
        /^=== / && (here = $2 == name) { print; printf "%s", text; done = 1 }
        !here { print }
        END { if (!done) printf "=== %s\n%s", name, text }' "$1" "$into" >"$dir/into" && cp "$dir/into" "$into"
}
bad=0
wrong() { echo "evidence: $*"; bad=1; }

names() { awk '/^[a-z][a-z0-9-]*$/' $list; }
# field NAME KEY: a line of an entry. commands NAME KEY: its indented lines. head FILE KEY: a line of a head.
field() {
    awk -v name="$1" -v key="$2:" '/^[a-z][a-z0-9-]*$/ { on = $0 == name }
        on && $1 == key { sub(/^[a-z]*: */, ""); print }' $list
}
commands() {
    awk -v name="$1" -v key="$2:" '/^[a-z][a-z0-9-]*$/ { on = $0 == name } !/^    / { inside = on && $0 == key; next }
        inside' $list
}
head_of() { sed -n -e '/^== /q' -e "s/^$2: *//p" "$1"; }

estimator=$(sed -n 's/^#define ESTIMATOR \([0-9]*\)$/\1/p' src/base/version.h)
# stamp NAME: of what its numbers are, as the tree is now.
stamp() {
    set -- $(field "$1" of)
    case $1 in
    estimator) echo "estimator $estimator" ;;
    bytes) echo "pictures $(grep -E -e "$2" test/run/hashes.txt | cksum | sed 's/ .*//')" ;;
    *) echo "$1" ;;
    esac
}
# old FILE NAME: is it of another estimator or of other pictures?
old() { [ "$(head_of "$1" of)" != "$(stamp "$2")" ]; }
machine() {
    model=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo 2>/dev/null | head -n 1)
    echo "$(uname -m), ${model:-unknown processor}, $(getconf _NPROCESSORS_ONLN 2>/dev/null || echo some) cores"
}

# raw NAME DIR: its runs as csv: what raw: prints, or all runs.csv in DIR and one folder below, the column part.
raw() {
    commands "$1" raw >"$dir/raw"
    if [ -s "$dir/raw" ]; then OUT=$2 sh -e "$dir/raw"; return; fi
    for runs in "$2"/runs.csv "$2"/*/runs.csv; do
        [ ! -f "$runs" ] || (cd "$2" && awk -F , -v part="$(basename "$(dirname "${runs#"$2"/}")" | sed 's/^\.$//')" '
            BEGIN {
                n = split("scene label half seed spp seconds mse8 relmse relmse8x8 price_before price_each mark " \
                    "rmse8 mean_error", name, " ")
                for (i = 1; i <= n; i++) printf "%s,", name[i]
                print "part"
            }
            NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
            { for (i = 1; i <= n; i++) printf "%s,", $at[name[i]]; print part }' "${runs#"$2"/}")
    done | awk 'NR == 1 { head = $0; print; next } $0 != head'
}
# derived NAME SHOWN: the sections that derive: prints, from stored runs and from SHOWN, what show: has printed.
derived() {
    {
        echo 'ratios() { awk -v missing="$SHOWN" -f "$AWK/better.awk" -f "$AWK/equal.awk" "$@"; }'
        commands "$1" derive
    } >"$dir/derive"
    AWK=test/measure/evidence RUNS=$stored/$1.csv SHOWN=$2 sh -e "$dir/derive"
}
# again NAME: what is stored of it, with the sections of derive: made again.
again() {
    derived "$1" "$stored/$1.txt" >"$dir/derived" || return
    awk 'FILENAME == ARGV[1] { if (/^== /) made[$0]; next } /^== / { old = $0 in made } !old' \
        "$dir/derived" "$stored/$1.txt"
    cat "$dir/derived"
}
# keep NAME DIR MINUTES: its runs; and what its show: prints of DIR and its derive: of the runs, with a head.
keep() {
    raw "$1" "$2" >"$dir/runs" || { wrong "$1: no runs in $2"; return 1; }
    [ ! -s "$dir/runs" ] || store "$dir/runs" "$1" csv
    commands "$1" show >"$dir/show"
    OUT=$2 sh -e "$dir/show" >"$dir/shown" || { wrong "$1: nothing to show in $2"; return 1; }
    derived "$1" "$dir/shown" >"$dir/derived" || { wrong "$1: nothing to derive from its runs"; return 1; }
    cat "$dir/derived" >>"$dir/shown"
    awk '/^== / { n++; empty += open; open = 1; next } NF { open = 0 } END { exit empty || open || !n }' "$dir/shown" ||
        { wrong "$1: no sections, or an empty one"; return 1; }
    {
        echo "what: $(field "$1" what)"
        echo "samples: $(field "$1" samples)"
        echo "commit: ${COMMIT:-$(git log -1 --format=%h -- src test/lab 2>/dev/null || echo unknown)}"
        echo "estimator: ${ESTIMATOR:-$estimator}"
        of=$(stamp "$1")
        [ "${ESTIMATOR:-$estimator}" = "$estimator" ] || of="estimator $ESTIMATOR"
        echo "of: $of"
        echo "machine: ${MACHINE:-$(machine)}"
        echo "date: ${DATE:-$(date +%Y-%m-%d)}"
        echo "minutes: ${MINUTES:-$3}"
        cat "$dir/shown"
    } >"$dir/kept" && store "$dir/kept" "$1" txt
}

# missing NAME: which of its needs is not there.
missing() {
    for need in $(field "$1" needs); do
        case $need in
        published) [ -f "${PUBLISHED-}/cornell-box/scene.pbrt" ] || echo "PUBLISHED=DIR, the five published scenes" ;;
        corpus) [ -f "${CORPUS-}/list.txt" ] || echo "CORPUS=DIR, made by sh test/measure/corpus.sh DIR" ;;
        references) [ -d "${REFERENCES-}" ] || echo "REFERENCES=DIR, their references" ;;
        peers) [ -d "${PEERS-}" ] || echo "PEERS=DIR, made by sh test/measure/peers.sh build" ;;
        esac
    done | head -n 1
}

run() { # NAME
    lack=$(missing "$1")
    [ -z "$lack" ] || { wrong "$1 is not run: needs $lack"; return; }
    out=out/evidence/$1
    [ "$(cat "$out/of" 2>/dev/null)" = "$(stamp "$1")" ] || rm -rf "$out"
    mkdir -p "$out" && stamp "$1" >"$out/of"
    commands "$1" run >"$dir/run"
    (OUT=$out sh -e "$dir/run" >"$out/said" && times >"$dir/times") || { wrong "$1 failed: $out/said"; return; }
    awk 'NR == 2 { for (i = 1; i <= 2; i++) { split($i, t, "m"); s += 60 * t[1] + t[2] } print s }' "$dir/times" \
        >>"$out/seconds"
    keep "$1" "$out" "$(awk '{ s += $1 } END { printf "%.2g", s / 60 }' "$out/seconds")"
}

# notes: of every entry a line: NAME, a blank, what is said below a block; NAME+ likewise in a text, if it is old.
notes() {
    for name in $(names); do
        file=$stored/$name.txt
        if [ ! -f "$file" ]; then echo "$name *Not measured yet: \`sh test/measure/evidence.sh run $name\`.*"; continue; fi
        said=$(awk -F ': ' -v name="$name" '/^== / { exit } { of[$1] = substr($0, length($1) + 3) }
            END {
                if (of["of"] ~ /^tree/) print "*" of["samples"] ": `sh test/measure/evidence.sh run " name "`.*"
                else
                    print "*" of["samples"] "; estimator " of["estimator"] ", commit " of["commit"] ", " of["date"] \
                        "; " of["machine"] "; " of["minutes"] " CPU minutes; `sh test/measure/evidence.sh run " name "`.*"
            }' "$file")
        if old "$file" "$name"; then
            was=$(head_of "$file" estimator)
            echo "$name **Measured with an older version of the program (estimator $was).** $said"
            echo "$name+ (older version)"
        else
            echo "$name $said"
        fi
    done
}

# filled PAGE: the page with what is stored.
filled() {
    LC_ALL=C awk -v stored="$stored" -v notes="$dir/notes" '
        BEGIN {
            while ((getline line < notes) > 0) {
                at = index(line, " ")
                note[substr(line, 1, at - 1)] = substr(line, at + 1)
            }
        }
        function fail(text) { print "evidence: " FILENAME ":" FNR ": " text >"/dev/stderr"; bad = 1 }
        # The section that a mark names, its lines joined.
        function section(mark,    path, part, line, on, text, n) {
            sub(/^<!-- measured: /, "", mark); sub(/ -->.*/, "", mark)
            split(mark, part, ".")
            name = part[1]
            if (!(name in note)) { fail("no entry " name); return "" }
            path = stored "/" name ".txt"
            while ((getline line < path) > 0) {
                if (line ~ /^== /) on = line == "== " part[2]
                else if (on) text = text (n++ ? "\n" : "") line
            }
            close(path)
            if (!n && note[name] !~ /^\*Not measured/) fail("nothing is stored for " mark)
            return text
        }
        skip { if (/^<!-- end -->$/) skip = 0; else next }
        /^<!-- measured: [a-z0-9.-]+ -->$/ {
            text = section($0)
            print
            if (text != "") print text "\n"
            print note[name]
            skip = 1
            next
        }
        {
            line = $0; out = ""
            if (line ~ /^ *<!-- measured: [a-z0-9.-]+ -->./) fail("a mark that begins a line of text is HTML")
            while (match(line, /<!-- measured: [a-z0-9.-]+ -->[^<]*<!-- end -->/)) {
                mark = substr(line, RSTART, RLENGTH); text = section(mark)
                if (text == "") text = "(not measured yet)"
                out = out substr(line, 1, RSTART - 1) substr(mark, 1, index(mark, "-->") + 2) text \
                    (name "+" in note ? " " note[name "+"] : "") "<!-- end -->"
                line = substr(line, RSTART + RLENGTH)
            }
            print out line
        }
        END { if (skip) fail("no end of a block"); exit bad }' "$1"
}
drawn() { # NAME FILE: the figure of an entry
    commands "$1" draw >"$dir/draw"
    sh -e "$dir/draw" <"$stored/$1.txt" >"$2"
}
pages() { grep -l '<!-- measured: ' README.md doc/*.md doc/*/*.md scenes/*.md; }
fill() {
    notes >"$dir/notes"
    for page in $(pages); do
        filled "$page" >"$dir/page" || { bad=1; continue; }
        cmp -s "$dir/page" "$page" || cp "$dir/page" "$page"
    done
    for name in $(names); do
        [ -z "$(field "$name" figure)" ] || [ ! -f "$stored/$name.txt" ] || drawn "$name" "$(field "$name" figure)"
    done
}
# drift TOP: the documents below TOP that are not as fill makes them.
drift() {
    notes >"$dir/notes"
    for page in $(pages); do
        [ ! -f "$1/$page" ] || { filled "$1/$page" >"$dir/page" && cmp -s "$dir/page" "$1/$page" || echo "$page"; }
    done
}
# near FILE FILE PERCENT: are they the same, but for numbers, which may differ by so much?
near() {
    awk -v percent="$3" '
        function number(s) { gsub(/,/, "", s); return s }
        function far(x, y) { return 100 * (y - x) > percent * x || 100 * (x - y) > percent * x }
        NR == FNR { was[FNR] = $0; n = FNR; next }
        {
            m = split(was[FNR], a); k = split($0, b)
            if (m != k) exit 1
            for (i = 1; i <= k; i++) {
                x = number(a[i]); y = number(b[i])
                if (x ~ /^[0-9.]+$/ && y ~ /^[0-9.]+$/ ? far(x, y) : a[i] != b[i]) bad = 1
            }
        }
        END { exit bad || FNR != n }' "$1" "$2"
}

check() {
    n=0 behind=
    for name in $(names); do
        file=$stored/$name.txt
        if [ ! -f "$file" ]; then behind="$behind $name"; continue; fi
        n=$((n + 1))
        for page in $(field "$name" shown); do
            grep -q -e "<!-- measured: $name\\." "$page" || wrong "$page does not show $name"
        done
        old "$file" "$name" && behind="$behind $name"
        again "$name" | cmp -s - "$file" ||
            wrong "$name is not what its runs say: sh test/measure/evidence.sh again $name"
        [ "$(head_of "$file" samples)" = "$(field "$name" samples)" ] || wrong "$name has other samples than $list"
        figure=$(field "$name" figure)
        [ -z "$figure" ] || { drawn "$name" "$dir/figure" && cmp -s "$dir/figure" "$figure"; } ||
            wrong "$figure is not what is stored of $name: sh test/measure/evidence.sh fill"
        case $(field "$name" of) in tree*)
            commands "$name" show >"$dir/show"
            sh -e "$dir/show" >"$dir/now"
            sed -n '/^== /,$p' "$file" >"$dir/then"
            percent=$(field "$name" of)
            near "$dir/then" "$dir/now" "${percent#tree }" ||
                wrong "$name is not what the tree says now: sh test/measure/evidence.sh run $name"
            ;;
        esac
    done
    for name in $(sed -n 's/^=== //p' "$kept/numbers.txt" "$kept/runs.txt" | sort -u); do
        names | grep -qx "$name" || wrong "$name has no entry in $list"
    done
    for page in $(drift .); do wrong "$page shows other numbers than $kept has: sh test/measure/evidence.sh fill"; done

    # What must not pass: a digit changed in a document, another run, and a result that is older than the source.
    name=$(for name in $(names); do
        [ "$(field "$name" of)" != estimator ] || ! grep -qs ',subspaces,' "$stored/$name.csv" || echo "$name"
    done | head -n 1)
    page=$(field "$name" shown | sed 's/ .*//')
    mkdir -p "$dir/planted/$(dirname "$page")"
    awk -v mark="<!-- measured: $name." '!done && inside && gsub(/[0-8]\.[0-9]/, "9&") { done = 1 }
        index($0, mark) == 1 { inside = 1 } { print }' "$page" >"$dir/planted/$page"
    [ "$(drift "$dir/planted")" = "$page" ] || wrong "another number in $page is not noticed"
    cp -R "$stored" "$dir/measured" && sed -e 's/^estimator: .*/estimator: 0/' -e 's/^of: .*/of: estimator 0/' \
        "$stored/$name.txt" >"$dir/measured/$name.txt"
    awk -F , -v OFS=, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
        $at["label"] == "subspaces" && !n++ { $at["mse8"] *= 4 } { print }' \
        "$stored/$name.csv" >"$dir/measured/$name.csv"
    stored=$dir/measured
    drift . | grep -qx "$page" || wrong "an old estimator in $name is not noticed"
    again "$name" | cmp -s - "$stored/$name.txt" && wrong "another run of $name is not noticed"
    stored=$STORED
    [ $bad -ne 0 ] || echo "evidence: $n results, shown as they are stored; old or not measured:${behind:- none}"
}

show_list() {
    for name in $(names); do
        file=$stored/$name.txt state="not measured"
        if [ -f "$file" ]; then
            state="estimator $(head_of "$file" estimator), $(head_of "$file" date)"
            old "$file" "$name" && state="OLD: $state"
        fi
        lack=$(missing "$name")
        printf '%-14s %5s min  %-28s %s%s\n' "$name" "$(field "$name" minutes)" "$state" "$(field "$name" what)" \
            "${lack:+; needs $lack}"
    done
}

case ${1-} in
list) show_list ;;
run) # what was built of these sources
    shift
    make -s asbdpt asbdpt-lab build/test >/dev/null || exit
    [ $# -gt 0 ] || set -- $(for name in $(names); do
        [ -n "$(missing "$name")" ] || { [ -f "$stored/$name.txt" ] && ! old "$stored/$name.txt" "$name"; } ||
            echo "$name"
    done)
    for name in "$@"; do
        names | grep -qx "$name" || { wrong "there is no $name"; continue; }
        echo "$name: $(field "$name" minutes) minutes of two cores"
        run "$name"
    done
    fill
    ;;
take) keep "$2" "$3" unknown && fill ;;
again)
    shift
    [ $# -gt 0 ] || set -- $(names)
    for name in "$@"; do
        [ ! -f "$stored/$name.txt" ] || again "$name" >"$dir/kept" || { wrong "$name: cannot be derived"; continue; }
        [ ! -f "$stored/$name.txt" ] || store "$dir/kept" "$name" txt
    done
    fill
    ;;
fill) fill ;;
check) check ;;
*) sed -n 's/^# *//p' "$0" | sed -n '2,15p'; bad=2 ;;
esac
exit $bad

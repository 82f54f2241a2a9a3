#!/bin/sh
# run.sh: apply the faults of list.txt one by one to a copy of the tree; every one must be caught by the test suite.
#   sh test/mutants/run.sh [WORKERS [NAME...]]      `make mutants` calls it; results in build-mutants/table.txt
# A fault is caught when a test fails, or crashes, which the table says then; one that keeps a test running for TIMEOUT
# seconds is reported as an error. What is doubtful fails at once, as in one suite of three hundred something does
# without a fault. With WHOLE=no only the named tests are run. With SOUND=no the tests are known to pass without any
# fault. With UNTIL=SECONDS, since 1970, no mutant is begun after that time; those that are left out are said, and do
# not count.
#   sh test/mutants/run.sh choose COUNT WORD    prints the names of so many, chosen by the word
# Exit status 0 only if all faults are caught.
set -u
list=test/mutants/list.txt
work=build-mutants
TIMEOUT=900
limit=$(command -v timeout || command -v gtimeout) && limit="$limit $TIMEOUT" # else there is none
rest=all
[ "${WHOLE:-yes}" = no ] && rest=

# choose COUNT WORD: any of them, always the same for one word.
choose() {
    names | while read -r name; do
        echo "$(printf '%s %s' "$name" "$2" | cksum | cut -d ' ' -f 1) $name"
    done | sort -n | head -n "$1" | cut -d ' ' -f 2
}

# names: the mutants to run, one a line.
names() {
    awk -v only="$only" '/^[^-+# \t]/ && NF > 3 && (only == "  " || index(only, " " $1 " ")) { print $1 }' $list
}

# apply NAME TREE: replace the text in the tree's file. Prints an error unless the old text occurs exactly once.
apply() { sh test/mutants/apply.sh $list "$1" "$2"; }

# field NAME N: the N-th word of the mutant's first line; the description is the rest.
field() { awk -v name="$1" -v n="$2" '/^[^-+# \t]/ && $1 == name { print $n }' $list; }

# try TREE TEST: does the test notice? Prints what it says.
try() {
    if [ -f "$1/test/$2.sh" ]; then
        (cd "$1" && make -s LTO= asbdpt asbdpt-lab >/dev/null 2>&1 && $limit sh "test/$2.sh" ./asbdpt)
    elif [ "$2" = all ]; then
        (cd "$1" && $limit build/test --first)
    else
        (cd "$1" && $limit build/test --first "$2")
    fi >"$1/output.txt" 2>&1
}

# crashed TREE STATUS: did the test end by a signal, with no failure said before? A failing assert is one that is said.
crashed() { [ "$2" -gt 128 ] && ! grep -Eq 'FAIL|Assertion' "$1/output.txt"; }

# one NAME TREE: the mutant's line of the table.
one() {
    file=$(field "$1" 2)
    cp "$2/$file" "$2/saved"
    verdict=SURVIVED
    if ! message=$(apply "$1" "$2"); then
        verdict="ERROR $message"
    elif ! (cd "$2" && make -s LTO= build/test) >"$2/output.txt" 2>&1; then
        verdict="ERROR does not compile"
    else
        for test in $(field "$1" 3 | tr , ' ') $rest; do
            try "$2" "$test"
            status=$?
            [ $status -eq 124 ] && verdict="ERROR $test does not end" && break
            if [ $status -ne 0 ]; then
                verdict=$test
                [ "$test" = all ] &&
                    verdict="all: $(sed -n 's/.*repeat with: .* //p' "$2/output.txt" | sort -u | tr '\n' ' ')"
                crashed "$2" $status && verdict="$verdict crash"
                break
            fi
        done
    fi
    cp "$2/saved" "$2/$file"
    printf '%-18s %s\n' "$1" "$verdict"
}

# plant: WORKERS copies of all that tests need, built.
plant() {
    mkdir -p $work/tree0
    cp -R Makefile src test scenes ref doc $work/tree0/ 2>/dev/null
    (cd $work/tree0 && make -s -j"$workers" LTO= asbdpt asbdpt-lab build/test) || return
    w=1
    while [ $w -lt "$workers" ]; do
        rm -rf $work/tree$w
        cp -Rp $work/tree0 $work/tree$w || return
        w=$((w + 1))
    done
}

# sound TREE: do the tests pass without any fault? One that does not would seem to catch them all.
sound() {
    [ "${SOUND:-yes}" = no ] && return
    for test in $(for name in $(names); do field "$name" 3; done | tr , '\n' | sort -u) $rest; do
        try "$1" "$test" || { echo "$test fails without any fault: $1/output.txt"; return 1; }
    done
}

# worker NUMBER: every WORKERS-th mutant in a tree of its own.
worker() {
    tree=$work/tree$1
    n=0
    for name in $(names); do
        if [ $((n % workers)) -ne "$1" ]; then :
        elif [ -n "${UNTIL-}" ] && [ "$(date +%s)" -ge "$UNTIL" ]; then
            printf '%-18s %s\n' "$name" "LEFT OUT"
        else
            one "$name" "$tree"
        fi
        n=$((n + 1))
    done >"$work/part$1.txt"
}

if [ "${1-}" = choose ]; then
    only="  "
    choose "$2" "$3"
    exit
fi
workers=${1:-2}
[ $# -gt 0 ] && shift
only=" $* "
rm -rf $work/part*.txt
plant && sound $work/tree0 || exit 1
w=0
while [ $w -lt "$workers" ]; do
    worker $w &
    w=$((w + 1))
done
wait
for name in $(names); do
    cat $work/part*.txt | awk -v name="$name" '$1 == name'
done >$work/table.txt
cat $work/table.txt
awk -v wanted="$(names | wc -l)" '
    $2 == "SURVIVED" || $2 == "ERROR" { bad++ }
    $2 == "LEFT" { out++ }
    $NF == "crash" { crashed++ }
    END { printf "%d mutants, %d caught, of these %d by a crash, %d left out\n", wanted, NR - bad - out, crashed, out
          exit (bad > 0 || NR != wanted || NR == 0) }' $work/table.txt

#!/bin/sh
# run.sh: apply the faults of list.txt one by one to a copy of the tree; every one must be caught by the test suite.
#   sh test/data/mutants/run.sh [WORKERS [NAME...]]      `make mutants` calls it; results in build-mutants/table.txt
# A fault is caught when a test fails, or crashes, which the table says then; one that keeps a test running for TIMEOUT
# seconds is reported as an error. What is doubtful fails at once, as in one suite of three hundred something does
# without a fault. With WHOLE=no only the tests that the list names are run.
# Exit status 0 only if all faults are caught.
set -u
list=test/data/mutants/list.txt
work=build-mutants
TIMEOUT=3600 # of the clock: a busy machine may need long
limit=$(command -v timeout || command -v gtimeout) && limit="$limit $TIMEOUT" # else there is none
rest=all
[ "${WHOLE:-yes}" = no ] && rest=

# chosen: of the mutants to run a line each: name, file, tests.
chosen() {
    awk -v only="$only" '/^[^-+# \t]/ && NF > 3 && (only == "  " || index(only, " " $1 " ")) { print $1, $2, $3 }' $list
}

# try TREE TEST: does the test notice? What it says is in TREE/output.txt.
try() {
    if [ -f "$1/test/run/$2.sh" ]; then
        (cd "$1" && make -s LTO= asbdpt asbdpt-lab build/boxes >/dev/null 2>&1 && $limit sh "test/run/$2.sh" ./asbdpt)
    else
        (cd "$1" && $limit build/test --first ${2%all})
    fi >"$1/output.txt" 2>&1
}

# verdict NAME TREE TESTS: the first test that fails, and whether it ended by a signal, with no failure said before. (A
# failing assert is one that is said.)
verdict() {
    sh test/data/mutants/apply.sh $list "$1" "$2" >"$2/output.txt" || { echo "ERROR $(cat "$2/output.txt")"; return; }
    (cd "$2" && make -s LTO= build/test) >"$2/output.txt" 2>&1 || { echo "ERROR does not compile"; return; }
    for test in $3; do
        try "$2" "$test" && continue
        status=$?
        [ $status -ne 124 ] || { echo "ERROR $test does not end"; return; }
        [ "$test" != all ] || test="all: $(sed -n 's/.*repeat with: .* //p' "$2/output.txt" | sort -u | tr '\n' ' ')"
        [ $status -gt 128 ] && ! grep -Eq 'FAIL|Assertion' "$2/output.txt" && test="$test crash"
        echo "$test"
        return
    done
    echo SURVIVED
}

# worker NUMBER: every WORKERS-th mutant in a tree of its own.
worker() {
    tree=$work/tree$1
    chosen | awk -v n="$1" -v workers="$workers" 'NR % workers == n % workers' | while read -r name file tests; do
        cp "$tree/$file" "$tree/saved"
        printf '%-18s %s\n' "$name" "$(verdict "$name" "$tree" "$(echo "$tests" | tr , ' ') $rest" </dev/null)"
        cp "$tree/saved" "$tree/$file"
    done >"$work/part$1.txt"
}

workers=${1:-2}
[ $# -gt 0 ] && shift
only=" $* "
rm -rf $work/part*.txt
mkdir -p $work/tree0
(cd $work/tree0 && rm -rf build src test scenes ref doc) # what is no longer in the tree, or made of a fault
cp -Rp Makefile src test scenes ref doc $work/tree0/
(cd $work/tree0 && make -s -j"$workers" LTO= asbdpt asbdpt-lab build/test >/dev/null) || exit 1
for test in $(chosen | sed 's/.* //' | tr , '\n' | sort -u) $rest; do # one that fails would seem to catch them all
    try $work/tree0 "$test" && continue
    tail -n 20 $work/tree0/output.txt
    echo "$test fails without any fault: $work/tree0/output.txt"
    exit 1
done
for w in $(seq "$workers"); do # copies of a tree that no fault is ever planted in
    rm -rf "$work/tree$w" && cp -Rp $work/tree0 "$work/tree$w" || exit
    worker "$w" &
done
wait
chosen | while read -r name file tests; do
    cat $work/part*.txt | awk -v name="$name" '$1 == name'
done | tee $work/table.txt
awk -v wanted="$(chosen | wc -l)" '
    $2 == "SURVIVED" || $2 == "ERROR" { bad++ }
    $NF == "crash" { crashed++ }
    END { printf "%d mutants, %d caught, of these %d by a crash\n", wanted, NR - bad, crashed
          exit (bad > 0 || NR != wanted || NR == 0) }' $work/table.txt

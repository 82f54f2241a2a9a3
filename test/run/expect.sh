# expect.sh: what the tests of the program from outside share; they read it by `. test/run/expect.sh`, from the top,
# with PROGRAM as the first argument; the laboratory lies beside it. It leads into an empty directory that goes away
# in the end.
program=$1 top=$PWD
case $program in /*) ;; *) program=$top/$program ;; esac
lab=$program-lab scenes=$top/scenes
box=$scenes/cornell-box.pbrt
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
failures=0

fault() {
    echo "FAIL: $*"
    failures=$((failures + 1))
}
# expect STATUS PATTERN COMMAND...: the command ends with STATUS and its stderr matches PATTERN (extended regexp).
expect() {
    status=$1 pattern=$2
    shift 2
    "$@" >stdout.txt 2>stderr.txt
    got=$?
    if [ $got -ne "$status" ] || { [ -n "$pattern" ] && ! grep -Eq -e "$pattern" stderr.txt; }; then
        fault "$* ended with $got (expected $status) saying: $(cat stderr.txt)"
    fi
}
check() { "$@" || fault "$*"; }
# says PATTERN...: the standard output of the last command has a line for each (basic regular expressions).
says() {
    for pattern; do
        grep -q -e "$pattern" stdout.txt || fault "no \"$pattern\" in $(cat stdout.txt)"
    done
}
# prints PATTERN COMMAND...: it ends with 0, and its standard output says so.
prints() {
    said=$1
    shift
    expect 0 '' "$@"
    says "$said"
}
# makes FILE COMMAND...: it ends with 0, and the file of its last argument has the same bytes as FILE.
makes() {
    like=$1
    shift
    expect 0 '' "$@"
    for made; do :; done
    cmp -s "$like" "$made" || fault "$* does not make the bytes of $like"
}

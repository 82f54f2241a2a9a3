#!/bin/sh
# hashes.sh PROGRAM [renew]: does PROGRAM render the pictures of test/run/hashes.txt, byte for byte? PROGRAM may have
# several words, such as an emulator's; it is called from the top of the tree. Every line of the list is a checksum
# (POSIX cksum of the unclamped PFM), a scene and options of `render`. Exit status 0 if all agree, or if PROGRAM says that its
# arithmetic differs.
# The integrators that only the laboratory has are in a list of their own: LIST=test/lab/hashes.txt, with asbdpt-lab.
# With `renew` the checksums are written anew instead: for changes that are meant to change pictures. Films of programs
# that make other pictures must not be added up, so it refuses that unless ESTIMATOR of src/base/version.h has changed;
# the list begins with that number and a checksum of all its checksums. A line that is new to it begins with the word
# new. LIST=FILE takes another list.
program=$1 mode=$2
list=${LIST:-test/run/hashes.txt}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
if $program --version | grep 'FLT_EVAL_METHOD'; then
    echo "hashes: not compared"
    exit 0
fi
fail() {
    echo "FAIL: $*"
    exit 1
}
estimator=$(sed -n 's/^#define ESTIMATOR \([0-9]*\)$/\1/p' src/base/version.h)
listed=$(sed -n 's/^# estimator \([0-9]*\), checksum of the lines below [0-9]*$/\1/p' "$list")
heading() { # FILE: the estimator and the checksum of all lines that have one
    echo "# estimator $estimator, checksum of the lines below $(grep '^[0-9]' "$1" | cksum | sed 's/ .*//')"
}
[ -n "$estimator" ] && [ -n "$listed" ] || fail "$list or src/base/version.h names no estimator"
heading "$list" | sed "s/estimator $estimator,/estimator $listed,/" | grep -qxF "$(sed -n '/^# estimator/p' "$list")" ||
    fail "$list is not as make hashes wrote it"

sh scenes/unpack.sh scenes/test "$dir/scenes/test" || exit # some lie in lists
while read -r sum scene options; do
    case $sum in '#'*) echo "$sum $scene $options"; continue ;; esac
    [ -f "$dir/$scene" ] && file=$dir/$scene || file=$scene
    # shellcheck disable=SC2086
    if $program render "$file" --res 20x15 --spp 2 -j 2 --quiet --unclamped $options -o - </dev/null >"$dir/x.pfm" 2>"$dir/log"; then
        set -- $(cksum <"$dir/x.pfm")
    else
        echo "# FAIL: status $?, $scene $options: $(cat "$dir/log")" >&2
        set --
    fi
    echo "${1:-none} $scene${options:+ $options}"
done <"$list" >"$dir/new"
grep -q '^[0-9]' "$dir/new" || fail "no picture of $list was made"

grep -v '^new ' "$list" >"$dir/old"
changed=$(grep -vxF -f "$dir/new" "$dir/old")
if [ "$mode" = renew ]; then
    if grep '^none' "$dir/new"; then exit 1; fi
    grep -q "^| $estimator |" CHANGELOG.md || fail "CHANGELOG.md does not say what estimator $estimator changes"
    [ -z "$changed" ] || [ "$estimator" != "$listed" ] ||
        fail "these pictures are others; if they are meant to be, raise ESTIMATOR in src/base/version.h:
$changed"
    sed "s/^# estimator .*/$(heading "$dir/new")/" "$dir/new" >"$list"
elif ! cmp -s "$dir/new" "$list"; then
    echo "FAIL: other pictures than in $list, or none; if they are meant to differ: raise ESTIMATOR, make hashes"
    grep -vxF -f "$list" "$dir/new"
    exit 1
elif [ "$estimator" != "$listed" ]; then
    fail "$list is of estimator $listed, src/base/version.h of $estimator: make hashes"
fi
echo "hashes: the bytes of $(grep -c '^[0-9]' "$list") pictures are as listed"

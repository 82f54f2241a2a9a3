#!/bin/sh
# hashes.sh PROGRAM [renew]: does PROGRAM render the pictures of test/hashes.txt, byte for byte? PROGRAM may have
# several words, such as an emulator's; it is called from the top of the tree. Every line of the list is a checksum
# (POSIX cksum of the PFM), a scene and options of `render`. With `renew` the checksums are written anew instead: for
# changes that are meant to change pictures. Exit status 0 if all agree, or if PROGRAM says that its arithmetic differs.
program=$1 mode=$2
list=test/hashes.txt
dir=out/hashes.$$
mkdir -p "$dir" || exit 1
trap 'rm -rf "$dir"' EXIT
if $program --version | grep 'FLT_EVAL_METHOD'; then
    echo "hashes: not compared"
    exit 0
fi

while read -r sum scene options; do
    case $sum in '#'*) echo "$sum $scene $options"; continue ;; esac
    # shellcheck disable=SC2086
    if $program render $scene --res 20x15 --spp 2 -j 2 --quiet $options -o "$dir/x.pfm" </dev/null 2>"$dir/log"; then
        set -- $(cksum <"$dir/x.pfm")
    else
        echo "# FAIL: status $?, $scene $options: $(cat "$dir/log")" >&2
        set --
    fi
    rm -f "$dir/x.pfm"
    echo "${1:-none} $scene${options:+ $options}"
done <"$list" >"$dir/new"

if [ "$mode" = renew ]; then
    if grep '^none' "$dir/new"; then exit 1; fi
    cp "$dir/new" "$list"
elif ! cmp -s "$dir/new" "$list"; then
    echo "FAIL: other pictures than in $list, or none; if they are meant to differ: make hashes"
    diff "$list" "$dir/new" | grep '^>'
    exit 1
fi
echo "hashes: the bytes of $(grep -c '^[0-9]' "$list") pictures are as listed"

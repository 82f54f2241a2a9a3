#!/bin/sh
# hashes_test.sh: does hashes.sh notice other pictures, and does it refuse to list them under the same estimator? The
# program is a stand-in that renders the name of the scene, and SAYS after it.
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cat >"$dir/program" <<'END'
[ "$1" = --version ] && exit
scene=$2
while [ $# -gt 1 ]; do shift; done
echo "$scene $SAYS" >"$1"
END
LIST=$dir/list
export LIST SAYS
hashes() { sh test/hashes.sh "sh $dir/program" "$@" >"$dir/said" 2>&1; }
expect() { # STATUS WHAT [renew]
    status=$1 what=$2
    shift 2
    hashes "$@"
    [ $? = "$status" ] && return
    echo "hashes.sh: $what ends with another status than $status: $(cat "$dir/said")"
    exit 1
}
SAYS=
number=$(sed -n 's/^#define ESTIMATOR \([0-9]*\)$/\1/p' src/base/version.h)
printf '# a list\n# estimator %s, checksum of the lines below %s\nnew one -P x\nnew two\n' "$number" \
    "$(cksum </dev/null | sed 's/ .*//')" >"$LIST"
expect 1 "a list with new lines"
expect 0 "new lines, to be listed" renew
expect 0 "a list as it should be"
[ "$(grep -c '^[0-9]' "$LIST")" = 2 ] || { echo "hashes.sh: new lines are not listed"; exit 1; }
cp "$LIST" "$dir/good"
sed '/ two/d' "$dir/good" >"$LIST"
expect 1 "a list changed by hand"
sed '/^[0-9]/d' "$dir/good" >"$LIST"
expect 1 "an empty list"
cp "$dir/good" "$LIST"
SAYS=otherwise
expect 1 "a program of other pictures"
expect 1 "other pictures under the same estimator" renew
cmp -s "$dir/good" "$LIST" || { echo "hashes.sh: a list that was refused is written"; exit 1; }
sed "s/^# estimator [0-9]*/# estimator 999/" "$dir/good" >"$LIST"
expect 0 "other pictures under another estimator" renew
expect 0 "the new list"
sed "s/^# estimator [0-9]*/# estimator 999/" "$LIST" >"$dir/stale"
cp "$dir/stale" "$LIST"
expect 1 "a list of another estimator"
echo "hashes.sh: other pictures need another estimator"

#!/bin/sh
# hashes_test.sh: does hashes.sh notice other pictures, and does it refuse to list them under the same estimator? The
# program is a stand-in that renders the name of the scene, and SAYS after it.
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cat >"$dir/stand-in" <<'END'
#!/bin/sh
[ "$1" = --version ] || echo "$2 $SAYS"
END
chmod +x "$dir/stand-in" && PATH=$dir:$PATH
number=$(sed -n 's/^#define ESTIMATOR \([0-9]*\)$/\1/p' src/base/version.h)
printf '# a list\n# estimator %s, checksum of the lines below %s\nnew one -P x\nnew two\n' "$number" \
    "$(cksum </dev/null | sed 's/ .*//')" >"$dir/fresh"
export LIST="$dir/list" SAYS
# A row: what the list is made of and by which edit, what the program says, hashes.sh's mode, its status, and whether
# the list is written.
while IFS='|' read -r from edit SAYS mode status written what; do
    sed "$edit" "$dir/$from" >"$LIST"
    cp "$LIST" "$dir/before"
    sh test/run/hashes.sh stand-in $mode >"$dir/said" 2>&1
    [ $? = "$status" ] || { echo "hashes.sh: $what does not end with $status: $(cat "$dir/said")"; exit 1; }
    cmp -s "$LIST" "$dir/before" && changed=no || changed=yes
    [ $changed = "$written" ] || { echo "hashes.sh: $what: is the list written? $changed"; exit 1; }
    [ $changed = no ] || cp "$LIST" "$dir/good"
done <<'END'
fresh||||1|no|a list with new lines
fresh|||renew|0|yes|new lines, to be listed
good||||0|no|a list as it should be
good|/ two/d|||1|no|a list changed by hand
good|/^[0-9]/d|||1|no|an empty list
good||otherwise||1|no|a program of other pictures
good||otherwise|renew|1|no|other pictures under the same estimator
good|s/^# estimator [0-9]*/# estimator 999/|otherwise|renew|0|yes|other pictures under another estimator
good||otherwise||0|no|the new list
good|s/^# estimator [0-9]*/# estimator 999/|otherwise||1|no|a list of another estimator
END
[ "$(grep -c '^[0-9]' "$dir/good")" = 2 ] || { echo "hashes.sh: new lines are not listed"; exit 1; }
echo "hashes.sh: other pictures need another estimator"

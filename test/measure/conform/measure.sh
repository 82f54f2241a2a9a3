#!/bin/sh
# measure.sh: what the kit's verdicts are worth, as doc/conformance.md shows it.
#   sh test/measure/conform/measure.sh alarms [RUNS [SPP]]   tables of correct pictures, by bdpt and asbdpt in turn, with seeds
#                                                    of their own: in how many does a scene differ?
#   sh test/measure/conform/measure.sh power [FAULT [SPP]]   each fault of test/measure/power.txt in src/transport, of that size (.02),
#                                                    planted in bdpt: in which scenes is it found?
set -u
work=${TMPDIR:-/tmp}/conform-measure.$$
mkdir "$work" || exit 1
trap 'rm -rf "$work"' EXIT

alarms() {
    for i in $(seq "$1"); do
        method=$([ $((i % 2)) = 0 ] && echo bdpt || echo asbdpt)
        SEED=$((100000 + 8 * i)) sh test/measure/conform/kit.sh ours "$work/run" "$method" 8 "$2"
        rm -rf "$work/run"
    done >"$work/said"
    awk '/DIFFERS$/ { print; n += !alarm; alarm = 1 } /^[0-9]+ scenes:/ { runs++; doubt += $8; alarm = 0 }
        END { print n + 0, "of", runs,
            "tables have a scene that differs; of", doubt, "scenes it cannot tell" }' "$work/said"
}
# power FAULT SPP: the faults are numbered, as names for apply.sh.
power() {
    mkdir "$work/tree"
    cp -Rp Makefile src test doc "$work/tree/"
    awk '/^[^-+# \t]/ { n++; $1 = "fault" n } { print }' test/measure/power.txt >"$work/list.txt"
    for name in $(awk '$2 ~ /src.transport/ { print $1 }' "$work/list.txt"); do
        rm -rf "$work/tree/src" && cp -Rp src "$work/tree/"
        sh test/data/mutants/apply.sh "$work/list.txt" "$name" "$work/tree" || exit 1
        make -s -j2 -C "$work/tree" LTO= CFLAGS="-DFAULT=$1" asbdpt-lab >"$work/said" 2>&1 || exit 1
        awk -v name="$name" '$1 == name { $1 = $2 = $3 = ""; print "==", $0 }' "$work/list.txt"
        PROGRAM=$work/tree/asbdpt-lab sh test/measure/conform/kit.sh ours "$work/$name" bdpt 8 "$2" |
            grep -E 'DIFFERS|scenes'
    done
}
case ${1-} in
alarms) alarms "${2:-200}" "${3:-8}" ;;
power) power "${2:-.02}" "${3:-256}" ;;
*) sed -n '2,6s/^# *//p' "$0"; exit 2 ;;
esac

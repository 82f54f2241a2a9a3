#!/bin/sh
# run.sh: fuzz targets one after the other, from the top, after `make fuzz`:
#   sh test/fuzz/run.sh [SECONDS [TARGET...]]
#   sh test/fuzz/run.sh pack FILE...    prints inputs as lines to be kept in test/fuzz/corpus.txt, below "== TARGET"
# Starts from the corpus and the fixtures; inputs of new coverage gather in build-fuzz/corpus/TARGET, inputs that
# break something are build-fuzz/TARGET-crash-... (or -timeout-, -oom-, -leak-). Ends with 1 if there are any.
# Such a line is a format of printf: plain characters, and octal numbers for all others.
if [ "${1-}" = pack ]; then
    shift
    for file; do
        od -An -v -to1 "$file" | LC_ALL=C awk '
            BEGIN { for (i = 32; i < 127; i++) plain[sprintf("%03o", i)] = sprintf("%c", i); delete plain["045"] }
            BEGIN { delete plain["134"] } # the percent sign and the backslash
            { for (i = 1; i <= NF; i++) printf "%s", $i in plain ? plain[$i] : "\\" $i }
            END { print "" }'
    done
    exit
fi
# unpack TARGET DIRECTORY
unpack() {
    awk -v target="$1" '/^== / { on = $2 == target; next } on' test/fuzz/corpus.txt | while IFS= read -r line; do
        # shellcheck disable=SC2059
        n=$((${n-0} + 1)) && printf "$line" >"$2/$n"
    done
}
seconds=${1:-60}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- $(sed -n 's/^== //p' test/fuzz/corpus.txt)
for target; do
    corpus=build-fuzz/corpus/$target seeds=build-fuzz/seeds/$target words=
    mkdir -p "$corpus" "$seeds"
    unpack "$target" "$seeds"
    case $target in
    scene)
        sh scenes/unpack.sh test/data/fixtures/scenes.txt "$seeds"
        { # words: whatever the sources quote, and some numbers
            grep -oh '"[A-Za-z][A-Za-z0-9]*"' src/*/*.[ch] | sort -u
            printf '"%s"\n' ' [ 0 1 2 ]' -1 1e-308 1e30 1e308
        } >build-fuzz/scene.dict
        words=-dict=build-fuzz/scene.dict
        ;;
    exr | pfm) sh scenes/unpack.sh test/data/fixtures/pictures "$seeds" ;;
    esac
    TARGET=$target nice -n 15 build-fuzz/fuzz -fork=1 -ignore_crashes=1 -ignore_timeouts=1 -ignore_ooms=1 -timeout=60 \
        -rss_limit_mb=1500 -max_len=4096 $words -max_total_time="$seconds" -artifact_prefix="build-fuzz/$target-" \
        "$corpus" "$seeds" || exit 1
    rm -rf /dev/shm/asbdpt-fuzz-* /tmp/asbdpt-fuzz-* # of processes that have ended
done
ls build-fuzz/*-crash-* build-fuzz/*-timeout-* build-fuzz/*-oom-* build-fuzz/*-leak-* 2>/dev/null && exit 1
exit 0

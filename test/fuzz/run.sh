#!/bin/sh
# run.sh: fuzz targets one after the other: sh test/fuzz/run.sh [SECONDS [TARGET...]], from the top, after `make fuzz`.
# Starts from test/fuzz/corpus and the fixtures; inputs of new coverage gather in build-fuzz/corpus/TARGET, inputs that
# break something are build-fuzz/TARGET-crash-... (or -timeout-, -oom-, -leak-). Ends with 1 if there are any.
seconds=${1:-60}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- $(ls test/fuzz/corpus)
for target; do
    corpus=build-fuzz/corpus/$target
    mkdir -p "$corpus"
    case $target in
    scene) seeds=test/fixtures words=-dict=test/fuzz/scene.dict ;;
    exr | hdr | pfm) seeds=test/fixtures/pictures words= ;;
    *) seeds= words= ;;
    esac
    TARGET=$target nice -n 15 build-fuzz/fuzz -fork=1 -ignore_crashes=1 -ignore_timeouts=1 -ignore_ooms=1 -timeout=60 \
        -rss_limit_mb=1500 -max_len=4096 $words -max_total_time="$seconds" -artifact_prefix="build-fuzz/$target-" \
        "$corpus" "test/fuzz/corpus/$target" $seeds || exit 1
    rm -rf /dev/shm/asbdpt-fuzz-* /tmp/asbdpt-fuzz-* # of processes that have ended
done
ls build-fuzz/*-crash-* build-fuzz/*-timeout-* build-fuzz/*-oom-* build-fuzz/*-leak-* 2>/dev/null && exit 1
exit 0

#!/bin/sh
# layers_test.sh [CC...]: does layers.sh notice? Plants an include upwards, a circle, a homeless file and a header that
# needs another one into copies of src.
[ $# -gt 0 ] || set -- cc
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
failures=0

# plant WORD LINE FILE: with LINE at the end of FILE, layers.sh must fail and say WORD.
plant() {
    rm -rf "$dir/src"
    cp -r src "$dir/src"
    printf '%s\n' "$2" >>"$dir/src/$3"
    word=$1
    if sh test/layers.sh "$dir/src" true >"$dir/out" || ! grep -q "$word" "$dir/out"; then
        echo "layers.sh does not notice: $2 in $3"
        failures=1
    fi
}
plant 'may not include' '#include "cli/command.h"' base/vec.h
plant 'in a circle' '#include "base/alias.h"' base/mem.h
plant 'in no room' '#include "nowhere/x.h"' base/vec.h
plant 'not in a room' '' loose.c
plant 'is in no room' '#include "lab/verify.h"' look/compare.h # the renderer knows nothing of the laboratory
rm -rf "$dir/lab"
cp -r test/lab "$dir/lab"
echo '#include "lab/plan.h"' >>"$dir/lab/methods.h"
if ABOVE=$dir/lab sh test/layers.sh src true >"$dir/out" || ! grep -q 'in a circle' "$dir/out"; then
    echo "layers.sh does not notice a circle in the room above"
    failures=1
fi

rm -rf "$dir/src"
mkdir -p "$dir/src/base"
echo base >"$dir/src/LAYERS"
echo 'size_t n_things;' >"$dir/src/base/things.h"
if sh test/layers.sh "$dir/src" "$@" >"$dir/out" 2>&1 || ! grep -q 'does not compile alone' "$dir/out"; then
    echo "layers.sh does not notice a header that needs another one"
    failures=1
fi
[ $failures -eq 0 ] && echo "layers: as expected, and planted faults are found"
exit $failures

#!/bin/sh
# add_method.sh: is a method one file and one row? Takes the code of doc/add-a-method.md, plants it in a copy of the
# tree with nothing else edited, builds, and finds the method in --help, render, trace, equal-time and verify,
# which accepts it, and rejects it with a planted fault. BUILD names a build directory to begin with.
build=${BUILD:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir "$dir/doc" && cp -R -p Makefile src scenes ref test "$build" "$dir" && cp -R -p doc/*.md "$dir/doc" || exit 1
must() { "$@" >"$dir/log" 2>&1 || { echo "FAIL: $*"; cat "$dir/log"; exit 1; }; }
says() { grep -q "$1" "$dir/log" || { echo "FAIL: no \"$1\" in:"; cat "$dir/log"; exit 1; }; }

# The code of the page, and its row.
sed -n '/^```c$/,/^```$/p' doc/add-a-method.md | sed '1d;$d' >"$dir/test/lab/rivals/resampling.c"
awk '/^const struct method \*const method_rows\[\] = {/ {
        print "extern const struct method method_resampling;"
        sub(/{/, "{\\&method_resampling, ")
    }
    { print }' test/lab/rows.c >"$dir/test/lab/rows.c"
cd "$dir" || exit 1
must make BUILD="$build" LTO= -o "$build/flags"
must ./asbdpt-lab help integrators
says 'resampling'
says 'candidates'
must ./asbdpt-lab render scenes/cornell-box.pbrt --integrator resampling -P candidates=2 --quick -o x.pfm
must ./asbdpt-lab trace scenes/cornell-box.pbrt --integrator resampling --pixel 32,32
says 'CHOICE'
must ./asbdpt-lab verify scenes/cornell-box.pbrt --methods pt,resampling --res 24x24 --spp 64 --quiet
says 'agree'
must ./asbdpt-lab equal-time scenes/cornell-box.pbrt --methods bdpt,resampling:candidates=2 --seeds 6 --spp 32 --res 32x32 \
    --quiet -o equal
says 'resampling:candidates=2'
if grep -q '^- In cornell-box, ' log; then echo "FAIL: it is marked:"; cat log; exit 1; fi
cp test/lab/rivals/resampling.c whole.c
sed 's/L \* M \//L \//' whole.c >test/lab/rivals/resampling.c
must make BUILD="$build" LTO= -o "$build/flags"
if ./asbdpt-lab verify scenes/cornell-box.pbrt --methods pt,resampling --res 24x24 --spp 64 --quiet >log 2>&1; then
    echo "FAIL: a method without 1/M is accepted"
    exit 1
fi
says 'DIFFER'
echo "a method is one file and one row"

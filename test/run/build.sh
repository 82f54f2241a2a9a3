#!/bin/sh
# build.sh: what make leaves is never older than what it is made of: sources, headers, the list of files, the compiler
# and its flags. The real Makefile builds programs that say a number, which comes from all of these.
. test/run/expect.sh
unset MAKEFLAGS MAKELEVEL
cc=${CC:-cc}
mkdir -p src/base src/cli test/lab test/fuzz test/unit test/run
cp "$top/Makefile" . && cp "$top/test/run/compiler.sh" test/run && cp "$top/test/unit/suites.awk" test/unit
program() {
    printf '#include <stdio.h>\n#include "base/word.h"\nint main(void) { return printf("%%d\\n", word()) < 0; }\n'
}
for file in src/cli/program.c test/lab/main.c test/unit/main.c; do program >$file; done
for file in test/fuzz/targets.c test/fuzz/hostile.c test/fuzz/lists.c; do echo 'typedef int none;' >$file; done
# write_header NUMBER, write_source NUMBER: what is said is their sum, and what the compiler defines.
write_header() { printf 'enum { HEADER = %s };\nint word(void);\n' "$1" >src/base/word.h; }
write_source() {
    printf '#include "base/word.h"\n#ifndef FLAG\n#define FLAG 0\n#endif\n' >src/base/word.c
    echo "int word(void) { return HEADER + $1 + FLAG; }" >>src/base/word.c
}
# builds NUMBER OPTION...: make does, and the tests are not older than the programs.
builds() {
    number=$1
    shift
    expect 0 '' "${MAKE:-make}" "$@"
    for made in ./asbdpt ./asbdpt-lab build/test; do
        [ "$($made)" = "$number" ] || fault "after $what, make $*: $made says $($made), not $number"
    done
}

write_header 100 && write_source 1
what="nothing was built"
expect 0 '' "${MAKE:-make}" CC="$cc"
check [ ! -e build/test ]
expect 0 '' "${MAKE:-make}" CC="$cc" build/test
builds 101 CC="$cc"
check [ "$(grep -c '^  ' stdout.txt)" = 0 ] # nothing is built again
what="an edit of a source"
write_source 2
builds 102 CC="$cc"
check [ "$(grep -c 'obj/' stdout.txt)" = 1 ] # no other is compiled again
what="an edit of a header"
write_header 200
builds 202 CC="$cc"
what="other flags"
builds 212 CC="$cc" CFLAGS=-DFLAG=10
builds 202 CC="$cc"
what="another compiler"
printf '#!/bin/sh\nexec %s -DFLAG=20 "$@"\n' "$cc" >compiler
chmod +x compiler
builds 222 CC=./compiler
what="another version of the compiler"
printf '#!/bin/sh\n[ "$1" != --version ] || { echo 2; exit; }\nexec %s -DFLAG=30 "$@"\n' "$cc" >compiler
builds 232 CC=./compiler
what="a compiler that does not write which headers a file includes"
printf '#!/bin/sh\nfor option; do [ "$option" != -MMD ] || exit; done\nexec %s "$@"\n' "$cc" >compiler
builds 202 CC=./compiler
write_header 300
builds 302 CC=./compiler
write_header 200
what="the other of two compilers"
for other in gcc clang gcc; do
    ! command -v $other >/dev/null || builds 202 CC=$other
done
what="no optimisation of the whole"
builds 202 LTO=
what="such optimisation"
builds 202 CC="$cc" V=1
[ -z "$(sh test/run/compiler.sh lto $cc)" ] || says '-fno-lto.* -o build/test '
what="a file that is gone"
mv src/base/word.c word.c
expect 2 'word' "${MAKE:-make}" CC="$cc"
mv word.c src/base

# make demo says the error that its picture shows, rmse8 of runs.csv, of which noise is known, and ends with what to open.
mkdir -p ref/demo scenes
echo 'noise8 1.79' >ref/demo/corridor.txt
cat >measures.sh <<'END'
mkdir -p out/demo/images && : >out/demo/images/corridor.png
printf 'scene,method,seed,spp,seconds,rmse8,mean_error,mse8\ncorridor,bdpt,7,48,15.53,13.98,0.1,192.3\n' >out/demo/runs.csv
END
expect 0 '' "${MAKE:-make}" CC="$cc" LTO= demo LAB='sh measures.sh'
says '^bdpt: 48 samples in 15.5 s of CPU, rmse8 14.0$' '^rmse8: .* the noise of the reference, 1.8, is part of it$'
check [ "$(tail -n 1 stdout.txt)" = "wrote out/demo.png; curves: out/demo/report.html" ]
check [ -e out/demo.png ]

# How long lines, pages and the tree are is told by make tidy, which is no test.
expect 0 '' "${MAKE:-make}" -n test
check [ -z "$(grep -E 'tree_stats|words\.sh|columns' stdout.txt)" ]
[ $failures -eq 0 ] && echo "build: all as expected"
exit $((failures > 0))

#!/bin/sh
# progress.sh PROGRAM: what may take long shows on a terminal how far it is, on stderr. In a file there is no bar.
# BRIEF=yes: of the commands render and what is shown by scripts alone.
. test/run/expect.sh
export program lab box
mkdir test
for name in ref scenes test/measure; do ln -s "$top/$name" $name; done
terminal=yes
script -qec true typescript >/dev/null 2>&1 </dev/null || terminal= # util-linux has it so
[ -n "$terminal" ] || echo "skipped: bars on a terminal (no such command: script -qec)"

# bars PATTERN COMMAND [file]: its bar moves, and its lines end so (extended regular expression). file: and none is
# written into a file, which is decided in one place for all (base/progress.c), and without a terminal is all to see.
bars() {
    bar="^\\[=* *\\] +[1-9][0-9]* %$1 *\$"
    echo "$2" >run.sh
    if [ -n "${3-}" ] || [ -z "$terminal" ]; then
        sh run.sh >stdout.txt 2>stderr.txt </dev/null || fault "$2 ends with $?: $(cat stderr.txt)"
        ! tr '\r' '\n' <stderr.txt | grep -q '^\[=* *\]' || fault "$2 has a bar in a file"
    fi
    [ -n "$terminal" ] || return 0
    script -qec 'sh run.sh >stdout.txt' typescript >/dev/null </dev/null || fault "$2 ends with $?: $(cat typescript)"
    tr '\r' '\n' <typescript | grep -Eq "$bar" || fault "$2 shows no bar that ends in $1: $(cat typescript)"
    ! tr '\r' '\n' <stdout.txt | grep -Eq "$bar" || fault "$2 has a bar in its standard output"
}
left='(, [0-9]+ (s|min.*) left)?'
long() { [ -n "${BRIEF-}" ] || bars "$@"; } # whose bars no script has a part in
bars "$left" '"$program" render "$box" --res 60 --spp 8 -j 1 -o box.pfm' file
long "$left" '"$lab" strategies "$box" --res 48 --spp 16 -j 1 --maxdepth 3 -o strategies'
long "$left" '"$lab" transient "$box" --res 48 --spp 16 -j 1 -o flight'
long "$left" '"$lab" bench "$box" --spp 1'
export PROGRAM="$lab" LAB="$lab"
bars ", (area|mirror)$left" 'rm -rf shown; sh test/measure/conform/kit.sh ours shown bdpt 4 16 area mirror'
mkdir kit # black pictures of all scenes
for name in $(sed '/^#/d; s/ .*//' ref/conform/list.txt); do
    { printf 'Pf\n32 32\n-1\n' && head -c 4096 /dev/zero; } >"kit/$name.pfm"
done
bars "$left" '"$lab" conform kit || [ $? = 1 ]'
bars ", second, [0-9]+ s left" '{ echo first; sleep 3; echo second; } | "$lab" progress --parts 3' file
# What must not pass.
if [ -n "$terminal" ]; then
    bars "$left" '"$program" render "$box" --quiet --res 60 --spp 8 -j 1 -o box.pfm' >told.txt
    [ $failures -gt 0 ] && grep -q 'shows no bar' told.txt && failures=$((failures - 1)) ||
        fault "no bar is not noticed"
fi
[ $failures -eq 0 ] && echo "progress: all as expected"
[ $failures -eq 0 ]

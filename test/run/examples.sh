#!/bin/sh
# examples.sh PROGRAM: every example in the help of every command, of both programs, does what it says: it ends with 0,
# makes what it names in out/, and leaves nothing elsewhere. What an example reads and the tree does not have is made
# before. Those that take seconds are shortened, unless FULL=yes, or with BRIEF=yes left out.
. test/run/expect.sh
for entry in "$top"/*; do
    case ${entry##*/} in out | build* | asbdpt | asbdpt-lab) ;; *) ln -s "$entry" . ;; esac
done
mkdir bin out
ln -s "$program" bin/asbdpt
ln -s "$lab" bin/asbdpt-lab
PATH=$PWD/bin:$PATH

for k in 0 1; do
    expect 0 '' asbdpt render scenes/spot.pbrt --quick --spp 2 --samples $k:$((k + 1)) --integrator bdpt -o out/$k.part
done
expect 0 '' asbdpt-lab render scenes/forest.pbrt --quick --integrator pt --lights out/forest -o out/forest.png
expect 0 '' env LAB=asbdpt-lab PROGRAM=asbdpt-lab sh test/measure/conform/kit.sh ours out/conform bdpt 1 1

brief=${BRIEF-}
# examples HELP: in this file of a command's help there is an example, and all that there are can be run.
examples() {
    n=0
    sed -n 's/^ e\.g\.: //p' "$1" >lines.txt
    while IFS= read -r line; do
        n=$((n + 1)) shorter=
        case $line in "asbdpt-lab "equal-time* | "asbdpt-lab "family* | "asbdpt-lab "experiment*)
            shorter=" --spp 1 --res 8 --seeds 3 --reference-spp 4 --methods bdpt,asbdpt" ;;
        *" render "* | "asbdpt-lab "worth* | "asbdpt-lab "bench*) shorter=" --spp 1" ;;
        "asbdpt-lab "strategies* | "asbdpt-lab "transient*) shorter=" --spp 1 --res 24" ;;
        esac
        [ -z "${FULL-}" ] || shorter=
        [ -z "$brief" ] || case $line$shorter in *--spp* | *" conform "* | *" trace "*) continue ;; esac
        ls -A >before.txt
        sh -c "$line$shorter" >said.txt 2>&1 </dev/null || fault "$line ends with $?: $(tail -n 3 said.txt)"
        ls -A >after.txt
        cmp -s before.txt after.txt || fault "$line leaves something outside of out/: $(comm -13 before.txt after.txt)"
        for word in $line; do
            case $word in out/*) [ -s "$word" ] || fault "$line does not make $word" ;; esac
        done
    done <lines.txt
    [ $n -gt 0 ] || fault "no example in: $(head -n 1 "$1")"
}

all=0
touch before.txt after.txt said.txt lines.txt help.txt
for name in asbdpt asbdpt-lab; do
    expect 0 '' $name --help
    sed -n 's/^    \([a-z][a-z-]*\) .*/\1/p' stdout.txt >commands.txt
    while read -r command; do
        $name "$command" --help >help.txt
        examples help.txt
        all=$((all + 1))
    done <commands.txt
done
[ $all -gt 15 ] || fault "$all commands"

brief=
# What must not pass: one that fails, one that makes nothing, one that leaves something, none.
for bad in ' e.g.: asbdpt-lab worth scenes/veach-ajar.pbrt --pixel 24,20 -P select=pool -o out/x.png' \
    ' e.g.: asbdpt --version >/dev/null # out/nothing.png' ' e.g.: asbdpt --version >left.txt' 'usage: asbdpt'; do
    before=$failures
    echo "$bad" >help.txt
    examples help.txt >told.txt
    [ $failures -gt $before ] && failures=$before || failures=$((before + 1))
    [ $failures = $before ] || echo "FAIL: not noticed: $bad"
done
[ $failures -eq 0 ] && echo "examples: $all commands, each as its help says"
[ $failures -eq 0 ]

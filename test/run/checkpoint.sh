#!/bin/sh
# checkpoint.sh: nothing rendered is lost: signals, time limits, checkpoints, parts, and a program that is killed.
# Run from the top: sh test/run/checkpoint.sh ./asbdpt [KILLS]    (10 kills unless said otherwise)
. test/run/expect.sh
kills=${2:-${BRIEF:+2}}
kills=${kills:-10}

same() { cmp -s "$1" "$2" || fault "$1 and $2 differ, $3"; }
no_temporaries() { [ -z "$(find . -name '.asbdpt-*')" ] || fault "temporary files are left: $1"; }
# work_in FILE: thousandths of samples and tile passes that a checkpoint or a part holds; 0 if there is none.
work_in() {
    [ -e "$1" ] || { echo 0; return; }
    LC_ALL=C awk '/^done / { print 1000 * $2 + $3; exit }' "$1"
}
# wait_until COMMAND...: until it succeeds. Status 1: it has not within a minute.
wait_until() {
    i=0
    until "$@"; do
        i=$((i + 1))
        [ $i -lt 3000 ] || return
        sleep 0.02
    done
}
# hold COMMAND...: let the program in the background work in steps until the command succeeds, and stop it there: it is
# not far beyond that, however busy the machine is. release [SIGNAL...]: give it these signals at once, and let it go.
hold() { wait_until held "$@"; }
held() { kill -s STOP $! && { "$@" || { kill -s CONT $!; false; }; }; }
release() {
    for signal in "$@" CONT; do kill -s "$signal" $!; done
}

# ---- every integrator, which the laboratory has: parts add up to the whole, and a checkpoint goes on to it ----
size="--res 8x12 --spp 70 --maxdepth 3 --quiet"
while read -r cuts options; do
    # shellcheck disable=SC2086
    {
        rm -f ./*.part
        check "$lab" render "$box" $size $options -j 2 -o whole.part -o whole.pfm
        from=
        for to in $(echo "$cuts" | tr , ' '); do
            [ -z "$from" ] || check "$lab" render "$box" $size $options -j 1 --samples "$from:$to" -o "part$to.part"
            from=$to
        done
        set -- part*.part
        makes whole.pfm "$lab" merge "$@" --quiet -o sum.part -o sum.pfm
        same whole.part sum.part "$options in parts"
        rm -f state
        rm -f early.part
        "$lab" render "$box" $size $options -j 3 --time 1e-6 --checkpoint state -o early.part 2>stderr.txt
        case $?,$options in
        1,*asbdpt* | 1,*lvc | 1,*cbdpt | 1,*mbdpt | 1,*ris*) # they learn, unless the time is over after that
            check grep -q 'early.part: learning was cut short' stderr.txt
            check [ ! -e early.part ]
            ;;
        0,*)
            check grep -q 'at [0-9]* of 70' stderr.txt
            same state early.part "a checkpoint and a part"
            ;;
        *) fault "$options: no time for a sample: $(cat stderr.txt)" ;;
        esac
        makes whole.pfm "$lab" render "$box" $size $options -j 2 --resume state -o sum.part -o sum.pfm
        same whole.part sum.part "$options resumed"
    }
done <<'END'
0,3,33,70 --integrator pt
0,69,70 --integrator lt
0,32,64,70 --integrator bdpt --filter gaussian
0,32,64,70 --integrator asbdpt -P select=bins
0,1,70 --integrator asbdpt -P select=pool
0,40,70 --integrator asbdpt -P select=vertices
0,7,41,70 --integrator asbdpt
0,40,70 --integrator lvc
0,40,70 --integrator cbdpt
0,40,70 --integrator mbdpt
0,40,70 --integrator ris
0,40,70 --integrator ris2
END
check [ "$(work_in whole.part)" = 70000 ]

# ---- lights that are kept apart, alpha and variance are no part of a part, but means of those of parts ----
hidden=$top/test/data/fixtures/parts/hidden.pbrt lit="$size --integrator bdpt --lights lit"
check "$lab" render "$hidden" $lit -o whole.pfm
cp lit/light01_key.pfm whole.light.pfm
for range in 0:32 32:70; do
    check "$lab" render "$hidden" $lit --samples $range -o $range.part
    cp lit/light01_key.pfm $range.pfm
done
makes whole.pfm "$program" merge 32:70.part 0:32.part --quiet -o sum.pfm
check "$lab" sum 0:32.pfm 32:70.pfm --weights 0.457142857,0.542857143 -o sum.pfm --quiet
check "$lab" compare sum.pfm whole.light.pfm --max-rmse 1e-6
for option in '--lights lit' --alpha '--aov variance'; do
    expect 1 'are not saved and cannot be resumed' "$lab" render "$hidden" $size $option --resume 0:32.part -o x.png
done

# ---- the same command again: what is done is done, also if bins do not end with a block ----
for samples in "--samples 64:70" ""; do
    rm -f state
    for time in first second; do
        check "$program" render "$box" $size --integrator asbdpt -P select=bins $samples -o $time.part \
            --checkpoint state --resume state
    done
    same first.part second.part "done again $samples"
done
expect 1 'the film ends at sample 70: here they come in blocks of 32' \
    "$program" render "$box" $size --integrator asbdpt -P select=bins --spp 96 --resume first.part -o x.pfm

# ---- a picture is gone on with, parts are of one whole: each learns the same, more than of 24 samples ----
rm -f state
check "$program" render "$box" $size --integrator asbdpt --spp 400 -o whole.pfm
check "$program" render "$box" $size --integrator asbdpt --spp 24 -o x.pfm --checkpoint state
makes whole.pfm "$program" render "$box" $size --integrator asbdpt --spp 400 --checkpoint state --resume state -o x.pfm
check "$program" render "$box" $size --integrator asbdpt --spp 24 -o x.pfm --checkpoint short
check "$program" render "$box" $size --integrator asbdpt --spp 400 --time 1e-6 -o x.pfm --checkpoint short \
    --resume short
check [ "$(work_in short)" -gt 0 ] # which is not lost when the time is over before all is learnt anew
makes whole.pfm "$program" render "$box" $size --integrator asbdpt --spp 400 --resume short -o x.pfm
rm -f state short
check "$program" render "$box" $size --integrator asbdpt --spp 400 --time 1e-6 -o x.pfm --checkpoint none
[ "$(work_in none)" -gt 0 ] || expect 1 'the parts hold no samples' "$program" merge none -o x.part
expect 1 'samples 0:40: here they come in blocks of 32' \
    "$program" render "$box" $size --integrator asbdpt -P select=bins --samples 0:40 -o x.part
expect 2 '[-]-samples needs -o NAME.part' "$program" render "$box" $size --samples 0:7

# ---- a full disk, here a limit of the size of files: one warning for all previews, and one for all checkpoints ----
expect 1 '^asbdpt: full.state: cannot be written: ' sh -c "ulimit -f 8 && exec \"\$@\"" sh "$program" render "$box" \
    --res 64x64 --spp 100000 --maxdepth 2 --time 2 --quiet --preview 0.05 --checkpoint full.state --interval 0.05 \
    -o full.pfm
check [ "$(grep -c 'warning: full.pfm: cannot be written: .*; rendering goes on' stderr.txt)" = 1 ]
check [ "$(grep -c 'warning: full.state: cannot be written: .*; rendering goes on' stderr.txt)" = 1 ]
check [ ! -e full.pfm -a ! -e full.state ]
no_temporaries "full disk"

# ---- parts that do not fit ----
tiny="--integrator pt --maxdepth 2 --quiet"
part() { # NAME OPTIONS...
    name=$1
    shift
    check "$program" render "$box" $tiny --res 8x8 --spp 8 "$@" -o "$name"
}
part a.part --samples 0:3
part b.part --samples 3:8
part c.part --samples 5:8
part other.part --samples 3:8 --seed 1
sed 's/^# /#  /' "$box" >changed.pbrt
expect 0 'wrote x.part$' "$program" merge -o x.pfm -o x.part b.part a.part
makes x.pfm "$program" merge x.part -o z.pfm
rm -f x.pfm
expect 1 'missing are the samples 3:5' "$program" merge -o x.pfm a.part c.part
expect 1 'missing are the samples 3:8' "$program" merge -o x.pfm a.part
expect 1 'c.part: other parts have the samples 5:8' "$program" merge -o x.pfm a.part b.part c.part
expect 1 'other.part: a part of another image: it has "seed 1", not "seed 0"' \
    "$program" merge -o x.pfm a.part other.part
expect 0 '' "$program" merge --partial -o partial.pfm a.part
check [ ! -e x.pfm ]
"$program" render changed.pbrt $tiny --res 8x8 --spp 8 --samples 3:8 -o foreign.part
expect 1 'foreign.part: a part of another image: it has "scene' "$program" merge -o x.pfm a.part foreign.part
expect 1 '^asbdpt: b.part: ' "$program" render "$box" $tiny --res 8x8 --spp 8 --resume b.part -o x.pfm
expect 1 'the file exists already' "$program" render "$box" $tiny --checkpoint a.part -o x.pfm
check [ ! -e x.pfm ]
no_temporaries "after errors"

# ---- a checkpoint that is made is written again, whatever has become of it meanwhile ----
"$program" render "$box" --integrator bdpt --res 80x80 --spp 8 --maxdepth 3 --quiet -j 1 --checkpoint state \
    --interval 0 -o kept.pfm 2>stderr.txt &
hold [ -e state ]
echo other >other
mv other state
release
wait $! || fault "a render whose checkpoint was replaced: $(cat stderr.txt)"
check [ "$(work_in state)" = 8000 ]
check [ ! -s stderr.txt ]

# ---- a preview: whole pictures, one after the other, of the samples so far; the last has the bytes of none before ----
size="--integrator bdpt --res 56x56 --maxdepth 3 --quiet"
newer() { ! cmp -s seen.pfm first.pfm; }
check "$program" render "$box" $size --spp 24 -o whole.pfm
makes whole.pfm "$program" render "$box" $size --spp 24 --preview 0.01 -o x.pfm
near() { # the picture so far is about as bright as the whole one: on a slow machine the first ones are not
    [ -s seen.pfm ] && cp seen.pfm $picture.pfm && "$lab" compare $picture.pfm whole.pfm >stdout.txt 2>/dev/null &&
        awk '$1 == "mean_ratio" && $2 > 0.8 && $2 < 1.25 { near = 1 } END { exit !near }' stdout.txt
}
"$program" render "$box" $size --spp 1000000 -j 2 --preview 0.1 --time 100 -o seen.pfm -o late.pfm 2>stderr.txt &
for picture in first second; do # far from the end of the render
    hold near || fault "the preview is not of the samples so far"
    check [ ! -e late.pfm ]
    release
    [ $picture = second ] || wait_until newer || fault "the preview stays as it was"
done
kill -s KILL $!
wait $! 2>/dev/null
check [ ! -s stderr.txt ]
rm -f .asbdpt-* seen.pfm
# While a method learns there is none.
"$program" render "$box" --integrator asbdpt --res 200x200 --spp 1000000 --quiet --preview 1e-9 -o seen.pfm &
hold [ -s seen.pfm ]
expect 0 '' "$lab" info seen.pfm
says '^R .* to [0-9.]*[1-9]'
kill -s KILL $!
wait $! 2>/dev/null
rm -f .asbdpt-*
for name in - x.part; do
    expect 2 'the first output must be an image file' "$program" render "$box" $size --spp 1 --preview 1 -o $name
done

# ---- signals ----
# heard SIGNAL...: do they end a program here? One does not if the parent ignores it, as nohup does.
heard() {
    for signal; do
        { sh -c "kill -s $signal \$\$"; } 2>/dev/null && echo "skipped: SIG$signal (it is ignored here)" && return 1
    done
    true
}
# stopped STATUS SIGNALS CONDITION SAYS OPTION...: its render gets the signals when the condition, a command, is met. It
# must end with the status (extended regexp), say that it is stopping and what it has reached, write a picture, and
# leave no temporary file. One that does not hear them is the end of this.
stopped() {
    wanted=$1 signals=$2 condition=$3 says=$4
    shift 4
    heard $signals || return
    rm -f caught.pfm
    "$program" render "$box" --quiet "$@" -o caught.pfm 2>stderr.txt &
    hold $condition
    release $signals
    wait_until grep -q 'asbdpt: stopped' stderr.txt || {
        kill -s KILL $!
        fault "$signals: not heard: $*"
        exit 1
    }
    wait $!
    got=$?
    echo $got | grep -Eqx "$wanted" || fault "$signals: status $got: $*"
    for line in 'stopping, and writing' "$says"; do
        grep -Eq "^asbdpt: .*$line" stderr.txt || fault "$signals: no \"$line\" in $(cat stderr.txt): $*"
    done
    [ -s caught.pfm ] || fault "$signals: no picture: $*"
    no_temporaries "$*"
}
# A render stops between two tile passes and goes on from there to the same bytes.
size="--integrator bdpt --res 80x80 --spp 24 --maxdepth 3 --quiet"
check "$program" render "$box" $size -o whole.pfm -o whole.part
rm -f state
further() { [ "$(work_in state)" -gt "$at" ]; }
for pair in TERM:143 HUP:129 TERM:143; do
    at=$(work_in state)
    stopped "${pair#*:}" "${pair%:*}" further "stopped by SIG${pair%:*}, at [0-9]+ of 24" $size -j 2 \
        --checkpoint state --resume state --interval 0.02
    expect 0 '' "$lab" compare caught.pfm whole.pfm
    check awk '$1 == "mean_ratio" && $2 < 1.1 { near = 1 } END { exit !near }' stdout.txt
done
makes whole.pfm "$program" render "$box" $size --resume state --checkpoint state -o sum.part -o sum.pfm
same whole.part sum.part "after signals"
# Also to more samples than were asked for at first, which other blocks hold.
size="--integrator bdpt --res 180x180 --maxdepth 3 --quiet"
rm -f state
stopped 143 TERM '[ -e state ]' 'stopped by SIGTERM, at 0 of 2' $size --spp 2 -j 1 --checkpoint state --interval 0
check "$program" render "$box" $size --spp 6 -o whole.pfm
makes whole.pfm "$program" render "$box" $size --spp 6 --resume state -o x.pfm
# However large the picture is. Two signals at once are one wish.
rm -f state
stopped '143|129' 'TERM HUP' '[ -e state ]' \
    'stopped by SIG(TERM|HUP), at 0 of 16 samples per pixel, [0-9.]+ % of the pixels at 1$' \
    --integrator bdpt --res 1000x1000 --spp 16 --checkpoint state --interval 0.05
rm -f state
stopped 143 TERM '[ -e state ]' 'stopped by SIGTERM, at 0 of 16 samples per pixel, [0-9.]+ % of the pixels at 1$' \
    --integrator bdpt --res 1000x1000 --spp 16 --checkpoint state --interval 0.05
# Of a checkpoint that ends within a block merge makes what the render wrote, if it is asked to.
expect 1 'state: ends in the middle of a block of samples; --resume it first, or take --partial' \
    "$program" merge state -o early.pfm
expect 0 '' "$program" merge --partial state -o early.pfm
expect 0 '' "$lab" compare early.pfm caught.pfm --max-rmse 1e-6
# So it does of several, together with whole parts; their samples are not other parts', as far as they were to go.
split="--integrator lt --res 500x500 --spp 8 --maxdepth 2"
some() { [ "$(work_in $range.state)" -gt 100 ]; } # of 1024 tile passes
for range in 0:4 5:8; do
    stopped 143 TERM some 'stopped by SIGTERM, at 0 of [34] samples per pixel, [0-9.]+ % ' $split \
        --samples $range --checkpoint $range.state --interval 0.02
done
for range in 4:5 3:4; do check "$program" render "$box" $split --samples $range --quiet -o $range.part; done
expect 0 '' "$program" merge --partial 4:5.part 0:4.state 5:8.state -o early.pfm
expect 0 '' "$program" merge 4:5.part --partial -o whole.pfm
expect 0 '' "$lab" compare early.pfm whole.pfm
check awk '$1 == "mean_ratio" && $2 > 0.98 && $2 < 1.02 { near = 1 } END { exit !near }' stdout.txt
expect 1 '3:4.part: other parts have the samples 3:4' "$program" merge --partial 3:4.part 0:4.state -o early.pfm
cp 0:4.state same.state
expect 1 'same.state: other parts have the samples 0:4' "$program" merge --partial 0:4.state same.state -o early.pfm
# A signal while a method learns, when a checkpoint has no samples, ends that, and the picture is of what there is.
rm -f state
stopped 143 TERM '[ -e state ]' 'stopped by SIGTERM, at [0-9]+ of 1000000' --integrator asbdpt --res 200x200 \
    --spp 1000000 --checkpoint state --interval 0
# Interrupted by timeout, which signals the program and its group. A shell's background commands do not hear SIGINT.
if ! timeout --preserve-status 5 true 2>/dev/null; then
    echo "skipped: a render stopped by timeout (not installed)"
elif heard INT; then
    rm -f state caught.pfm
    { wait_until [ -e state ] && kill -s INT "$(cat pid)"; } &
    sh -c 'echo $$ >pid && exec "$@"' - timeout --preserve-status 60 "$program" render "$box" --integrator bdpt \
        --res 32x32 --spp 1000000 --quiet --checkpoint state --interval 0 -o caught.pfm 2>stderr.txt
    [ $? = 130 ] && grep -q 'stopped by SIGINT, at [0-9]* of' stderr.txt && [ -s caught.pfm ] ||
        fault "SIGINT: $(cat stderr.txt)"
fi
# A limit of CPU time, which comes again every second, here in the first tile pass, while it has no splats in the film:
# there is a picture, even if it is black.
echo 'WorldBegin LightSource "point" WorldEnd' >empty.pbrt
(
    ulimit -S -t 1 && ulimit -H -t 4 && ulimit -S -c 0
    "$program" render empty.pbrt --integrator asbdpt -P select=bins -P restart=0 --spp 1000000000 -j 1 --quiet \
        -o black.pfm 2>stderr.txt
    echo $? >status.txt
)
check [ "$(cat status.txt)" = 152 -o "$(uname)" != Linux ]
check grep -q 'stopped by SIGXCPU, at 0 of 1000000000 samples per pixel$' stderr.txt
check [ -s black.pfm ]
# A signal a second after the first ends the program, here while it writes to a reader that does not read, and leaves
# nothing behind however many outputs there are.
if heard TERM; then
    rm -f state
    mkfifo slow.pfm
    sleep 100 <slow.pfm &
    reader=$!
    "$program" render "$box" --integrator pt --res 160x160 --spp 100000 --quiet -j 1 --checkpoint state \
        --interval 0 -o slow.pfm $(awk 'BEGIN { while (i < 100) printf " -o m%d.pfm", i++ }') 2>stderr.txt &
    wait_until [ -s state ]
    kill -s TERM $!
    wait_until grep -q 'asbdpt: stopping' stderr.txt
    sleep 1.1
    check kill -s TERM $!
    wait $!
    got=$?
    kill $reader
    [ $got = 143 ] || fault "two signals: status $got"
    check [ ! -e m0.pfm -a ! -e m99.pfm ]
    no_temporaries "after two signals"
fi
# A time that is over ends a block that would take long.
expect 0 'at 0 of 64 samples per pixel, [0-9.]+ % of the pixels at 1$' \
    "$program" render "$box" --integrator bdpt --res 1000x1000 -j 1 --time 0.1 -o caught.pfm
# A sample that has begun is completed, however long it takes, and the message says so.
awk 'BEGIN { print "LookAt 0 0 -4 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 1"
    print "WorldBegin LightSource \"infinite\""
    print "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" MediumInterface \"a\" \"\" Material \"\""
    while (i++ < 3000) printf "Shape \"sphere\" \"float radius\" %.8f\n", 1 + i / 1e8; print "WorldEnd" }' >slow.pbrt
expect 0 'stopped after [0-9.]* s, when the samples that had begun were complete, at 0 of 9 samples' \
    "$program" render slow.pbrt --integrator bdpt --res 1x1 --spp 9 --maxdepth 4 -j 1 --time 0.01 -o caught.pfm
check grep -q 'the image is black: no sample is complete$' stderr.txt
# A reader that goes away.
{
    "$program" render "$box" $tiny --res 99x99 --spp 1 -o - 2>stderr.txt
    echo $? >status.txt
} | head -c 10 >/dev/null
check [ "$(cat status.txt)" = 1 ]
check grep -q 'asbdpt: standard output: cannot be written' stderr.txt
no_temporaries "after failed writes"

# ---- killed again and again ----
slow="--integrator asbdpt --res 48x48 --spp 8 --maxdepth 3 --quiet"
check "$program" render "$box" $slow -o unbroken.pfm
rm -f state
echo old >killed.pfm
n=0 at=0
while [ $n -lt "$kills" ]; do
    n=$((n + 1))
    "$program" render "$box" $slow -j $((n % 3 + 1)) --checkpoint state --resume state --interval 0.02 \
        -o killed.pfm 2>stderr.txt &
    [ $((n % 2)) = 0 ] || wait_until further # the others may be killed before they save anything
    sleep "$(awk -v seed=$n 'BEGIN { srand(seed); print 0.1 * rand() }')"
    kill -s KILL $! 2>/dev/null
    wait $! 2>/dev/null
    [ ! -s stderr.txt ] || fault "after kill $n: $(cat stderr.txt)"
    grep -q '^old$' killed.pfm || cmp -s killed.pfm unbroken.pfm || fault "kill $n has left a damaged picture"
    [ "$(work_in state)" -ge "$at" ] || fault "kill $n has lost work: $(work_in state), $at before"
    at=$(work_in state)
    if [ "$at" = 8000 ]; then # all is done: from the beginning again
        rm -f state
        echo old >killed.pfm
        at=0
    fi
done
makes unbroken.pfm "$program" render "$box" $slow --checkpoint state --resume state -o killed.pfm
[ $failures -eq 0 ] && echo "nothing rendered is lost: all as expected"
exit $((failures > 0))

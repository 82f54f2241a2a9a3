#!/bin/sh
# outputs.sh: no output takes another file's place, nothing is mixed or lost in silence, nothing is left behind.
# Run from the top: sh test/run/outputs.sh ./asbdpt
. test/run/expect.sh
export ASBDPT="$program" LAB="$lab"
tiny="--res 8x8 --spp 1 --maxdepth 2 --quiet"
render() { "$program" render scene.pbrt $tiny "$@"; }
files() { find . -type f ! -name 'std*.txt' ! -name '*.list' -exec cksum {} + | sort; }
# refused STATUS PATTERN COMMAND...: nothing has been written, removed or left.
refused() {
    files >before.list
    expect "$@"
    files | cmp -s - before.list || fault "$* has changed files"
}
cp "$box" scene.pbrt
check render -o a.pfm -o b.pfm
check render --samples 0:1 -o c.part

# ---- one name, two files ----
same='an output needs a name of its own'
mkdir sub
for outputs in '-o new.pfm --stats c --checkpoint c' '--stats - -o -'; do
    refused 2 "${outputs##* }: $same" render $outputs
done
for outputs in '--aov albedo -o x.pfm -o x.albedo.pfm' \
    '--lights sub -o sub/light00_area.pfm'; do # some names are known only when the scene is
    refused 2 "${outputs##* }: $same" "$lab" render scene.pbrt $tiny $outputs
done
for option in '--aov albedo' --layers --seen '--lights sub' --alpha; do # which were here once
    refused 2 "${option%% *}: asbdpt-lab render has this option" render $option -o new.pfm
done
# Nor does one take the place of a file that the scene was read from, under whatever name.
mkdir things && cat >reads.pbrt <<END
Film "image" "string filename" "things/mask.tga.png" WorldBegin LightSource "infinite" "string mapname" "things/sky.pfm"
Texture "a" "float" "imagemap" "string filename" "things/mask.tga.png" Include "things/more.inc"
Material "matte" "spectrum Kd" "things/red.spd" Shape "plymesh" "string filename" "things/one.ply" WorldEnd
END
printf '400 1 700 1\n' >things/red.spd
echo 'Shape "sphere"' >things/more.inc
cp "$top/test/data/fixtures/parts/triangle.ply" things/one.ply
cp "$scenes/sky/sky.pfm" things/sky.pfm
check "$program" convert things/sky.pfm -o things/mask.tga.png --quiet
read_from='the scene is read from this file'
for file in things/mask.tga.png things/sky.pfm things/more.inc things/one.ply things/red.spd reads.pbrt; do
    for name in $file ./$file "$PWD/$file"; do
        refused 2 "$read_from" "$program" render reads.pbrt $tiny -o new.pfm --stats "$name"
    done
done
refused 2 "mask.tga.png: $read_from" "$program" render reads.pbrt $tiny
refused 2 "sky.pfm: $read_from" "$program" render reads.pbrt $tiny -o things/sky.pfm
refused 2 "more.inc: $read_from" "$lab" trace reads.pbrt $tiny --svg things/more.inc
refused 2 "mask.tga.png: $read_from" "$lab" worth reads.pbrt $tiny -o things/mask.tga.png
# What may be the same: an input and an output, which takes its place when it is whole; so a checkpoint resumed.
cp c.part d.part
makes c.part "$program" merge d.part --quiet -o d.part
for time in first second; do expect 0 '' render --checkpoint state --resume state -o new.pfm; done
refused 1 'state: the file exists already' render --checkpoint ./state --resume state -o new.pfm
refused 2 'it needs a file' render --checkpoint - -o new.pfm
# What is to be written comes after -o: a shell's *.pfm may be many.
refused 2 'needs an image' "$program" merge b.part c.part
# An empty name is a variable that is not set.
refused 2 'checkpoint.*: its value is empty' render --checkpoint ''

# ---- values below 0 ----
# A light of one wavelength has some, and so has a filter with negative parts. Files have 0 instead, unless asked, and so
# have those that are merged or shown before the end; but all that is added up or goes on has them.
cat >red.pbrt <<END
Film "image" "integer xresolution" 12 "integer yresolution" 12 PixelFilter "mitchell" LookAt 0 0 -3 0 0 0 0 1 0
Camera "perspective" "float fov" 20 WorldBegin LightSource "infinite" "spectrum L" [ 625 0 633 9 641 0 ] WorldEnd
END
least() { "$lab" info "$1" | awk '$3 == "to" && (n++ == 0 || $2 < least) { least = $2 } END { exit !(least '"$2"' 0) }'; }
red() { check "$program" render red.pbrt --spp 4 --quiet "$@"; }
red -o cut.pfm -o cut.exr --checkpoint red.state
red --unclamped -o kept.pfm -o kept.exr -o kept.PART
for name in cut.pfm cut.exr; do check least $name ==; done
for name in kept.pfm kept.exr; do check least $name '<'; done
for half in 0:2 2:4; do red --samples $half -o "${half%:*}.part"; done
for from in '0.part 2.part' red.state kept.PART; do
    makes cut.pfm "$program" merge $from --quiet -o x.pfm
    makes kept.pfm "$program" merge $from --quiet --unclamped -o x.pfm
done
makes kept.pfm "$program" render red.pbrt --spp 4 --quiet --resume red.state --unclamped -o x.pfm
check "$lab" render red.pbrt --spp 4 --quiet --alpha -o shown.exr
check least shown.exr ==
check "$program" convert kept.pfm --quiet -o x.float.exr # which changes nothing
check least x.float.exr '<'

# ---- standard streams ----
# One stream carries one thing: what a command prints is not mixed with what it writes.
refused 2 "$same" "$lab" compare a.pfm b.pfm --heatmap -
# Closed ones do not become files that are opened.
expect 0 '' render -o good.png
for closed in '2>&-' '<&- >&- 2>&-'; do
    rm -f x.png
    check sh -c "\"\$ASBDPT\" render scene.pbrt ${tiny% --quiet} -o x.png $closed" 2>/dev/null
    check cmp -s good.png x.png
done
expect 1 'standard output: cannot be written' sh -c '"$LAB" info scene.pbrt >&-'
# What cannot be printed is said.
if [ -e /dev/full ]; then
    expect 1 'asbdpt: standard output: cannot be written' sh -c '"$LAB" info scene.pbrt >/dev/full'
fi

# ---- directories ----
# What comes into one is said, all of it is written in spite of one failure, with the reason; and where nothing comes
# into it, it is not left.
printf 'WorldBegin LightSource "point" LightSource "distant" LightSource "infinite" WorldEnd\n' >three.pbrt
expect 0 'wrote lit/light00_point.pfm$' "$lab" render three.pbrt ${tiny% --quiet} -o x.pfm --lights lit
for name in x lit/light01_distant lit/light02_infinite; do check grep -q "^wrote $name.pfm\$" stderr.txt; done
if [ -e /dev/full ]; then
    rm lit/*
    ln -s /dev/full lit/light00_point.pfm
    expect 1 'lit/light00_point.pfm: cannot be written: (No space left|write error)' \
        "$lab" render three.pbrt --res 256x256 --spp 1 -o x.pfm --lights lit
    check grep -q '^wrote lit/light01_distant.pfm$' stderr.txt
    check [ -s lit/light02_infinite.pfm ]
fi
mkdir -p bad/light01_distant.pfm
refused 1 'bad/light01_distant.pfm: cannot be created: Is a directory' \
    "$lab" render three.pbrt $tiny --lights bad -o new.pfm
expect 1 'nothing.pbrt' "$lab" render nothing.pbrt --lights none
check [ ! -e none ]

# ---- text of a scene ----
# Every string and every word of the scenes in features/ gets control characters, one at a time: no output has them.
sh "$scenes/unpack.sh" "$scenes/features" features
for file in features/*.pbrt; do sed 's/#.*//' "$file" | tr -s ' \t' '\n' | grep -E '^[A-Z]' | sort -u; done | sort -u |
    while read -r word; do printf '%s\t%s\n' "$(grep -l "^ *$word " features/*.pbrt | head -n 1)" "$word"; done >texts
awk -F '"' '{ sub(/#.*/, "") }
    { for (i = 2; i < NF; i += 2) if (!($i in seen)) { seen[$i]; print FILENAME "\t\"" $i } }' features/*.pbrt >>texts
while IFS="$(printf '\t')" read -r file text; do
    LC_ALL=C awk -v text="$text" -v more='\033[31m\007\302\233' '
        (at = index($0, text)) > 0 && !done++ { at += length(text); $0 = substr($0, 1, at - 1) more substr($0, at) }
        { print }' "$file" >features/marked.pbrt
    for command in info trace "render --spp 1 --stats -"; do
        "$lab" $command features/marked.pbrt --res 2x2
    done
done <texts >printed.txt 2>&1
check [ "$(LC_ALL=C tr -d '\n -~' <printed.txt | wc -c)" = 0 ]
check [ "$(grep -c '?\[31m' printed.txt)" -gt 300 ] # they were quoted

# ---- limits ----
refused 1 'have 550 pictures; --maxdepth 20 is the most' \
    "$lab" strategies scene.pbrt --res 1x1 --spp 1 --maxdepth 21 -o sub
# A name is wrong before the work, not after it.
long=$(awk 'BEGIN { for (i = 0; i < 300; i++) printf "n" }')
refused 1 'nnn.pfm: cannot be created' "$program" render nothing.pbrt -o "$long.pfm"

[ $failures -eq 0 ] && echo "outputs: all as expected"
exit $((failures > 0))

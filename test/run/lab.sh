#!/bin/sh
# lab.sh PROGRAM: what the laboratory's commands do with what cannot be measured, added up or judged: they say what it is,
# and go on with the rest.
. test/run/expect.sh
tiny="--spp 1 --seeds 3 --res 8x8 -j 1"
small() { # L NAME: a lamp that one sees, of this brightness
    printf 'Camera "perspective" WorldBegin AreaLightSource "diffuse" "rgb L" [%s] Translate 0 0 3 Shape "sphere" WorldEnd\n' \
        "$1" >"$2"
}
small '1 1 1' "$(printf 'e\033[31mred|x\ny').pbrt"
small '1 1 1' plain.pbrt

# ---- equal-time, experiment ----
# Names of scenes are printed, in tables too; one that is not there costs the others nothing; --seed is repeated.
expect 1 'nowhere.pbrt: .*; it is left out' "$lab" equal-time e*.pbrt nowhere.pbrt plain.pbrt $tiny --seed 7 -o names
check [ -z "$(LC_ALL=C tr -d '\n -~\200-\377' <stdout.txt)" ]
says 'e?\[31mred\\|x?y, 8x8 | plain, 8x8 |'
check grep -q 'equal-time --spp 1 .* --seed 7 --res 8x8' names/report.html
cp names/runs.csv seven.csv
expect 0 '' "$lab" equal-time e*.pbrt plain.pbrt $tiny -o others
check [ "$(cut -d , -f 8 seven.csv)" != "$(cut -d , -f 8 others/runs.csv)" ] # errors
long=$(i=0 && while [ $i -lt 48 ]; do printf 'asbdpt:select=bins:binpaths=16:maxage=%d:restart=0:rrthreshold=0.125:order=printed:lightsamplestrategy=power,' $i && i=$((i + 1)); done)
expect 2 'longer than a report can repeat' "$lab" equal-time plain.pbrt $tiny --methods "${long}pt" -o long
name=$(printf '%0200d' 0)
cp plain.pbrt "$name.pbrt"
expect 0 '' "$lab" equal-time "$name.pbrt" $tiny --methods "bdpt,${long%%,*}" -o names

# ---- sum: what is no number stays none ----
printf 'PF\n1 1\n-1\n\0\0\200\077\0\0\200\077\0\0\200\077' >one.pfm
printf 'PF\n1 1\n-1\n\0\0\300\177\0\0\200\077\0\0\200\377' >none.pfm
expect 0 'warning: 2 values of the sum are NaN or infinite' "$lab" sum one.pfm none.pfm -o sum.pfm
prints '^R .*1 NaN or infinite$' "$lab" info sum.pfm
says '^G  *2 to 2, mean 2$'

# ---- conform: a scene whose pictures do not fit is named, the others are judged ----
mkdir kit
sh "$scenes/unpack.sh" "$scenes/conform" conform
for name in area deep; do
    for k in 1 2; do
        "$program" render conform/area.pbrt --integrator bdpt --spp 4 --seed $k --quiet -o kit/$name-$k.pfm
    done
done
mv kit/deep-2.pfm kit/deep-3.pfm
expect 1 'deep: not judged: kit/deep-3.pfm: there is no picture 2 before it' "$lab" conform kit --kit "$top/ref/conform"
says '^area  *2 .*agrees$'
mv kit/deep-3.pfm kit/deep-2.pfm && cp kit/deep-2.pfm kit/deep.exr
expect 1 'deep: not judged: kit/deep: there are .pfm and .exr' "$lab" conform kit --kit "$top/ref/conform"
rm kit/deep.exr && cp one.pfm kit/deep-2.pfm
expect 1 'deep: not judged: kit/deep-2.pfm is 1x1, the picture before it' "$lab" conform kit --kit "$top/ref/conform"

mkdir odd && cp "$top/ref/conform/list.txt" odd && cp one.pfm odd/references.pfm && rm kit/deep-*
expect 1 'odd/references.pfm: 1x1 is no sheet of 9 square pictures for each of 35 scenes' "$lab" conform kit --kit odd

# What other renderers read of the kit's scenes: 30 of pbrt-v4, 26 of Mitsuba 3, always the same bytes.
expect 0 '' sh -c 'kit=$PWD/told && cd "$1" && sh scenes/generate/conform.sh "$kit"' sh "$top"
check [ "$(ls told/pbrt-v4 told/mitsuba | grep -c '[.]')" = 56 ]
check [ "$(export LC_ALL=C && cat told/pbrt-v4/* told/mitsuba/* | cksum)" = '4282179861 77775' ]

# ---- a scene without light ----
echo 'Camera "perspective" WorldBegin Translate 0 0 3 Shape "sphere" WorldEnd' >dark.pbrt
expect 1 'the scene has no light' "$lab" worth dark.pbrt --integrator asbdpt --res 16 -o worth.png
sh "$top/scenes/unpack.sh" "$top/scenes/test/lights.txt" told/lights
prints '^  path_tracer .*  -  *[0-9.]*  *-  no light sub-paths$' "$lab" info told/lights/beam.pbrt --race
expect 0 '' "$lab" info dark.pbrt --race
check [ -z "$(grep -i nan stdout.txt)" ]
[ $failures -eq 0 ] && echo "lab: all as expected"
exit $((failures > 0))

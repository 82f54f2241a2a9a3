#!/bin/sh
# corpus.sh PROGRAM: the scripts of test/measure/corpus.md, in a corpus of a few small scenes: what is listed and what
# is left out, what is measured, what becomes of a method that misses light or ends, and that nothing is measured twice.
. test/run/expect.sh
measure=$top/test/measure
tab=$(printf '\t')
repository=corpus/some+scenes
mkdir -p "$repository/parts"

# scene NAME FILM SHAPES: with a lamp over a floor
scene() {
    printf 'Film "image" "integer xresolution" [%s] LookAt 0 1 -4 0 1 0 0 1 0 Camera "perspective" "float fov" 60
        WorldBegin LightSource "point" "point from" [0 3 -1] "rgb I" [9 9 9]
        Shape "trianglemesh" "point P" [-9 0 -9 9 0 -9 9 0 9 -9 0 9] "integer indices" [0 1 2 2 3 0]
        %s WorldEnd\n' "$2" "$3" >"$repository/$1.pbrt"
}
glass='Material "glass" Translate 0 1.5 0 Shape "sphere" "float radius" [0.8]'
scene 'a scene' 64 'Translate 0 1 0 Shape "sphere" "float radius" [0.5]'
scene twin 32 'Translate 0 1 0 Shape "sphere" "float radius" [0.5]'
scene caustic 64 "$glass"
scene refused 64 'Shape "teapot"'
scene mesh 64 'Shape "plymesh" "string filename" "parts/none.ply"'
scene picture 64 'Texture "t" "spectrum" "imagemap" "string filename" "none.png" Material "matte" "texture Kd" "t"
    Translate 1 1 0 Shape "sphere" "float radius" [0.7]'
echo 'Camera "perspective" WorldBegin Shape "sphere" WorldEnd' >"$repository/black.pbrt"
echo 'Shape "sphere"' >"$repository/parts/part.pbrt"
printf '# some\nsome/scenes 0123\nother/scenes - gone\n' >repositories.txt

# ---- the list ----
expect 0 'some/scenes: 3 of 7' env REPOSITORIES=repositories.txt sh "$measure/corpus.sh" corpus "$program"
check [ "$(wc -l <corpus/list.txt)" -eq 3 ]
check [ "$(cut -f 2,4 corpus/list.txt | sort -u)" = "some/scenes${tab}report" ]
for said in 'caustic\.pbrt' 'picture\.pbrt'; do check grep -q "$tab$said$tab" corpus/list.txt; done
for said in 'refused\.pbrt.what the program has not' 'mesh\.pbrt.a file is missing' 'black\.pbrt.black' \
    '\(twin\|a scene\)\.pbrt.duplicate.some/scenes/\(twin\|a scene\)\.pbrt'; do
    check grep -q "^some/scenes$tab$said" corpus/left_out.txt
done
check grep -q "^other/scenes${tab}${tab}not fetched${tab}gone" corpus/left_out.txt
check [ "$(wc -l <corpus/left_out.txt)" -eq 5 ]

# ---- the measurement; one method ends its process ----
cat >fragile <<'END'
#!/bin/sh
case "$*" in *asbdpt:race=off*) echo "begin asbdpt:race=off" >&2; kill -9 $$ ;; esac
exec "$LAB" "$@"
END
chmod +x fragile
run() {
    LAB=$lab METHODS=bdpt,pt,asbdpt:race=off,asbdpt WIDTH=24 SPP=16 \
        sh "$measure/corpus_run.sh" corpus out "$PWD/fragile"
}
expect 0 '' run
check [ "$(cat out/*.csv | grep -c '^[1-3],run,')" -eq 27 ]
check [ "$(cat out/*.csv | grep -c '^[1-3],failed,asbdpt:race=off,status 137')" -eq 3 ]
caustic=$(grep caustic corpus/list.txt | cut -f 1)
check [ "$(grep -c '^[1-3],run,pt,.*,misses light$' "out/$caustic.csv")" -eq 3 ]
check [ "$(cat out/*.csv | grep -c 'misses light$')" -eq 3 ]
check grep -q '^[1-3],scene,24,.*,delta=1,sky=0,lamps=0,mirror=1,medium=0,' "out/$caustic.csv"
check [ "$(cat out/*.csv | grep -c ',mirror=0,')" -eq 2 ]

# ---- again: what is there stays, what is not is measured ----
echo "$caustic,kept" >"out/$caustic.csv"
other=$((caustic % 3 + 1))
grep ,run, "out/$other.csv" | cut -d , -f 1-5,7-9 >before.txt
rm "out/$other.csv"
expect 0 '' run
check grep -q kept "out/$caustic.csv"
grep ,run, "out/$other.csv" | cut -d , -f 1-5,7-9 | check cmp -s - before.txt
expect 0 '' env LAB="$lab" FORTY=yes WIDTH=16 SPP=1 sh "$measure/corpus_run.sh" corpus forty "$PWD/fragile"
check [ "$(cat forty/*.csv | grep -c '^[1-3],run,[a-z]*,[12],1,')" -eq 18 ]
sed 's/report$/tune/' corpus/list.txt >tune.txt
expect 1 'no scene of tune.txt is wanted' env LAB="$lab" LIST=tune.txt FORTY=yes \
    sh "$measure/corpus_run.sh" corpus none "$PWD/fragile"
check [ -z "$(ls none)" ]

# ---- the errors: half the squared differences of two renders ----
for seed in 1 2; do
    "$program" "$box" --integrator pt --filter box --res 24 --spp 4 --seed $seed --unclamped --quiet -o $seed.pfm
done
prints '^rmse8' "$lab" compare 1.pfm 2.pfm
rmse8=$(awk '$1 == "rmse8" { print $2 }' stdout.txt)
expect 0 '' "$lab" corpus "$box" --methods pt --width 24 --spp 4 --seeds 2
check awk -F , -v d="$rmse8" '
    $1 == "run" { n += ($6 - d * d / 2) ^ 2 < (0.01 * $6) ^ 2 }
    END { exit n != 2 }' stdout.txt

# ---- limits; what cannot be loaded ----
prints '^failed,bdpt,more CPU time than the limit' "$lab" corpus "$box" --methods bdpt --width 64 --limit 0.01
expect 1 'Shape "teapot"' "$lab" corpus "$repository/refused.pbrt"
expect 2 '' "$lab" corpus "$box" --methods nothing

# ---- the tables: of known lines ----
{
    for row in 1,bdpt,4, 1,pt,8, 1,asbdpt,2, 2,bdpt,4, '2,pt,1,misses light' 2,asbdpt,8,; do
        echo "$row" | awk -F , -v OFS=, '{ for (i = 1; i < 4; i++) print $1, "run", $2, i, 32, 1, $3, $3, $3, 1, $4 }'
    done
    for n in 1 2; do echo "$n,scene,8,8,5,0,delta=$((n - 1)),sky=0,lamps=1,mirror=0,medium=0,inside=1,runner=all"; done
    echo '3,failed,-,status 1: no'
} >known.csv
printf '1\ta/b\tc\ttune\n2\ta/b\td\treport\n3\ta/b\te\ttune\n' >known.txt
prints '^both  *relmse  *2  *1.000  *0.650  *0.875  *1.250  *1.625  *1.850  *2.000  *50.0 %  *50.0 %' \
    awk -f "$measure/corpus.awk" known.txt known.csv
says '^report  *8x8  *1  *2.000' '^no delta  *mse8  *1  *0.500' '^delta  *mse8  *1  *2.000' '    pt misses light in 1' \
    '    1: status 1: no'
{ printf '1,set,tune\n2,set,report\n3,set,tune\n' && cat known.csv; } >stored.csv
prints '^| both | 8x8 | 2 | 1.00 | 0.65 | 0.88 | 1.25 |' awk -v page=sets -f "$measure/corpus.awk" stored.csv
prints '^| all | mse8 | 2 | 1.00 |' awk -v page=runners -f "$measure/corpus.awk" stored.csv
prints '^| over `bdpt` | mse8 | 1 | 2.00 ' awk -v page=baselines -f "$measure/corpus.awk" stored.csv
prints '^0 of 1$' awk -v page=few -f "$measure/corpus.awk" stored.csv
prints '^2.00 of the time .* at most 2.00, in 100 % over 1.15$' awk -v page=sentence -f "$measure/corpus.awk" stored.csv
awk -v scores=yes -f "$measure/corpus.awk" known.txt known.csv >scores.txt
check [ "$(cat scores.txt)" = "1 tune all 0.5 2
2 report all 2 -" ]
for column in 4 5; do
    prints '</svg>' awk -v column=$column -f "$measure/corpus_svg.awk" scores.txt
    check [ "$(grep -c '<circle' stdout.txt)" -eq $((6 - column)) ]
done

# ---- rivals: half of the cost of lvc, twice that of the others; in scene 6 lvc misses light ----
for half in services choice; do
    for n in 1 2 3 4 5 6; do
        for row in bdpt,8 asbdpt,4 lvc,8 cbdpt,2 mbdpt,2 spcbpt,2; do
            mark=$([ "$row$n" = lvc,86 ] && echo 'misses light')
            x=${row#*,}.0$n
            for seed in 1 2; do echo "$half,$n,run,${row%,*},$seed,32,1,$x,$x,$x,1,$mark"; done
        done
    done
done >rivals.csv
prints '^| `lvc` | 5 | 0.50 \[0.50, 0.50\] | 0.50 | 1.00 | 0.50 | 0.50 | 0.50 | 0.50 | 0.50 \[0' awk -f "$measure/evidence/better.awk" \
    -f "$measure/evidence/rivals.awk" rivals.csv
says '^| `mbdpt` | 6 | 1.9[89] ' '^== holm$' '^in 6 of 24 cells' 'drops none$' \
    '^0.50 of the error of `bdpt` in 1.00 of its time$'
check [ "$(sed -n '/^== data/,$p' stdout.txt | wc -l)" -eq 6 ]
[ $failures -eq 0 ] && echo "corpus: all as expected"
exit $((failures > 0))

#!/bin/sh
# cli.sh: the command line as a user meets it: exit codes, one clear line per error, formats, determinism of files.
# Run from the top: sh test/run/cli.sh ./asbdpt
# What a value of an option may be is in test_options.c, formats are in test_file.c, test_image.c and test_hdr.c, what
# pictures hold is in test_aov.c, test_lights.c, test_gates.c and test_pictures.c.
. test/run/expect.sh
small="--res 16x16 --spp 2 --quiet"
ln -s "$top/ref" ref
picture="ref/bathroom.pfm ref/bathroom.error.pfm" # and its errors
nan() { head -c "$1" /dev/zero | LC_ALL=C tr '\000' '\377'; } # so many bytes of NaNs
{ printf 'PF\n36 24\n-1\n'; nan 10368; } >nan.pfm

# --- options

prints '^asbdpt SCENE.pbrt' "$program" --help
prints '^    experiment  ' "$lab" --help
for command in render merge convert; do prints "usage: asbdpt $command" "$program" $command --help; done
for command in info compare trace worth strategies verify conform experiment equal-time family transient bench; do
    prints "usage: asbdpt-lab $command" "$lab" $command -h
done
expect 0 '' "$program" --version
refuse() { # PATTERN WORDS...: wrong usage of the program
    pattern=$1
    shift
    expect 2 "$pattern" "$program" "$@"
}
# What only the laboratory has the program does not have; it says where that is.
for command in info compare equal-time bench; do
    refuse "^asbdpt: unknown command $command; asbdpt-lab has more commands; try" $command
done
prints '^lvc$' "$lab" help integrators
for name in $(sed -n 's/^\([a-z0-9]*\)$/\1/p' stdout.txt); do # all methods of the laboratory
    case $name in
    all | pt | lt | bdpt | asbdpt) ;;
    *) refuse "^asbdpt: there is no integrator $name; known are: pt lt bdpt asbdpt; asbdpt-lab has it$" \
        render "$box" --integrator "$name" ;;
    esac
done
refuse '^asbdpt: there is no integrator vcn; known are: pt lt bdpt asbdpt$' render "$box" --integrator vcn
# A name that is none may be like one that is.
refuse 'no integrator asbdtp; known are: pt lt bdpt asbdpt; did you mean "asbdpt"[?]$' \
    render "$box" --integrator asbdtp
refuse 'there is no help on integrator; did you mean "integrators"[?] try asbdpt --help$' help integrator
refuse '[-]-filter gausian: expected .*"gaussian".*; did you mean "gaussian"[?]' render "$box" --filter gausian
refuse 'lightsamplestrategy = "powr" is unknown: give "spatial", "power" or "uniform"; did you mean "power"[?]$' \
    render "$box" -P lightsamplestrategy=powr
# A file that is called like an option is not taken for one: what is wrong with it is no wrong usage.
expect 1 '^asbdpt: --x' "$program" render "$box" $small -o--x/y.png
# One meaning of --res everywhere: a width keeps the film's shape.
prints '^film  *24x14,' "$lab" info "$scenes/veach-ajar.pbrt" --res 24
refuse 'asbdpt: which command'
refuse '^asbdpt: unknown command rendr; did you mean "render"[?] try asbdpt --help$' rendr
expect 2 '^asbdpt: unknown command verfy; did you mean "verify"[?] try asbdpt-lab --help$' "$lab" verfy
expect 2 '^asbdpt: unknown command rendering; try asbdpt-lab --help$' "$lab" rendering
refuse 'needs a scene' render
refuse 'unknown option --sppp; did you mean "--spp"[?] try asbdpt render --help' render "$box" --sppp 3
refuse 'no integrator has a parameter "selct"; did you mean "select"[?] asbdpt help' render "$box" -P selct=bins
refuse 'no integrator has a parameter "zzzz"; asbdpt help' render "$box" -P zzzz=1
refuse 'delta = "7": give a number' render "$box" -P delta=7 --integrator asbdpt
expect 1 'nothing.pbrt' "$program" render nothing.pbrt
expect 1 'its film of 800x800 pixels: this needs [0-9.]+ MB more memory, but [0-9.]+ of 10.0 MB are left; --max-mem' \
    "$program" render "$box" --res 800x800 --spp 1 --max-memory .01 -o x.pfm

# --- parameters
# A word that a parameter does not have is an error. pbrt's lightsamplestrategy is taken by every integrator.
printf 'Integrator "path" "string lightsamplestrategy" "spacial"\nWorldBegin\nWorldEnd\n' >strategy.pbrt
expect 1 '^asbdpt: strategy.pbrt:1:[0-9]+: lightsamplestrategy = "spacial" is unknown: give "spatial"' \
    "$lab" info strategy.pbrt
# Fog all around the camera.
echo 'Integrator "volpath" MakeNamedMedium "fog" "string type" "homogeneous" MediumInterface "fog" Camera "perspective"
    WorldBegin LightSource "infinite" Shape "sphere" WorldEnd' >fog.pbrt
expect 0 'warning: fog.pbrt: a medium without a bound ends on a sphere' \
    "$program" render fog.pbrt --res 16x16 --spp 2 -o fog.pfm
# row: a medium without a bound, under infinite or distant lights
# A lens in the fog looks at a shape of which the fog is not said, or the other way round: a warning, unless both agree.
fits() { # LENS BOUNDARY MATERIAL: the media that lens and boundary are in; prints how many warnings there are
    printf 'Integrator "volpath" MakeNamedMedium "fog" "string type" "homogeneous"
        MakeNamedMedium "milk" "string type" "homogeneous"
        LookAt 0 0 -5 0 0 0 0 1 0 Camera "perspective" WorldBegin LightSource "point" "point from" [0 3 0]
        MediumInterface "milk" "%s" Material "%s" Shape "sphere"
        MediumInterface "%s" WorldEnd\n' "$2" "$3" "$1" >fits.pbrt
    "$program" render fits.pbrt $small -o x.pfm 2>&1 |
        grep -c '^asbdpt: warning: .* boundary that it looks at, at (0 0 -1), are in different media'
}
for material in matte none; do
    check [ "$(fits fog fog $material) $(fits '' '' $material)" = '0 0' ]
    check [ "$(fits fog '' $material) $(fits '' fog $material)" = '1 1' ]
done
# Parameters by which light may be lost: a warning, where there is such light.
sh "$scenes/unpack.sh" "$scenes/test/caustics.txt" caustics
for number in connections=0 later=0 pathpixels=0; do
    expect 0 'warning: .*/caustic-pane.pbrt: with connections, later or pathpixels 0 the image may lack light' \
        "$program" render caustics/caustic-pane.pbrt $small --integrator asbdpt -P $number -o x.pfm
    expect 0 '' "$program" render "$box" $small --integrator asbdpt -P $number -o x.pfm
    check [ ! -s stderr.txt ]
done
expect 0 '' "$program" render caustics/caustic-pane.pbrt $small --strict --integrator asbdpt -P select=vertices -o x.pfm
# Without lights nothing is rendered, whatever is asked for: a million samples of a hundred thousand pixels, in no time.
printf 'WorldBegin Shape "sphere" WorldEnd\n' >dark.pbrt
printf 'WorldBegin WorldEnd\n' >empty.pbrt
for method in pt lt bdpt asbdpt; do
    expect 0 '480x270, 1000000 spp' "$lab" render dark.pbrt --integrator $method --res 480x270 --spp 1000000 \
        --time 5 --aov variance -o dark.ppm
done
check grep -q '^asbdpt: warning: the image is black: the scene has no light' stderr.txt
check [ "$(tail -c +16 dark.ppm | tr -d '\000' | wc -c)" = 0 ]
expect 0 '' "$lab" render dark.pbrt --res 16x16 --spp 4 --alpha --quiet -o dark.png # but what the lens sees
expect 0 '' "$lab" render empty.pbrt --res 16x16 --spp 4 --alpha --quiet -o empty.png
check test -n "$(cmp dark.png empty.png 2>&1)"

# A black picture is no error, but the reason is said as far as it is known; also of a render that is to be quiet.
black() { # TEXT SCENE OPTION...
    text=$1
    printf 'LookAt 0 0 -5 0 0 0 0 1 0 Camera "perspective" "float fov" 40 WorldBegin %s WorldEnd\n' "$2" >black.pbrt
    shift 2
    expect 0 "^asbdpt: warning: the image is black: $text\$" \
        "$program" render black.pbrt --res 16x16 --spp 4 --quiet -o x.pfm "$@"
}
wall='Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-9 -9 1 9 -9 1 9 9 1 -9 9 1]'
lamp='LightSource "point" "point from" [0 0 9]'
none='no light has reached the camera by' rounded='( [(]no value is above [0-9.]+e-[23][0-9][)])?'
for method in pt bdpt asbdpt lt; do
    black "$none $method$rounded; the nearest surface that it sees is at [(].* 1[)], 6 away, and faces away" \
        "$lamp $wall" --integrator $method
done
black "$none bdpt$rounded; the nearest surface that it sees is at [(].* 1[)], 6 away" "$lamp ReverseOrientation $wall"
black "$none bdpt; it sees no surface" 'LightSource "point"'
black "$none pt; it sees no surface" 'LightSource "infinite" "rgb L" [0 0 0]' --integrator pt
black 'the scene has no light' "$wall"
# What is below the rounding of floats counts as black: here a wall that shines by 1e-12 before a lamp that it hides.
leak() { echo "$lamp AreaLightSource \"diffuse\" \"rgb L\" [$1 $1 $1] ReverseOrientation $wall"; }
for method in pt bdpt asbdpt; do
    black "$none $method [(]no value is above 1e-12[)]; the nearest surface .*" "$(leak 1e-12)" --integrator $method
done
printf 'LookAt 0 0 -5 0 0 0 0 1 0 Camera "perspective" WorldBegin %s WorldEnd\n' "$(leak 1e-4)" >dim.pbrt
expect 0 '' "$program" render dim.pbrt --res 16x16 --spp 4 --quiet --integrator pt -o x.pfm
check [ ! -s stderr.txt ]
# The watts of info: under a sky of radiance 1 and a sun of irradiance pi a surface that faces the sun receives as much
# of one as of the other. The sphere around the scene has a disk of pi R^2 for the sun, and one for each direction of
# the sky: four times as much.
printf 'WorldBegin LightSource "distant" "rgb L" [3.14159265 3.14159265 3.14159265]
LightSource "infinite" "rgb L" [1 1 1] Shape "sphere" WorldEnd\n' >sun.pbrt
prints '^  distant     power 29.61 W (20.0 %)$' "$lab" info sun.pbrt # pi R^2 pi, R^2 3
says '^  infinite    power 118.4 W (80.0 %)$'
expect 0 '' "$program" render "$box" $small -o x.pfm
check [ ! -s stderr.txt ]

# A scene far from the origin of its file: places are told in the file's coordinates. Far from its camera: a warning.
far() { # DISTANCE FOV: a ball, moved by 3e7 with its camera
    printf 'LookAt 0 0 -%s 0 0 0 0 1 0 Translate -3e7 0 0 Camera "perspective" "float fov" %s\nWorldBegin\n' $1 $2
    printf 'Translate 3e7 0 0 LightSource "point" "point from" [0 0 -4] Shape "sphere" WorldEnd\n'
}
far 5 20 >far.pbrt
prints '^camera .* at (3e+07, 0, -5)' "$lab" info far.pbrt
says '^bounds .*(3e+07, -1, -1) to (3e+07, 1, 1)'
check [ ! -s stderr.txt ]
prints 'z_1 * matte * 3e+07 ' "$lab" trace far.pbrt --pixel 5,5 --res 11x11 --all
far 1e4 0.01 >far.pbrt
expect 0 'the scene is 5.76e\+03 times its own radius away from' "$program" render far.pbrt --res 8x8 -o x.ppm

# A filter with negative lobes takes whole cycles of samples; others take as many as are asked for.
# row: filters with negative lobes
printf 'WorldBegin LightSource "infinite" WorldEnd\n' >sky.pbrt
expect 0 'takes samples in fours: 8, not 5$' "$program" render sky.pbrt --filter sinc --spp 5 --res 8 -o sky.pfm
check grep -q ' 8 spp' stderr.txt
expect 0 ' 5 spp' "$program" render sky.pbrt --filter gaussian --spp 5 --res 8 -o sky.pfm

# Parameters of pbrt's integrators that have no effect here are said; those of -P must be right. info and render agree.
printf 'Integrator "sppm" "integer numiterations" 3 "integer maxdepth" 100000
Film "image" "string filename" "x.jpg"\nWorldBegin\nLightSource "point"\nWorldEnd\n' >sppm.pbrt
for command in info "render --res 16x16 --spp 1"; do
    expect 0 'warning: sppm.pbrt:1:19: "numiterations" is not used: no integrator here' "$lab" $command sppm.pbrt
    check grep -q 'warning: sppm.pbrt:1:45: "maxdepth" is 100000, which counts as 1000' stderr.txt
    check grep -q 'warning: sppm.pbrt: integrator "sppm" does not exist here; bdpt is used' stderr.txt
    expect 2 '^asbdpt: -P: maxdepth = "100000": give a whole number' "$lab" $command sppm.pbrt -P maxdepth=100000
done
check [ -f x.png ]

# Parameters of another integrator than the one that renders: an error in -P, a warning in a file that names no other.
printf 'Integrator "bdpt" "string select" "bins"\nWorldBegin\nLightSource "point"\nWorldEnd\n' >other.pbrt
expect 2 '^asbdpt: -P: "select" is a parameter of asbdpt, not of bdpt; see --integrator$' \
    "$lab" info "$box" --integrator bdpt -P select=bins
expect 0 '^asbdpt: warning: other.pbrt:1:19: "select" is not used: it is a parameter of asbdpt$' \
    "$lab" info other.pbrt
prints '^  maxdepth    8$' "$lab" info other.pbrt -P maxdepth=6 -P maxdepth=7 --maxdepth 8 # the last counts

# --- outputs

# Outputs are opened before the work begins, and nothing is left of them when it fails.
expect 1 "^asbdpt: no/x.pfm: cannot be created" "$program" render nothing.pbrt -o good.pfm -o no/x.pfm
expect 1 'binpaths 7 is odd' \
    "$program" render "$box" $small -P select=bins -P binpaths=7 --integrator asbdpt -o good.pfm
check [ ! -e good.pfm ]
check [ -z "$(find . -name '.asbdpt-*')" ]
# Only the command line means standard input or output by "-".
echo 'Film "image" "string filename" "-" WorldBegin WorldEnd' >dash.pbrt
expect 0 'wrote -\.png' "$program" render dash.pbrt --res 16x16 --spp 2
check [ ! -s stdout.txt ]
rm -f ./-.png
# A file that is replaced keeps its rights.
touch target.pfm && chmod 640 target.pfm
expect 0 'wrote x.ppm$' "$program" render "$box" --res 8x8 --spp 1 -o target.pfm -o x.ppm
check [ -n "$(find target.pfm -perm 640)" ]
# Standard input and output: -.
"$program" render - --res 8x8 --spp 1 --quiet -o - <"$box" >piped.pfm
check cmp -s piped.pfm target.pfm
for command in render convert; do
    prints 'standard input' "$program" $command --help
    says 'standard output'
done
# A pipe that nobody reads any more is one error, in one line.
closed() { # COMMAND...
    { "$@" 2>stderr.txt; echo $? >status.txt; } | true
    check [ "$(cat status.txt)" = 1 ]
    check [ "$(sed 's/: [^:]*$//' stderr.txt)" = "asbdpt: standard output: cannot be written" ] # and why
}
"$program" render "$box" --res 100x100 --spp 1 --quiet -o large.pfm # more than a pipe holds
closed "$program" render "$box" --res 100x100 --spp 1 --quiet -o -
closed "$program" convert large.pfm --quiet -o -
rm large.pfm

# --- scenes
# Warnings are errors by --strict, and all errors come in one run.
printf 'WorldBegin\nShape "sphere" "float radus" 2\nNamedMaterial "mate"\nWorldEnd\n' >warned.pbrt
expect 0 '' "$lab" info warned.pbrt
expect 1 '^asbdpt: warned.pbrt:2:16: parameter "float radus" of Shape "sphere" is not used' \
    "$program" render warned.pbrt $small --strict -o x.pfm
check grep -q '^asbdpt: warned.pbrt:3:15: there is no named material "mate"' stderr.txt

# --quiet hides no warning. The last line says which method it was, how to have the default, and how many warnings.
expect 0 '^asbdpt: warning: warned.pbrt:2:16: ' "$program" render warned.pbrt $small -o x.pfm
check [ "$(wc -l <stderr.txt)" = 3 ] # there is no light either
last() { # PATTERN OPTION...: of a render's last line
    end=$1
    shift
    expect 0 '' "$program" render "$@" --res 4x4 --spp 1 -o x.pfm
    tail -n 1 stderr.txt | grep -Eq -e "$end" || fault "no \"$end\" at the end of $(cat stderr.txt)"
}
last ', 1 spp, bdpt \(for asbdpt: --integrator asbdpt\); .*; 2 warnings about the scene$' warned.pbrt
last ', 1 spp, asbdpt; .* per sample path; 2 warnings about the scene$' warned.pbrt --integrator asbdpt
last ', 1 spp, pt; .* per sample path; 2 warnings about the scene$' warned.pbrt --integrator pt
for name in path bdpt asbdpt; do
    echo "Integrator \"$name\" WorldBegin LightSource \"infinite\" WorldEnd" >$name.pbrt
done
last ', 1 spp, pt \(for asbdpt: .* per sample path$' path.pbrt
last ', 1 spp, bdpt \(for asbdpt: .* per sample path$' bdpt.pbrt
last ', 1 spp, asbdpt; .* per sample path$' asbdpt.pbrt
awk 'BEGIN { print "WorldBegin LightSource \"infinite\""
    for (i = 0; i < 300; i++) print "Shape \"sphere\" \"float radius\" " i + 1 " \"float a" i % 200 "\" 1"
    print "WorldEnd" }' >many.pbrt
last '; 300 warnings about the scene$' many.pbrt # printed or not

# Bytes of a scene that mean something to a terminal do not reach it.
printf 'Integrator "\033[31mx" "string maxdepth" "\033[31m"\nWorldBegin\nWorldEnd\n' >escape.pbrt
expect 1 'integrator "[?]\[31mx" does not exist here' "$lab" info escape.pbrt
check test -z "$(cat stdout.txt stderr.txt | tr -d '\n -~')"
# What overflows on the way is said, and no picture holds anything but numbers.
printf 'Film "image" "float scale" 1e20\nWorldBegin LightSource "infinite" "rgb L" [ 1e30 1 1e30 ]\nWorldEnd\n' \
    >bright.pbrt
expect 0 'warning: 512 pixel values were beyond' "$program" render bright.pbrt $small -o bright.pfm
prints '^nonfinite  0$' "$lab" compare bright.pfm bright.pfm

# --- render
# Files: three formats from one run, the same bytes for any number of threads.
expect 0 '' "$program" render "$box" $small -j 1 -o a.pfm -o a.ppm -o a.png
makes a.pfm "$program" render "$box" $small -j 3 -o b.pfm
expect 0 '' "$program" render "$box" $small --cropwindow 0 0.5 0.25 1 -o crop.exr -o crop.part
makes crop.exr "$program" convert crop.exr -o same.exr # OpenEXR keeps the window, other formats do not
makes crop.exr "$program" merge crop.part --quiet -o sum.exr
prints '^rmse       0$' "$lab" compare a.pfm b.pfm
says '^rmse8      0$' '^relmse     0$' '^relmse8x8  0$' '^mean_ratio 1$' '^nonfinite  0$' '^psnr       inf$'
expect 0 'a.png holds sRGB values from 0 to 1, a.pfm linear' "$lab" compare a.png a.pfm --heatmap heat.png --max 2
says '^heatmap    0 to 2$'
expect 0 '' "$program" convert heat.png -o heat.ppm # 16x16 pixels, each a square of 20, and a bar of all colours
check [ "$(head -n 2 heat.ppm | tail -n 1)" = "320 359" ]
row() { tail -c $((960 * ($1))) heat.ppm | head -c 960 | od -An -v -t u1 | awk '{ for (i = 1; i <= NF; i++) v[++n] = $i }
    END { print v[1], v[2], v[3], v[n - 2], v[n - 1], v[n] }'; }
check [ "$(row 34)" = "68 1 84 253 231 37" ]
check [ "$(row 359)" = "$(row 340)" ]
check [ "$(row 40)" = "$(row 59)" ]
expect 0 '' "$lab" compare a.png a.pfm --max-rmse 1000
expect 1 'rmse [0-9.e-]+ is more than 1e-09' "$lab" compare a.png a.pfm --max-rmse 1e-9
expect 0 '' "$program" render "$box" --res 8x8 --spp 1 --quiet -o c.pfm
expect 1 'equal size can be compared; render with --res 8x8 --filter box$' "$lab" compare a.pfm c.pfm
expect 0 '' "$lab" strategies "$box" $small --maxdepth 2 -o s
check [ -s s/d02_s02_t02_weighted.pfm ]
check [ -s s/pyramid.png ]

# --- aov
# --aov: a picture each beside the first.
expect 0 '^wrote aov.variance.pfm$' "$lab" render "$box" --res 16x16 --spp 2 -j 1 \
    --aov variance,albedo,normal,depth,position -o aov.png
for name in albedo normal depth position; do check grep -q "^wrote aov.$name.pfm\$" stderr.txt; done
expect 2 'known are albedo' "$lab" render "$box" $small --aov albedo,norml -o aov.png
expect 1 'aov: not written, for one sample' "$lab" render "$box" --spp 2 --samples 0:1 --res 8x8 --quiet \
    --aov variance -o few.png
check [ -s few.png -a ! -e few.variance.pfm ]

# --layers: the same in the picture's own .exr, beside the colours.
expect 0 'wrote l.float.exr$' "$lab" render "$box" --res 16x16 --spp 2 -j 2 --layers \
    --aov variance,albedo,normal,depth,position -o l.float.exr -o l.pfm
makes l.pfm "$program" convert l.float.exr -o back.pfm
for name in albedo.R normal.X depth.Z position.Z variance.B; do check grep -aq "$name" l.float.exr; done
check [ ! -e l.albedo.pfm ]

# --- noise
# --noise: the render ends when it is low enough; --spp is the most. test_noise.c: at the same sample by any threads.
noisy="--res 20x16 --integrator bdpt --maxdepth 3"
expect 0 '128 spp' "$program" render "$box" $noisy --spp 1000 --noise 0.055 -j 1 -o noise1.pfm
check grep -q 'noise 0.0[0-9]* +- .* of the brightness around, .* at 128 samples per pixel: below' stderr.txt
expect 0 'at 64 samples per pixel: above' "$program" render "$box" $noisy --spp 70 --noise 0.001 -o a.pfm
# It goes on from a checkpoint to the same end, also from the end itself; one without halves is refused.
rm -f noise.state
for spp in 16 100 1000 1000; do
    check "$program" render "$box" $noisy --spp $spp --noise 0.055 -o a.pfm --quiet \
        --checkpoint noise.state --resume noise.state
done
check cmp -s noise1.pfm a.pfm
check "$program" render "$box" $noisy --spp 16 -o a.pfm --quiet --checkpoint plain.state
expect 1 'was made without --noise' "$program" render "$box" $noisy --spp 64 --noise 0.1 -o a.pfm --resume plain.state

# --- stats
# --stats: what was rendered and how it went; --quick: what pbrt's does, but options of one's own count first.
expect 0 '' "$program" render "$box" --quick -j 2 --integrator asbdpt -P delta=0.25 --stats stats.json \
    -o a.png
check grep -q ': 120x120, 1 spp, asbdpt;' stderr.txt
for line in '"version": "asbdpt ' '"select": "subspaces",' '"delta": 0.25,' '"maxdepth": 6,' '"film": .120, 120.,' \
    '"spp_done": 1,' '"threads": 2,' '"draws_first_hit": [1-9]' '"a.png"' '"us_per_path": [1-9]' \
    '"peak_memory": [1-9]'; do
    check grep -q "$line" stats.json
done
# Without light sub-paths there are no draws.
prints '"pixels_per_light_path": 0,' \
    "$program" render "$scenes/sky.pbrt" --res 24x16 --spp 1 --quiet --integrator asbdpt -P pathpixels=0 --stats - -o a.pfm
says '"draws_first_hit": 0,' '"draws_after": 0,'
prints '"spp": 3,' "$program" render "$box" --integrator pt --quick --quiet --spp 3 --cropwindow 0 0.5 0 1 \
    --samples 1:3 --stats - -o a.part
says '"first_sample": 1,' '"spp_done": 2,' '"width": 60,'
odd=$(printf 'odd"\\\377\303\251.pbrt') # letters that JSON has otherwise, where a file's name can have them
if cp "$box" "$odd" 2>/dev/null; then
    check "$program" render "$odd" --quick --quiet --stats odd.json -o a.pfm
    check env LC_ALL=C grep -qF "$(printf '"scene": "odd\\"\\\\\\ufffd\303\251.pbrt",')" odd.json
fi
if command -v python3 >/dev/null; then check python3 -c 'import json; json.load(open("stats.json"))'; fi
rm stats.json # it is there when all other files are
expect 1 'nothing.pbrt' "$program" render nothing.pbrt --stats stats.json -o a.png
if [ -e /dev/full ]; then
    ln -sf /dev/full full.pfm
    expect 1 'full.pfm' "$program" render "$box" $small --stats stats.json -o full.pfm
fi
check [ ! -e stats.json ]

# --- gates
# gates: light by how far it has come; a sequence of pictures in one render.
expect 0 '' "$lab" transient "$box" $small --gates 3 --gate 1000:2500 -o flight
check [ -s flight/gate002.pfm -a -s flight/transient.png -a ! -e flight/gate003.pfm ]
expect 0 '' "$program" convert flight/transient.png -o flight.ppm
check [ "$(head -n 2 flight.ppm | tail -n 1)" = "1000 300" ]

# --- lights
# lights: of one light all that there is; of several, pictures that sum adds up, each times a weight.
cat >lamps.pbrt <<END
LookAt 0 0 -5 0 0 0 0 1 0 WorldBegin LightSource "infinite" "bool visible" "false"
LightSource "point" "string group" "key" LightSource "distant" "string group" "key"
AttributeBegin AreaLightSource "diffuse" Translate 2 0 0 Shape "sphere" AttributeEnd Shape "sphere" WorldEnd
END
expect 0 '' "$lab" render lamps.pbrt --res 24x16 --spp 4 --quiet --lights lit --alpha -o a.pfm -o a.png -o a.exr
check [ -s lit/light00_infinite.pfm -a -s lit/light01_key.pfm -a -s lit/light02_area.pfm -a ! -e lit/light03.pfm ]
expect 0 '' "$lab" sum lit/light0?_*.pfm -o sum.pfm
expect 0 '' "$lab" compare sum.pfm a.pfm --max-rmse 1e-6
makes a.pfm "$lab" sum a.pfm sum.pfm a.pfm --weights 2,0,-1 -o b.pfm
expect 2 'weights 1: expected a number for each' "$lab" sum a.pfm sum.pfm --weights 1 -o b.pfm
expect 2 'sum.pfm is one argument too many' "$program" convert a.pfm sum.pfm -o b.pfm
expect 2 'weights: asbdpt-lab sum adds up images' "$program" convert a.pfm --weights 1 -o b.pfm
# Halfs end at 65504.
printf 'PF\n1 1\n-1\n\000\120\303\107\000\000\200\077\000\120\303\307' >far.pfm # 1e5 1 -1e5
expect 0 'far.exr: 2 values are beyond 65504, .* ends in .float.exr' "$program" convert far.pfm -o far.exr
expect 1 'no pixel has one to tell of' "$lab" trace lamps.pbrt --res 4x4 --spp 4 --integrator pssmlt

# --- help
# help: as a whole no wider than a terminal, with every integrator.
expect 0 '' "$program" help all
check [ -z "$(awk 'length > 100' stdout.txt)" ]
printf 'P3\n3 2\n255\n0 0 0 255 0 0 0 0 0\n0 0 0 0 0 0 0 255 255\n' >picture.ppm
prints '^format        .ppm, sRGB, here made linear$' "$lab" info picture.ppm
says '^size          3x2$' '^B             0 to 1, mean 0.166667$'
printf 'WorldBegin Translate 5 6 7 Material "none" AreaLightSource "diffuse" Shape "sphere" WorldEnd\n' >lamp.pbrt
prints 'bounds  *(4, 5, 6) to (6, 7, 8)' \
    "$lab" info lamp.pbrt # bounds are those of the surfaces that rays pass through, too
prints '; chosen$' "$lab" info "$box" --res 40 --race
# Every runner is explained: help has those of the race, in their order.
sed -n '/^  runner /,/^  at first/s/^  \([a-z_]*\)  *[0-9].*/\1/p' stdout.txt >runners.txt
check [ "$(wc -l <runners.txt)" -eq 4 ]
expect 0 '' "$program" help integrators
check [ "$(sed -n '/^Runners: /,$s/^    \([a-z_][a-z_]*\)    *[a-z].*/\1/p' stdout.txt)" = "$(cat runners.txt)" ]
expect 2 'pt has no race' "$lab" info "$box" --res 40 --race --integrator pt

# --- trace
# trace: a sample told in words and drawn; what it says to have added is what a render's film holds.
one="--res 12x12 --integrator bdpt --maxdepth 3 --pixel 3,9"
expect 0 '' "$lab" trace "$box" $one --spp 1
says '^The pixel receives [0-9.e-]* [0-9.e-]* [0-9.e-]*\.' 'what they mean: --all$'
expect 0 '' "$lab" trace "$box" $one --spp 1 --svg paths.svg --all
says 'pixel 3,9, sample 0: bdpt' '^(s,t): a path of s vertices'
check grep -Eq '^  z_1 +matte .*/m\^2' stdout.txt
check grep -Eq '^  \(1,2\) +light - z_1 ' stdout.txt
says '^  sum, which the film receives '
check awk '/<svg/ { open++ } /<\/svg>/ { open-- } /z1<\/text>/ { n++ } END { exit open != 0 || n != 2 }' paths.svg
# Names of vertices do not cover each other: 10 wide for a letter, 16 high.
expect 0 '' "$lab" trace "$scenes/../doc/mini/rooms.pbrt" --integrator bdpt --maxdepth 4 --pixel 60,80 \
    --sample 22 --svg names.svg
check awk '/<svg x=/ { n = 0 }
    match($0, /<text x="[^"]*" y="[^"]*" fill="[^"]*">[yz][0-9]+</) {
        split(substr($0, RSTART, RLENGTH), part, "\"")
        all++
        for (i = 0; i < n; i++)
            bad += (part[2] - x[i]) ^ 2 < 20 ^ 2 && (part[4] - y[i]) ^ 2 < 16 ^ 2
        x[n] = part[2]
        y[n++] = part[4]
    }
    END { exit bad || all < 14 }' names.svg
prints '^CHOICE of what to connect with: ' "$lab" trace "$box" $one --spp 4 --brightest -P select=vertices \
    --integrator asbdpt --all
check grep -Eq '^  \([2-9],[2-9]\) +y_[0-9(]+\)? - z_[0-9] +0\.' stdout.txt # with its probability
prints '^RACE: the runner [a-z_]* renders: ' "$lab" trace "$box" --pixel 3,9 --res 40 --integrator asbdpt

# How a method chooses is said in the words of the page that renders.
awk -F "'" '/^const ABOUT = / { on = 1 }
    on { for (i = 2; i < NF; i += 2) { gsub(/[^a-z0-9]/, "", $(i - 1)); print $(i - 1), $i } }
    on && /};/ { exit }' "$top/doc/web/page.js" >about.txt
told=0
while read -r name about; do
    case $name in subspaces | vertices | pool | bins) set -- asbdpt -P select=$name ;; *) set -- $name ;; esac
    "$lab" trace "$box" $one --spp 4 --integrator "$@" 2>/dev/null </dev/null |
        sed -n 's/^CHOICE of what to connect with: //p' >choice.txt
    [ -s choice.txt ] || continue
    echo "$about" | grep -Fiq -e "$(cat choice.txt)" || fault "the page says \"$about\" of $name, trace $(cat choice.txt)"
    told=$((told + 1))
done <about.txt
check [ $told -ge 12 ]

# --- worth
# worth: what was learnt, as a picture.
expect 0 '' "$lab" worth "$box" --pixel 3,9 --res 12x12 --spp 4 --quiet -o worth.png
check [ -s worth.png ]
# The race, which would choose a path tracer here, is left out.
prints '^  \(path_tracer\|one_point\) .*; chosen$' "$lab" info "$scenes/forest.pbrt" --race --integrator asbdpt --res 48x32
expect 0 '' "$lab" worth "$scenes/forest.pbrt" --pixel 12,12 --res 48x32 --spp 4 --quiet -o worth.png
expect 1 'learns nothing about pairs' "$lab" worth "$box" --pixel 3,9 --res 12x12 -P select=pool -o worth.png

# --- verify
# verify: agreement is status 0, a difference status 1.
expect 0 '' "$lab" verify "$box" --methods pt,bdpt --res 12x12 --spp 8 --maxdepth 2 --quiet
# The two sides have random numbers of their own, even with the same method: sharing them would be too alike to be true.
prints 'verdict: agree' "$lab" verify "$box" --methods bdpt,bdpt --res 12x12 --spp 8 --maxdepth 2 --quiet
expect 1 '' "$lab" verify "$box" --methods pt --spp 2 --quiet --reference ref/veach-ajar.pfm
says 'verdict: DIFFER'
# A picture against itself is identical; with other errors it is too alike to be independent.
prints '^verdict: identical' "$lab" verify --images $picture $picture
expect 1 '' "$lab" verify --images $picture ref/bathroom.pfm ref/bathroom.pfm
says '^verdict: DIFFER'
# NaN is a difference, also from itself; test_verify.c has where it may be.
expect 1 '' "$lab" verify --images nan.pfm ref/bathroom.error.pfm nan.pfm ref/bathroom.error.pfm
says '^verdict: DIFFER'
expect 1 'nan.pfm: NaN or infinite values: 2592$' "$lab" compare nan.pfm nan.pfm --max-rmse 1
# Pictures against a reference, one of them twice.
mkdir kit
sh "$scenes/unpack.sh" "$scenes/conform" conform
for k in 1 2; do "$program" render "$box" --integrator bdpt --res 32x32 --filter box --spp 4 --quiet -o kit/box-$k.pfm; done
prints '^verdict: agree' "$lab" verify --files kit/box-1.pfm kit/box-2.pfm --reference ref/cornell-box.pfm
says 'of 2 pictures 1 differ; the others are identical' '^1 pictures alone: their variance is taken from blocks'
expect 2 'usage: asbdpt-lab verify' "$lab" verify --files kit/box-1.pfm

# --- conform
# conform: what differs, in words, with status 1; what is there twice counts once.
rm kit/*
"$program" render conform/area.pbrt --integrator bdpt --spp 4 --quiet -o kit/area-1.pfm
cp kit/area-1.pfm kit/area-2.pfm
"$lab" conform kit --kit "$top/ref/conform" >stdout.txt
says '^area  *1 (blocks) .*(1 more pictures are identical: is the seed used?)' '^1 scenes: ' '^no pictures of alpha, bump' \
    '^a correct renderer has a scene that DIFFERS with probability 0.01'
rm kit/*
"$program" render conform/area.pbrt --integrator bdpt --maxdepth 2 --spp 16 --quiet -o kit/area.exr
expect 1 '' "$lab" conform kit --kit "$top/ref/conform"
says '^area .* DIFFERS' '^of the scenes with area differ 1 of 1' '^depth is counted one more explains area$'
rm kit/*
"$program" render conform/area.pbrt --res 16x16 --spp 1 --quiet -o kit/area.pfm
expect 1 'area: the pictures are 16x16, the reference 32x32; all must have the same size' "$lab" conform kit --kit "$top/ref/conform"
rm kit/*
expect 1 "holds no picture of the kit" "$lab" conform kit --kit "$top/ref/conform"
expect 1 'list.txt: cannot be opened; --kit' "$lab" conform kit --kit nowhere

# --- experiment
# equal-time: a table, and a line for every method and seed.
tiny="--res 8x8 --seeds 2 --reference-spp 4 --quiet"
prints 'geometric mean' "$lab" equal-time "$box" $tiny --spp 2 -o equal
check [ -s equal/images/cornell-box.png ]
check [ "$(head -n 1 equal/equal-time.md)" = "$(grep '^- Squared error' stdout.txt)" ] # the verdict first
check [ "$(grep -c '^cornell-box,' equal/runs.csv)" = 4 ]
check [ "$(grep -c '^cornell-box,bdpt,.*,2,' equal/runs.csv)" = 2 ]
prints 'equal-time --seconds 0.01 --methods bdpt,asbdpt:select=pool --seeds 2' \
    "$lab" equal-time "$box" --methods bdpt,asbdpt:select=pool --seconds 0.01 $tiny -o equal
check [ "$(grep -c '^cornell-box,asbdpt:select=pool,' equal/runs.csv)" = 2 ]
# Fewer than three seeds need a reference that is stored and says how noisy it is.
expect 1 'fewer than three seeds need a stored reference whose noise is known; use --seeds 3, or' \
    "$lab" equal-time "$box" $tiny --res 9x9 --spp 2 -o few
cp ref/cornell-box.pfm plain.pfm
expect 1 'fewer than three seeds' "$lab" equal-time "$box" $tiny --spp 2 --reference plain.pfm -o few
check [ ! -e few ]
echo 'noise8 0.5' >plain.txt
prints '^| asbdpt | - |$' "$lab" equal-time "$box" $tiny --spp 2 --seeds 1 --reference plain.pfm -o few
check awk -F , '{ for (i = 1; i <= NF; i++) at[NR, i] = $i }
    END { exit NF != 16 || at[1, 8] != "mse8" || at[1, 9] != "relmse" || at[1, 10] != "relmse8x8" || at[2, 9] != "" ||
          (at[2, 8] - at[2, 6] ^ 2 + 0.25 / 16) ^ 2 > 1e-6 }' few/runs.csv # a pixel is the mean of 4x4 of the reference
# family: once more, nothing is measured again.
set -- "$box" "$scenes/veach-ajar.pbrt" --methods bdpt,pt,lvc --quick --spp 2 --res 8x8 --seeds 3 -o family
expect 0 'cornell-box, lvc:.*, seed' "$lab" family "$@"
check grep -q '^| lvc |' family/family.md
expect 0 '' "$lab" family "$@"
check [ "$(grep -c ', seed ' stderr.txt)" = 0 ]
# A reference is of the scene, or it is none: another's of the same name is not taken.
mkdir -p bathroom/ref
echo 'Film "image" "integer xresolution" 32 "integer yresolution" 32 WorldBegin
LightSource "point" "point from" [0 0 -3] Shape "sphere" WorldEnd' >bathroom/scene.pbrt
cp ref/bathroom.pfm ref/made.txt bathroom/ref
tiny="--seeds 3 --spp 1 --reference-spp 4 --methods bdpt"
expect 0 'bathroom.pfm.* is of another scene: measured at 32x32 pixels' \
    "$lab" equal-time bathroom/scene.pbrt $tiny -o foreign

# --- convert
# convert: linear formats keep light (.float.exr exactly), 8-bit ones what they hold; - reads and writes PFM.
"$program" render "$box" --res 37x23 --spp 4 --quiet -o light.pfm -o light.png
makes light.png "$program" convert light.pfm -o x.float.exr -o x.exr -o x.ppm -o x.png
makes light.pfm "$program" convert x.float.exr -o back.pfm
makes light.png "$program" convert x.ppm -o y.PNG
"$program" convert - -o - --quiet <light.pfm >through.pfm
check cmp -s light.pfm through.pfm

# An 8-bit image and the PFM that convert makes of it are, but for rounding, the same sky, by --linear, and the same
# texture, without.
printf 'P3 2 1 255 128 20 255 7 90 0 ' >map.ppm
both() { # SKY TEXTURE
    echo "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 Translate 0 0 3 Camera \"perspective\"
        WorldBegin LightSource \"infinite\" \"string mapname\" \"$1\" Texture \"t\" \"spectrum\" \"imagemap\"
        \"string filename\" \"$2\" Material \"matte\" \"texture Kd\" \"t\" Shape \"sphere\" WorldEnd" >both.pbrt
}
expect 0 '' "$program" convert map.ppm --linear -o sky.pfm
expect 0 '' "$program" convert map.ppm -o map.pfm
both map.ppm map.ppm
expect 0 '' "$program" render both.pbrt --spp 2 --quiet -o both.ppm
both sky.pfm map.pfm
makes both.ppm "$program" render both.pbrt --spp 2 --quiet -o pfm.ppm
prints '^rmse  *[0-9.]*e-0[89]$\|^rmse  *0$' "$lab" compare map.ppm map.pfm
# row: `asbdpt convert`, `asbdpt-lab compare`
# row: 8-bit images that `convert` reads

# --exposure and --tonemap: of 8-bit pictures alone, the same in render and convert; without them nothing changes.
makes light.pfm "$program" render "$box" --res 37x23 --spp 4 --quiet --exposure -2 --tonemap filmic -o dark.png \
    -o dark.pfm
makes dark.png "$program" convert light.pfm --exposure -2 --tonemap filmic -o y.png
check test -n "$(cmp light.png y.png 2>&1)"

# ImageMagick, where it is installed, reads the same bytes of pixels from our files.
if command -v convert >/dev/null && convert -version | grep -q ImageMagick; then
    for kind in png ppm; do expect 0 '' convert x.$kind -depth 8 rgb:theirs.$kind; done
    check cmp -s theirs.png theirs.ppm
else
    echo "skipped: pictures of ImageMagick (convert is not installed)"
fi

# Each runner of each method that can race, in a scene of matte and four lamps: path tracers need no light sub-paths.
echo 'Film "image" "integer xresolution" 9 "integer yresolution" 9 LookAt 0 0 -4 0 0 0 0 1 0 Camera "perspective"
    WorldBegin LightSource "point" "point from" [3 0 -3] LightSource "point" "point from" [-3 0 -3]
    LightSource "point" "point from" [0 3 -3] LightSource "point" "point from" [0 -3 -3]
    Shape "sphere" WorldEnd' >four.pbrt
for select in pool vertices subspaces; do
    for race in all quarter path_tracer one_point; do
        expect 0 '' "$program" render four.pbrt --integrator asbdpt -P select=$select -P race=$race --spp 2 --quiet -o four.ppm
    done
done

# --- end
[ $failures -eq 0 ] && echo "command line: all as expected"
exit $((failures > 0))

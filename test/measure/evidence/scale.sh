#!/bin/sh
# scale.sh DIR: how time and memory grow with triangles, lights, pixels, samples and threads. Measures into
# DIR/scale.txt, lines "AXIS N QUANTITY VALUE"; a size that is there is not measured again. scale.awk makes the table
# and the figure.
#   triangles: a wavy floor of so many below one lamp; lights: so many small lamps under the ceiling of a hall, the sum
#   of their power the same; the other three: the Cornell box. Memory is the peak of a process that does nothing else.
dir=$1
lab=./asbdpt-lab
mkdir -p "$dir"
touch "$dir/scale.txt"
has() { grep -q "^$1 $2 " "$dir/scale.txt"; }

# header: what all scenes here have in common.
header() {
    echo "Film \"image\" \"integer xresolution\" 128 \"integer yresolution\" 128 \"string filename\" \"x.pfm\""
    echo "Sampler \"random\" \"integer pixelsamples\" 8 Integrator \"bdpt\" \"integer maxdepth\" 5"
    echo "LookAt 0 1 -3  0 0.4 0  0 1 0 Camera \"perspective\" \"float fov\" 50 WorldBegin"
    echo "Material \"matte\" \"rgb Kd\" [.6 .6 .6]"
}
quad() { # FOUR POINTS, counter-clockwise from inside
    echo "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [$*]"
}
hall() { # without its floor
    quad -2 0 -4  -2 2 -4  2 2 -4  2 0 -4
    quad -2 0 2  2 0 2  2 2 2  -2 2 2
    quad -2 0 -4  -2 0 2  -2 2 2  -2 2 -4
    quad 2 0 -4  2 2 -4  2 2 2  2 0 2
    quad -2 2 -4  -2 2 2  2 2 2  2 2 -4
}
lamps() { # NUMBER: triangles of together a square of half a metre, spread over the ceiling
    awk -v n="$1" 'BEGIN {
        columns = int(sqrt(n)); if (columns < 1) columns = 1
        rows = int((n + columns - 1) / columns)
        r = sqrt(2 * 0.25 / n) / 2
        for (i = 0; i < n; i++) {
            x = -1.8 + 3.6 * (i % columns + 0.5) / columns
            z = -3.8 + 5.6 * (int(i / columns) + 0.5) / rows
            printf "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [20 20 20] Shape \"trianglemesh\" "
            printf "\"integer indices\" [0 1 2] \"point P\" [%g 1.98 %g %g 1.98 %g %g 1.98 %g] AttributeEnd\n",
                x - r, z - r, x + r, z - r, x - r, z + r
        }
    }'
}
floor_of() { # NUMBER: of triangles, in a PLY file
    awk -v wanted="$1" 'BEGIN {
        n = int(sqrt(wanted / 2)); if (n < 1) n = 1
        print "ply\nformat ascii 1.0\nelement vertex " (n + 1) * (n + 1)
        print "property float x\nproperty float y\nproperty float z\nelement face " 2 * n * n
        print "property list uchar int vertex_indices\nend_header"
        for (j = 0; j <= n; j++) for (i = 0; i <= n; i++) {
            x = -2 + 4 * i / n; z = -4 + 6 * j / n
            printf "%.6f %.6f %.6f\n", x, 0.1 + 0.05 * sin(9 * x) * sin(7 * z) + 0.02 * sin(41 * x + 3 * z), z
        }
        for (j = 0; j < n; j++) for (i = 0; i < n; i++) {
            a = j * (n + 1) + i; b = a + n + 1
            print "3", a, b, a + 1 "\n3", a + 1, b, b + 1
        }
    }'
}
# bench AXIS N SCENE: what `bench` says of it.
bench() {
    $lab bench "$3" >"$dir/bench.txt" || exit 1
    awk -v axis="$1" -v n="$2" '
        $1 ~ /^(load_s|build_s|closest|bdpt_us|asbdpt_us|peak_mib)$/ { v[$1] = $2 }
        END {
            print axis, n, "load", v["load_s"]; print axis, n, "build", v["build_s"]
            print axis, n, "ray", 1 / v["closest"]; print axis, n, "bdpt", v["bdpt_us"]
            print axis, n, "asbdpt", v["asbdpt_us"]; print axis, n, "memory", v["peak_mib"]
        }' "$dir/bench.txt" >>"$dir/scale.txt"
}
# render AXIS N OPTION...: CPU time and memory of renders of the Cornell box by bdpt and asbdpt.
render() {
    axis=$1 size=$2
    shift 2
    has "$axis" "$size" && return
    for integrator in bdpt asbdpt; do
        ./asbdpt render scenes/cornell-box.pbrt --integrator $integrator --quiet "$@" -o "$dir/x.pfm" \
            --stats "$dir/x.json" || exit 1
        awk -v axis="$axis" -v n="$size" -v name=$integrator -F '[":, ]+' '
            $2 == "cpu_seconds" { cpu = $3 } $2 == "peak_memory" { memory = $3 / 1048576 }
            END { print axis, n, name, cpu; print axis, n, name "-memory", memory }' "$dir/x.json"
    done >>"$dir/scale.txt"
}

for n in 1000 10000 100000 1000000; do
    has triangles "$n" && continue
    floor_of "$n" >"$dir/floor.ply"
    { header; hall; lamps 1; echo 'Shape "plymesh" "string filename" "floor.ply" WorldEnd'; } >"$dir/scene.pbrt"
    bench triangles "$n" "$dir/scene.pbrt"
done
for n in 1 10 100 1000 10000 100000; do
    has lights "$n" && continue
    { header; hall; quad -2 0 -4  2 0 -4  2 0 2  -2 0 2; lamps "$n"; echo WorldEnd; } >"$dir/scene.pbrt"
    bench lights "$n" "$dir/scene.pbrt"
done
for n in 32 64 128 256 512; do render pixels $((n * n)) --spp 2 --res "${n}x$n" -j1; done
for n in 1 4 16 64 256; do render samples "$n" --spp "$n" --res 64x64 -j1; done
for n in $(seq "$(getconf _NPROCESSORS_ONLN)"); do render threads "$n" --spp 16 --res 128x128 -j "$n"; done
rm -f "$dir"/floor.ply "$dir"/scene.pbrt "$dir"/x.*

#!/bin/sh
# sample.sh LAB [SAMPLE]: prints doc/tour/one-sample.md: one-sample.in with the numbers of a sample that asbdpt-lab traces.
# {NAME} is a value that trace --values prints, to four digits, {NAME:FORMAT} as printf writes it; a line with {X.#.Y}
# stands once for every number that # can be. Exit status 1 if a value is not there. Run from the top.
scene="scenes/cornell-box.pbrt --res 64x64 --spp 16 --maxdepth 3 -P race=off"
sample=${2:-8}
# shellcheck disable=SC2086
values=$("$1" trace $scene --pixel 32,32 --sample "$sample" --values) || exit 1
printf '%s\n' "$values" "command $scene --pixel 32,32 --sample $sample" "render $scene --samples $sample:$((sample + 1))" |
    LC_ALL=C awk '
    function value(name, format,    n, i, part, out) {
        if (!(name in is)) { print "one-sample.in: there is no value " name >"/dev/stderr"; bad = 1 }
        if (is[name] !~ /^[-+.0-9e ]+$/) return is[name]
        n = split(is[name], part, " ")
        for (i = 1; i <= n; i++) out = out (i > 1 ? " " : "") sprintf(format == "" ? "%.4g" : format, part[i])
        gsub(/-0\.0/, "0.0", out)
        return out
    }
    function fill(s,    out, name, format) {
        while (match(s, /\{[A-Za-z_][^}]*\}/)) {
            name = format = substr(s, RSTART + 1, RLENGTH - 2)
            sub(/:.*/, "", name)
            if (!sub(/^[^:]*:/, "", format)) format = ""
            out = out substr(s, 1, RSTART - 1) value(name, format)
            s = substr(s, RSTART + RLENGTH)
        }
        return out s
    }
    FILENAME == "-" { name = $1; sub(/^[^ ]* /, ""); is[name] = $0; next }
    match($0, /\{[a-z]+\.#\.[A-Za-z]+/) {
        name = substr($0, RSTART + 1, RLENGTH - 1)
        for (i = 0; i < 100; i++) {
            key = name
            line = $0
            sub(/#/, i, key)
            gsub(/#/, i, line)
            if (key in is) print fill(line)
        }
        next
    }
    { print fill($0) }
    END { exit bad }' - doc/tour/one-sample.in

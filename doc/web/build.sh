#!/bin/sh
# build.sh OUT.html [CLANG]: the page that renders, as one file of a megabyte and a half: page.html with page.js and
# worker.js, and, packed by gzip, the program as WebAssembly, the scenes and their references. Needs clang with lld,
# wasi-libc and libclang-rt for wasm32 (Debian: clang, lld, wasi-libc, libclang-rt-dev-wasm32); without them it says so
# and makes nothing. What it shows as the reference, doc/web/reference/NAME.webp, is of asbdpt with 256 samples and three
# times the stored reference's width (cwebp -q 95). Run from the top; `make web` calls it.
out=$1
clang=${2:-clang}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
target="--target=wasm32-wasi -mexec-model=reactor"
echo 'void f(void); void f(void) {}' >"$dir/a.c"
if ! command -v "$clang" >/dev/null || ! "$clang" $target -o "$dir/a.wasm" "$dir/a.c" 2>/dev/null; then
    echo "web: skipped, $clang cannot compile for wasm32-wasi here"
    exit 0
fi
printf 'web_show\nweb_learns\n' >"$dir/page" # what the page has to give
# Of the laboratory the other methods, and what tells of a sample.
sources="$(ls src/*/*.c | grep -v -e '/main\.c' -e '/program\.c' -e 'render/rows\.c') $(ls test/lab/rivals/*.c test/lab/chains/*.c test/lab/caustics/*.c)
    test/lab/rows.c test/lab/methods.c test/lab/compare.c test/lab/sheet.c test/lab/cmd_trace.c test/lab/trace.c
    test/lab/trace_text.c test/lab/trace_svg.c
    test/lab/race_table.c"
"$clang" $target -std=c99 -Werror -Oz -Isrc -Itest -Itest/lab -ffp-contract=off -D_WASI_EMULATED_SIGNAL -Wl,-z,stack-size=4194304,-s \
    -Wl,--allow-undefined-file="$dir/page",--export=web_words,--export=web_command,--export=web_begin,--export=web_step \
    -o "$dir/web.wasm" $sources doc/web/web.c -lm -lwasi-emulated-signal || exit 1

embed() { # ATTRIBUTES FILE: a script that is none, with the file in it
    echo "<script type=\"text/plain\" $1>"
    gzip -9 -n <"$2" | base64 | tr -d '\n'
    echo '</script>'
}
# files SCENE: it, and all that it names: whatever stands between quotes and is a file in scenes/.
files() {
    echo "$1"
    case $1 in
    *.pbrt | *.inc) tr '"' '\n' <"$1" | while IFS= read -r name; do [ ! -f "scenes/$name" ] || files "scenes/$name"; done ;;
    esac
}
{
    sed '/^<!-- EMBEDDED -->$/,$d' doc/web/page.html
    embed 'data-path="wasm"' "$dir/web.wasm"
    echo '<script type="text/plain" id="worker">'
    cat doc/web/worker.js
    echo '</script>'
    for name in $(sed -n 's/^== //p' ref/made.txt); do
        embed "data-path=\"ref/$name.pfm\"" "ref/$name.pfm"
        embed "data-path=\"fine/$name.webp\"" "doc/web/reference/$name.webp"
        files "scenes/$name.pbrt" >&3
    done 3>"$dir/files"
    sort -u "$dir/files" | while IFS= read -r file; do embed "data-path=\"$file\"" "$file"; done
    embed 'data-path="scenes/rooms.pbrt"' doc/mini/rooms.pbrt # of the tour
    embed 'data-path="ref/rooms.pfm"' doc/web/rooms.pfm
    embed 'data-path="fine/rooms.webp"' doc/web/reference/rooms.webp
    echo '<script>'
    cat doc/web/page.js
    echo '</script>'
    sed '1,/^<!-- EMBEDDED -->$/d' doc/web/page.html
    echo "<!-- built by $("$clang" --version | head -n 1) -->"
} >"$dir/page.html" && mkdir -p "$(dirname "$out")" && mv "$dir/page.html" "$out" &&
    echo "wrote $out, $(wc -c <"$out" | tr -d ' ') bytes"

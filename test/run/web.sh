#!/bin/sh
# web.sh PAGE: the page that renders, in a headless Chromium, from a file and without a network: every scene is
# rendered by every method, both pictures grow and their errors fall, every control does what it says, an error takes
# the place of the picture, a click tells a sample, and the floats of a finished picture are the native program's, bit
# for bit. Skipped with a line where there is no page, since nothing here compiles for WebAssembly, or no Chromium.
# Run from the top:
#   sh test/run/web.sh out/asbdpt.html
page=$1
for browser in ${CHROMIUM:-chromium chromium-browser google-chrome chrome} none; do
    command -v "$browser" >/dev/null 2>&1 && break
done
[ -s "$page" ] || { echo "page that renders: skipped, $page was not built"; exit 0; }
[ "$browser" = none ] && { echo "page that renders: skipped, no Chromium is installed"; exit 0; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# What the native program makes of what the page is going to be asked: the bytes of the pixels, top row first.
native() { # NAME OPTION...
    name=$1
    shift
    ./asbdpt render scenes/cornell-box.pbrt --filter box --res 64x64 --spp 8 --quiet -o "$dir/$name.pfm" "$@" || exit 1
    row=$((64 * 12))
    for y in $(seq 1 64); do # the file has the lowest row first
        tail -c $((y * row)) "$dir/$name.pfm" | head -c $row
    done | od -An -v -tu1 | awk '{ for (i = 1; i <= NF; i++) sum = (sum * 31 + $i) % 1000003 } END { print sum + 0 }'
}
bdpt=$(native bdpt --integrator bdpt)
bins=$(native bins --integrator asbdpt -P select=bins -P binpaths=4 -P restart=4)

{
    cat "$page"
    cat <<END
<script>
const NATIVE = [$bdpt, $bins];
END
    cat test/run/web.js
    echo '</script>'
} >"$dir/reader.html"

: >"$dir/log"
# A browser that knows no other time than the clock's, until it has said how it went.
"$browser" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --user-data-dir="$dir/profile" --remote-debugging-port=0 \
    --enable-logging=stderr --window-size=1200,1500 "file://$dir/reader.html" >/dev/null 2>"$dir/log" &
pid=$!
i=0
while [ $i -lt 1800 ] && ! grep -q 'WEB .* END' "$dir/log" && kill -0 $pid 2>/dev/null; do
    sleep 1
    i=$((i + 1))
done
kill $pid 2>/dev/null
wait $pid 2>/dev/null
if grep -q 'WEB ALL RIGHT END' "$dir/log"; then
    echo "page that renders: all as expected"
    exit 0
fi
echo "FAIL: $page: $(grep -o 'WEB .* END' "$dir/log" || tail -n 3 "$dir/log")"
exit 1

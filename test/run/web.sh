#!/bin/sh
# web.sh PAGE: the page that renders, in a headless Chromium, from a file and without a network: every scene and every
# method is rendered, both pictures grow and their errors fall, every control does what it says, an error takes the
# place of the picture, a click tells a sample, and the floats of a finished picture are the native program's, bit for
# bit. FULL=yes: every scene by every method. Skipped with a line where there is no page, since nothing here compiles
# for WebAssembly, or no Chromium. LIMIT: seconds after which it ends without a verdict, which is a failure that says
# what it waited for (170; FULL 1800). Run from the top:
#   sh test/run/web.sh out/asbdpt.html
page=$1
for browser in ${CHROMIUM:-chromium chromium-browser google-chrome chrome} none; do
    command -v "$browser" >/dev/null 2>&1 && break
done
[ -s "$page" ] || { echo "page that renders: skipped, $page was not built"; exit 0; }
[ "$browser" = none ] && { echo "page that renders: skipped, no Chromium is installed"; exit 0; }
dir=$(mktemp -d) || exit 1
pid=
clear() { # The browser's own processes end after it, and write into its profile until then.
    [ -z "$pid" ] || { kill "$pid" 2>/dev/null; wait "$pid" 2>/dev/null; }
    rm -rf "$dir" 2>/dev/null || { sleep 1; rm -rf "$dir"; }
}
trap clear EXIT
trap 'exit 1' HUP INT TERM
begun=$(date +%s)
limit=${LIMIT:-$([ -n "$FULL" ] && echo 1800 || echo 170)}

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
const NATIVE = [$bdpt, $bins], FULL = $([ -n "$FULL" ] && echo true || echo false);
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
while ! grep -q 'WEB .* END' "$dir/log" && kill -0 $pid 2>/dev/null && [ $(($(date +%s) - begun)) -lt "$limit" ]; do
    sleep 1
done
if grep -q 'WEB ALL RIGHT END' "$dir/log"; then
    echo "page that renders: all as expected, $(($(date +%s) - begun)) s"
    exit 0
fi
if grep -q 'WEB .* END' "$dir/log"; then
    said=$(grep -o 'WEB .* END' "$dir/log")
elif kill -0 $pid 2>/dev/null; then
    said="no verdict after $limit s of LIMIT, load $(uptime | sed 's/.*: //'); it waited for: "
    said=$said$(sed -n 's/.*WEB AT \(.*\) TA.*/\1/p' "$dir/log" | tail -n 1)
else
    said="the browser ended: $(tail -n 3 "$dir/log")"
fi
echo "FAIL: $page: $said"
exit 1

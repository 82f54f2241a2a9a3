#!/bin/sh
# report.sh PROGRAM: report.html as people see it, in a headless Chromium at two widths: of equal-time the verdict comes
# before the numbers, every name of a curve lies whole within its drawing, and apart from the other names, pictures
# appear, and nothing is wider than the window. Skipped with a line where there is no Chromium. Run from the top:
#   sh test/run/report.sh ./asbdpt
lab=$1-lab
for browser in ${CHROMIUM:-chromium chromium-browser google-chrome chrome} none; do
    command -v "$browser" >/dev/null 2>&1 && break
done
[ "$browser" = none ] && { echo "report: skipped, no Chromium is installed"; exit 0; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
bad=0

# The first method has the longest name that tables have; three end in nearly the same place.
long=asbdpt:select=subspaces:connections=1:pathpixels=1
"$lab" equal-time scenes/cornell-box.pbrt --res 32x32 --spp 32 --seeds 3 --quiet -o "$dir/results" \
    --methods "bdpt,$long,$long:delta=0.3,lvc:connections=1" >/dev/null || exit 1
cat >"$dir/ask.js" <<'END'
setTimeout(async () => {
  const wrong = [], check = (ok, text) => { if (!ok) wrong.push(text); };
  for (let i = 0; i < 600 && !document.querySelector('canvas'); i++)
    await new Promise(done => setTimeout(done, 50));
  const table = document.querySelector('table'), before = e => e.compareDocumentPosition(table) === 4;
  const items = [...document.querySelectorAll('li')].filter(before).map(li => li.textContent);
  check(items.length === 7 && /^Squared error of .* after the same time.*\.$/.test(items[0]), 'verdict: ' + items);
  for (const svg of document.querySelectorAll('svg')) {
    const outer = svg.getBoundingClientRect(), names = [...svg.querySelectorAll('text[style]')];
    const boxes = names.map(text => text.getBoundingClientRect());
    check(names.map(n => n.textContent).join('').includes('pathpixels=1:delta=0.3'), 'a name is not whole');
    boxes.forEach((box, i) => {
      const text = names[i].textContent;
      check(box.right <= outer.right && box.bottom <= outer.bottom && box.top >= outer.top, text + ' is cut');
      check(i === 0 || box.top >= boxes[i - 1].top + 11, text + ' is over another');
    });
  }
  check(document.querySelectorAll('canvas').length === 2, 'pictures');
  check(document.documentElement.scrollWidth <= innerWidth + 1, 'the page is wider than the window');
  console.log('REPORT ' + (wrong.length ? 'WRONG: ' + wrong.join('; ') : 'ALL RIGHT') + ' END');
}, 0);
END
{ cat "$dir/results/report.html"; echo '<script>'; cat "$dir/ask.js"; echo '</script>'; } >"$dir/page.html"
for width in 1280 500; do
    : >"$dir/log"
    "$browser" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
        --disable-component-update --disable-sync --user-data-dir="$dir/profile" --remote-debugging-port=0 \
        --enable-logging=stderr --window-size=$width,3000 "file://$dir/page.html" >/dev/null 2>"$dir/log" &
    pid=$!
    i=0
    while [ $i -lt 60 ] && ! grep -q 'REPORT .* END' "$dir/log" && kill -0 $pid 2>/dev/null; do
        sleep 1
        i=$((i + 1))
    done
    kill $pid 2>/dev/null
    wait $pid 2>/dev/null
    grep -q 'REPORT ALL RIGHT END' "$dir/log" && continue
    echo "FAIL: report.html, $width pixels wide: $(grep -o 'REPORT .* END' "$dir/log" || tail -n 3 "$dir/log")"
    bad=1
done
[ $bad -eq 0 ] && echo "report: all as expected"
exit $bad

#!/bin/sh
# report_browser.sh: the experiment's report as a reader meets it, in a headless Chromium: every picture and plot is
# there, the viewer's controls do what they say, tables sort, nothing is asked from the network, a phone's width needs
# no sideways scrolling. Skipped with a line where no Chromium is installed.
# Run from the top: sh test/report_browser.sh REPORT.html [DIRECTORY for screenshots]
report=$1
shots=$2
for browser in ${CHROMIUM:-chromium chromium-browser google-chrome chrome} none; do
    command -v "$browser" >/dev/null 2>&1 && break
done
if [ "$browser" = none ]; then
    echo "report in a browser: skipped, no Chromium is installed"
    exit 0
fi
[ -s "$report" ] || { echo "FAIL: no report at $report; run make experiments"; exit 1; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# browse ARGUMENTS: one start of the browser with a profile of its own.
browse() {
    rm -rf "$dir/profile"
    "$browser" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
        --disable-component-update --disable-sync --hide-scrollbars --user-data-dir="$dir/profile" \
        --virtual-time-budget=8000 "$@" 2>"$dir/errors"
}

# The page with a reader at its end: clicks, then writes what went wrong into its title.
{
    cat "$report"
    cat <<'END'
<script>
window.addEventListener('load', () => setTimeout(() => {
  const wrong = [];
  const check = (ok, text) => { if (!ok) wrong.push(text); };
  const all = (selector, root) => [...(root || document).querySelectorAll(selector)];
  const sum = canvas => canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data
    .reduce((s, v, i) => (s * 31 + v) % 1000003, 7);
  try {
    check(all('img').length > 0 && all('img').every(i => i.complete && i.naturalWidth > 0), 'a picture is missing');
    check(all('img').every(i => i.alt.length > 10), 'a picture has no description');
    check(all('svg.plot').length === 5 * all('.viewer').length, 'a plot is missing');
    check(all('svg.plot').every(s => s.querySelectorAll('path').length > 20 && s.getBoundingClientRect().width > 100),
      'a plot is empty');
    check(all('svg.plot').every(s => s.querySelector('desc').textContent.length > 20), 'a plot has no description');
    check(document.documentElement.scrollWidth <= window.innerWidth + 1, 'the page is wider than the window: ' +
      document.documentElement.scrollWidth);
    check(performance.getEntriesByType('resource').every(e => e.name.startsWith('data:')), 'the page loads something');
    const viewers = all('.viewer');
    check(viewers.length > 0, 'no viewer');
    for (const v of viewers) {
      const name = v.dataset.scene + ': ', mode = m => v.querySelector(`input[value=${m}]`).click();
      const views = all('canvas', v), range = v.querySelector('input.split'), out = v.querySelector('output');
      const buttons = Object.fromEntries(all('button', v).map(b => [b.textContent, b]));
      const visible = e => e.getClientRects().length > 0;
      const shown = all(`img[data-scene="${v.dataset.scene}"][data-kind=picture]`);
      check(visible(v), name + 'hidden');
      check(views.length === 2 && views.every(visible), name + 'side by side shows two pictures');
      const left = sum(views[0]);
      check(left !== sum(views[1]), name + 'the two pictures are the same');
      const [a, b] = all('select', v);
      const previous = a.value;
      a.value = b.value;
      a.dispatchEvent(new Event('change'));
      check(sum(views[0]) === sum(views[1]), name + 'the same choice shows the same picture');
      a.value = previous;
      a.dispatchEvent(new Event('change'));
      check(sum(views[0]) === left, name + 'the first choice again');

      views[1].focus();
      views[1].dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft', bubbles: true, cancelable: true}));
      check(/^pixel \d+, \d+ of/.test(out.textContent) && /reference( +\d+){3}/.test(out.textContent) &&
        out.textContent.split('\n').length === 1 + shown.length, name + 'the read-out says ' + out.textContent);
      const before = views.map(sum);
      buttons['+'].click();
      check(sum(views[0]) !== before[0] && sum(views[1]) !== before[1], name + 'zoom reaches both pictures');
      buttons['1:1'].click();
      check(sum(views[0]) === before[0], name + 'the whole picture again');
      const r = views[0].getBoundingClientRect();
      views[0].dispatchEvent(new PointerEvent('pointermove', {clientX: r.left + 2, clientY: r.top + 2}));
      check(/^pixel 0, 0 of/.test(out.textContent), name + 'the top left pixel is 0, 0, not ' + out.textContent);
      const img = document.querySelector(`img[data-scene="${v.dataset.scene}"]`), c = document.createElement('canvas');
      c.getContext('2d').drawImage(img, 0, 0);
      const rgb = [...c.getContext('2d').getImageData(0, 0, 1, 1).data].slice(0, 3);
      check(new RegExp('reference +' + rgb.join(' +') + '\\n').test(out.textContent),
            name + 'the values of that pixel');

      // Errors in place of pictures: the heat map of the right one, nothing for the reference.
      const pictures = views.map(sum);
      mode('error');
      const heat = all(`img[data-scene="${v.dataset.scene}"][data-kind=error]`);
      check(heat.length === shown.length - 1 && sum(views[1]) !== pictures[1], name + 'errors are shown');
      check(sum(views[0]) !== pictures[0], name + 'the reference shows no picture among errors');
      mode('picture');
      check(views.map(sum).join() === pictures.join(), name + 'the pictures again');

      // Exposure: two stops down and back; 8-bit values become those of a quarter of the light.
      const slider = v.querySelector('input.exposure');
      const stops = n => { slider.value = n; slider.dispatchEvent(new Event('input')); };
      const readReference = () => /reference((?: +\d+){3})/.exec(out.textContent)[1].trim().split(/ +/).map(Number);
      const linear = b => b / 255 <= 0.04045 ? b / 255 / 12.92 : ((b / 255 + 0.055) / 1.055) ** 2.4;
      const dim = readReference();
      stops(-2);
      const dimmer = readReference();
      const near = 0.01 + 0.03 * linear(Math.max(...dim));
      check(dim.every((b, i) => b === 255 || Math.abs(linear(dimmer[i]) * 4 - linear(b)) < near),
            name + 'two stops down: ' + dim + ' became ' + dimmer);
      check(sum(views[0]) !== pictures[0] && sum(views[1]) !== pictures[1], name + 'exposure reaches both pictures');
      stops(0);
      check(views.map(sum).join() === pictures.join(), name + 'exposure 0 shows the pictures of the page');

      mode('slider');
      check(visible(range) && !visible(views[1]), name + 'the slider has one picture and a handle');
      const middle = sum(views[0]);
      range.value = 900;
      range.dispatchEvent(new Event('input'));
      check(sum(views[0]) !== middle, name + 'the slider moves the border');
      mode('flip');
      const one = sum(views[0]);
      check(visible(buttons.flip), name + 'a button to flip');
      buttons.flip.click();
      const two = sum(views[0]);
      buttons.flip.click();
      check(one !== two && sum(views[0]) === one, name + 'flip shows one, the other, and the first again');
      mode('side');
    }
    check(all('a[href$=".csv"]').length === 2, 'links to the numbers');
    check(all('figure.strategies img').length === viewers.length, 'a pyramid of strategies for each scene');
    const scene = document.querySelector('section[id^=scene-] table'), heads = all('thead button', scene);
    const column = i => all('tbody tr', scene).map(row => Number(row.cells[i].dataset.value));
    const rises = x => x.every((v, i) => i === 0 || v >= x[i - 1]);
    heads[1].click();
    check(rises(column(1)), 'a click sorts: ' + column(1));
    heads[1].click();
    check(rises(column(1).reverse()), 'a second click turns round: ' + column(1));
    check(all('th[aria-sort=descending]', scene).length === 1, 'the order is announced');
    check(all('button, select, canvas, input, a').every(e => e.tabIndex >= 0),
          'a control cannot be reached by keyboard');
  } catch (e) { wrong.push(String(e)); }
  document.title = wrong.length ? 'WRONG: ' + wrong.join('; ').replace(/\s+/g, ' ') : 'ALL RIGHT';
}, 300));
</script>
END
} >"$dir/reader.html"

failures=0
for width in 1280 500; do
    browse --window-size=$width,900 --dump-dom "file://$dir/reader.html" >"$dir/dom.html"
    title=$(grep -o '<title>[^<]*</title>' "$dir/dom.html" | head -n 1)
    if [ "$title" != "<title>ALL RIGHT</title>" ]; then
        echo "FAIL: at a width of $width: $title"
        failures=$((failures + 1))
    fi
done

# What it looks like, for people.
if [ -n "$shots" ]; then
    mkdir -p "$shots"
    case $report in /*) page=$report ;; *) page=$PWD/$report ;; esac
    browse --window-size=1200,2400 --screenshot="$shots/light.png" "file://$page"
    browse --window-size=1200,2400 --blink-settings=preferredColorScheme=0 --screenshot="$shots/dark.png" "file://$page"
    browse --window-size=500,2400 --screenshot="$shots/phone.png" "file://$page"
    browse --print-to-pdf="$shots/print.pdf" "file://$page"
    for file in light.png dark.png phone.png print.pdf; do
        [ -s "$shots/$file" ] || { echo "FAIL: no $file"; failures=$((failures + 1)); }
    done
fi
[ $failures -eq 0 ] && echo "report in a browser: all as expected"
exit $((failures > 0))

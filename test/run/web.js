// web.js: what web.sh asks of the page that renders, in the page itself. NATIVE: sums of the native program's pixels.
// FULL: every scene by every method. It says what it waits for; web.sh has the limit of time.
const wrong = [], check = (ok, text) => { if (!ok) wrong.push(text); };
const sleep = ms => new Promise(done => setTimeout(done, ms));
const until = async (what, text) => {
  console.log(`WEB AT ${[...wrong, text].join('; ')} TA`);
  while (!what())
    await sleep(100);
};
const turn = (id, value) => { $(id).value = value; $(id).dispatchEvent(new Event('input', { bubbles: true })); };
const sum = bytes => bytes.reduce((s, v) => (s * 31 + v) % 1000003, 0);
const done = () => sides.every(s => s.done);
const isBlank = i => {
  const canvas = $(`picture${i}`);
  return !canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.some(v => v > 0 && v < 255);
};
async function rendered(settings) {
  for (const [id, value] of settings) turn(id, value);
  await sleep(400); // the page waits for the last of several changes
  await until(done, 'the end of a render with ' + settings.join(' '));
  for (const [i, side] of sides.entries())
    check(!side.last || side.last.iterations === spp(), `side ${i}: ${side.last?.iterations} of ${spp()} samples`);
}
(async () => {
  await until(() => SCENES.length > 0, 'the unpacked scenes');
  check(SCENES.length === 12 && SCENES.includes('rooms') && SCENES.includes('living-room'), 'scenes: ' + SCENES);
  await until(() => sides.every(s => s.worker), 'its start');
  check($('reference').width > 20 && $('select').length === 21, 'reference and methods');
  await until(() => $('reference').width >= 72, 'a reference as fine as the picture');
  turn('scale', 2);
  turn('spp', 4);
  await rendered([['scene', 'cornell-box'], ['select', 'vertices']]);
  for (const [i, side] of sides.entries()) {
    check(side.points.length === 16, `side ${i}: ${side.points.length} pictures of 16`);
    check(side.points[15][1] < 0.5 * side.points[0][1], `side ${i}: the error does not fall: ` +
      side.points.map(p => p[1].toFixed(1)));
    check(Math.abs(side.points[15][2]) < 4, `side ${i}: the mean is off by ${side.points[15][2]} %`);
    check($(`caption${i}`).textContent.includes(' at 32 x 32, mean'), 'size of the error: ' + $(`caption${i}`).textContent);
    check($(`picture${i}`).width === 64 && $(`caption${i}`).textContent.includes('16 of 16'), `side ${i}: caption`);
    const data = $(`picture${i}`).getContext('2d').getImageData(0, 0, 64, 64).data;
    check(new Set(data).size > 100, `side ${i}: the picture is empty`);
  }
  await sleep(200);
  check($('plot0').querySelectorAll('path').length > 6 && $('plot1').querySelectorAll('path').length > 4, 'plots');
  check([0, 1].every(i => $(`plot${i}`).querySelectorAll('.title').length === 2), 'titles of axes');
  check([...document.querySelectorAll('form label')].every(l => l.querySelector('small').textContent.length > 20), 'words');
  check([...$('select').options].every(o => ABOUT[o.value]), 'a method without words');
  check($('verdict').textContent.includes('times that of bdpt'), 'verdict');
  check($('verdict').textContent.includes('at 32 x 32 pixels') && $('small').textContent === '32 x 32', 'size of errors');
  check(document.querySelector('a[href="tour/README.md"]') !== null, 'a way to the tour');
  check(!/published/.test(Object.values(ABOUT).join()), 'nothing here is as published');
  const plainly = plain('asbdpt: --sample 9 is not taken: 0 to 3, see --spp; try asbdpt trace --help');
  check(plainly === '"sample" 9 is not taken: 0 to 3, see "samples per pixel"', 'plain words: ' + plainly);

  // The sliders reach the renderer: other numbers, other pictures; only those that the choice has can be moved.
  const before = sum(sides[1].last.pixels), error = sides[1].points[15][1];
  check(!$('connections').disabled && $('binpaths').disabled && $('restart').disabled, 'sliders of vertices');
  await rendered([['connections', 16]]);
  check(sum(sides[1].last.pixels) !== before, 'connections change nothing');
  check(sides[1].points[15][1] < error, 'more connections do not lower the error');
  await rendered([['spp', 3], ['connections', 0], ['select', 'bins'], ['binpaths', 4], ['restart', 4]]);
  check($('connections').disabled && !$('binpaths').disabled && !$('restart').disabled, 'sliders of bins');
  sides.forEach((side, i) => check(sum(side.last.pixels) === NATIVE[i], `side ${i}: other bytes than the program`));
  const bins = sum(sides[1].last.pixels);
  await rendered([['binpaths', 8]]);
  check(sum(sides[1].last.pixels) !== bins, 'binpaths change nothing');
  await rendered([['binpaths', 4], ['restart', 0]]);
  check(sum(sides[1].last.pixels) !== bins, 'restart changes nothing');

  // Pause: the pictures stand still, and no more come, until it ends; then they go on, and the pause is no time.
  await rendered([['spp', 2], ['select', 'vertices']]);
  turn('spp', 12);
  await sleep(300);
  await until(() => sides.every(s => s.points.length > 2 && !s.done), 'a long render');
  $('pause').click();
  const said = $('caption0').textContent;
  await sleep(2000); // a picture that was under way
  const then = sides.map(s => s.points.length);
  await sleep(3000);
  check(sides.every((s, i) => s.points.length === then[i]), 'a pause does not stop: ' + then);
  check($('caption0').textContent === said, 'a pause does not hold: ' + said);
  $('pause').click();
  await until(() => sides.every((s, i) => s.points.length > then[i] + 1), 'the render after a pause');
  check($('caption0').textContent !== said, 'after a pause nothing new');
  check(sides[0].points[then[0]][0] - sides[0].points[then[0] - 1][0] < 3, 'a pause is counted as time');

  // A link sets controls. The means that leave the plot are not drawn at its edge.
  location.hash = '#scene=rooms&select=bins&spp=5&scale=2';
  await sleep(400);
  await until(done, 'the scene of a link');
  check($('scene').value === 'rooms' && $('select').value === 'bins' && sides[1].points.length > 0, 'a link');
  sides[0].points[1][2] = 1e6;
  plot();
  const path = $('plot1').querySelector('path.side0').getAttribute('d');
  check(!/e|NaN/.test(path) && path.split('M').length > 2, 'a mean outside is drawn: ' + path.slice(0, 60));
  location.hash = '#scene=cornell-box&select=bins&spp=3&scale=2&binpaths=4&restart=0';
  await sleep(400);
  await until(done, 'the box again');

  // What a link cannot set is said, and nothing else changes.
  location.hash = '#scene=nowhere&select=bins&spp=99&colour=red';
  await sleep(400);
  const answer = $('error').textContent;
  check(/scene "nowhere".*It shows cornell-box\. There are: .*living-room/.test(answer) && /spp to "99"/.test(answer) &&
    /"colour"/.test(answer), 'a wrong link: ' + answer);
  check($('scene').value === 'cornell-box' && $('spp').value === '3', 'a wrong link changes ' + $('scene').value);
  await until(done, 'the scene of a wrong link');
  check(sides.every((side, i) => !isBlank(i)), 'no picture after a wrong link');

  // Keys do what the mouse does.
  const press = (key, shiftKey = false) =>
    $('picture1').dispatchEvent(new KeyboardEvent('keydown', { key, shiftKey, bubbles: true, cancelable: true }));
  $('picture1').focus();
  check(document.activeElement === $('picture1'), 'the picture is not focused');
  check(press('a') && !press('ArrowLeft') && /^Pixel 32, 32 of asbdpt bins/.test($('at').textContent), $('at').textContent);
  ['ArrowLeft', 'ArrowLeft', 'ArrowUp', 'ArrowDown', 'ArrowRight'].forEach(key => press(key));
  press('ArrowDown', true);
  check(/^Pixel 31, 42 /.test($('at').textContent) && !$('mark1').hidden && $('mark0').hidden, $('at').textContent);
  for (let k = 0; k < 9; k++)
    press('ArrowDown', true);
  check(/^Pixel 31, 63 /.test($('at').textContent), 'keys leave the picture: ' + $('at').textContent);
  press('Enter');
  await until(() => /pixel 31,63, sample \d+: asbdpt/.test($('story').textContent), 'the sample that Enter asked for');
  start(); // nothing is chosen
  await until(done, 'the same again');

  // On a telephone: one below the other.
  const phone = document.createElement('iframe');
  phone.style.cssText = 'position: absolute; width: 390px; height: 3000px';
  phone.srcdoc = `<meta name="viewport" content="width=device-width">${document.querySelector('style').outerHTML}` +
    document.querySelector('.sides').outerHTML + document.querySelector('.plots').outerHTML;
  document.body.append(phone);
  await new Promise(loaded => { phone.onload = loaded; });
  const boxes = [...phone.contentDocument.querySelectorAll('figure')].map(figure => figure.getBoundingClientRect());
  check(boxes.length === 5 && boxes.every((box, k) => box.width > 340 && (k === 0 || box.top >= boxes[k - 1].bottom)),
    'not below each other: ' + JSON.stringify(boxes));
  phone.remove();

  // A click shows a sample that brings light, and the button the next one.
  for (const [i, words] of [[0, /pixel 32,16, sample \d+: bdpt/], [1, /pixel 32,16, sample \d+: asbdpt/]]) {
    const box = $(`picture${i}`).getBoundingClientRect();
    $(`picture${i}`).dispatchEvent(new MouseEvent('click', { bubbles: true,
      clientX: box.left + 32.5 / 64 * box.width, clientY: box.top + 16.5 / 64 * box.height }));
    await until(() => words.test($('story').textContent), words);
    check($('story').textContent.endsWith('outside the picture\n'), 'the story is cut');
    check(/^An eye sub-path starts.* surface.*tried \d+ conn.* The strongest is/.test($('tale').textContent), 'the words: ' +
      $('tale').textContent);
    check(!document.querySelector('#inspector details').open, 'numbers before words');
    await until(() => $('drawing').naturalWidth > 1000, 'the drawing');
    check(!$(`mark${i}`).hidden && $(`mark${1 - i}`).hidden, 'the pixel is not marked');
  }
  check(/A bin of the pixel has two/.test($('choice').textContent), 'the choice is not told: ' +
    $('choice').textContent);
  const first = Number($('sample').value);
  check(!/receives 0 0 0/.test($('story').textContent), 'the first sample shown brings nothing');
  $('next').click();
  await until(() => Number($('sample').value) > first && /^The pixel rec/m.test($('story').textContent), 'the next');
  check(!/receives 0 0 0/.test($('story').textContent), 'the next sample brings nothing');
  $('sample').value = 5;
  $('sample').dispatchEvent(new Event('change'));
  await until(() => $('story').textContent.includes('sample 5'), 'another sample');

  // What cannot be rendered leaves no picture of something else, and the next render has no error.
  const box = FILES['scenes/shapes/box.inc'];
  delete FILES['scenes/shapes/box.inc'];
  await rendered([['scene', 'corridor']]);
  check(/box\.inc: cannot open/.test($('error').textContent), 'a missing file: ' + $('error').textContent);
  check(sides.every((side, i) => isBlank(i) && side.last === null), 'a picture stays under an error');
  check(!/samples per pixel/.test($('caption0').textContent), 'a caption stays: ' + $('caption0').textContent);
  FILES['scenes/shapes/box.inc'] = box;

  // Every scene, and every method. (The page would wait for further changes between two of them.)
  const methods = [...$('select').options].map(option => option.value);
  const all = SCENES.flatMap(scene => methods.map(method => [scene, method]));
  const some = methods.map((method, i) => [SCENES[i % SCENES.length], method]);
  turn('spp', 2);
  turn('scale', 1);
  await rendered([]);
  for (const [scene, method] of FULL ? all : some) {
    [$('scene').value, $('select').value] = [scene, method];
    start();
    const what = `${scene} by ${method}`;
    await until(done, what);
    check($('error').textContent === '', `${what}: ${$('error').textContent}`);
    check(sides.every((side, i) => side.last && side.last.iterations === spp() && !isBlank(i)), what + ': no picture');
  }
  check(document.documentElement.scrollWidth <= window.innerWidth + 1, 'the page is wider than the window');
  check(performance.getEntriesByType('resource').every(e => /^(data|blob):/.test(e.name)), 'the page loads something');
  check($('error').textContent === '', 'it says: ' + $('error').textContent);
})().catch(e => wrong.push(String(e))).then(() =>
  console.log('WEB ' + (wrong.length ? 'WRONG: ' + wrong.join('; ') : 'ALL RIGHT') + ' END'));

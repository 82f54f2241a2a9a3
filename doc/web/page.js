// page.js: the script of page.html: starts a worker (worker.js) for each image, shows what it sends, and asks one to
// tell of a sample.
'use strict';
const $ = id => document.getElementById(id);
const FILES = {}; // what is embedded, unpacked, by path
let SCENES = [];
async function unpack(script) {
  const packed = Uint8Array.from(atob(script.textContent.trim()), c => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  FILES[script.dataset.path] = new Uint8Array(await new Response(stream).arrayBuffer());
}
const WORKER = URL.createObjectURL(new Blob([$('worker').textContent], { type: 'text/javascript' }));

// What each side shows: its worker, the points of its curves, the last picture, and for each iteration which pixels it
// lit, a bit each.
const sides = [0, 1].map(() => ({ worker: null, points: [], last: null, done: false, lit: [], sums: null }));
let inspector = null;

// ---- what is asked for ----
const SELECTS = ['subspaces', 'vertices', 'pool', 'bins'];
const FAMILY = ['pt', 'lt', 'lvc', 'cbdpt', 'mbdpt', 'pcbdpt', 'ris', 'ris2', 'spcbpt', 'restir', 'restirgi', 'ppg', 'vcm', 'pathgraph', 'pssmlt', 'mmlt', 'mlt'];
const ABOUT = {
  subspaces: 'The default: single light vertices, chosen for the region of the eye vertex.',
  vertices: 'Single light vertices, by how much light they can send to the camera.',
  pool: 'One light sub-path of a shared pool, by an alias table.',
  bins: 'One of a few kept light sub-paths, as in the dissertation. It is biased.',
  pt: 'Path tracing: from the camera alone.', lt: 'Light tracing: from the lights alone.',
  lvc: 'Light vertices of a shared cache, all equally likely.',
  cbdpt: 'All connections with some light sub-paths of neighbouring pixels.',
  mbdpt: 'Pairs of sorted sub-paths, spread evenly.', pcbdpt: 'Light vertices by what was useful nearby.',
  ris: 'Light vertices resampled by what was useful nearby.', ris2: 'The same in two stages, by power first.',
  spcbpt: 'Regions of eye and light vertices, our reconstruction of a paper.', restir: 'Points on lights, shared by neighbouring pixels.',
  restirgi: 'Second points of paths, shared by neighbouring pixels.', ppg: 'Path tracing, guided by where light came from.',
  vcm: 'bdpt, which also merges vertices that are close. It is biased.',
  pathgraph: 'Path tracing whose points share their light. It is biased.',
  pssmlt: 'Mutates the random numbers of a sample.', mmlt: 'The same, for one strategy at a time.',
  mlt: 'Mutates whole paths.' };
const selected = () => SELECTS.includes($('select').value);
const integratorOf = side => side === 0 ? 'bdpt' : selected() ? 'asbdpt' : $('select').value;
const nameOf = side => integratorOf(side) + (side === 1 && selected() ? ` ${$('select').value}` : '');
const spp = () => 2 ** $('spp').value;

// The reference's size is in its header: "PF", width and height.
function referenceSize(scene) {
  const head = new TextDecoder('latin1').decode(FILES[`ref/${scene}.pfm`].slice(0, 40)).split(/\s+/);
  return { width: Number(head[1]), height: Number(head[2]) };
}

// All pictures have their shape before there is anything in them.
function showReference() {
  const { width, height } = referenceSize($('scene').value), file = FILES[`ref/${$('scene').value}.pfm`];
  const floats = new Float32Array(file.slice(file.length - 12 * width * height).buffer), canvas = $('reference');
  const image = new ImageData(width, height);
  const encode = x => 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * Math.min(1, x) ** (1 / 2.4) - 0.055);
  for (let y = 0; y < height; y++) // the file has the lowest row first
    for (let x = 0; x < width; x++) {
      for (let c = 0; c < 3; c++)
        image.data[4 * (y * width + x) + c] = encode(floats[3 * ((height - 1 - y) * width + x) + c]);
      image.data[4 * (y * width + x) + 3] = 255;
    }
  for (const each of document.querySelectorAll('canvas'))
    each.style.aspectRatio = `${width}/${height}`;
  canvas.width = width;
  canvas.height = height;
  canvas.getContext('2d').putImageData(image, 0, 0);
  showFine($('scene').value, canvas);
}

// The same with more pixels, in bytes: what is measured is measured against the floats.
async function showFine(scene, canvas) {
  const fine = await createImageBitmap(new Blob([FILES[`fine/${scene}.webp`]]));
  if ($('scene').value !== scene)
    return;
  canvas.width = fine.width;
  canvas.height = fine.height;
  canvas.getContext('2d').drawImage(fine, 0, 0);
  $('fine').textContent = `shown with ${fine.width} x ${fine.height} pixels`;
}

// What an error was measured on: the size of the reference.
const smallSize = () => Object.values(referenceSize($('scene').value)).join(' x ');

// The words of a command line after the subcommand: the same that a user of the program would type.
function options(side) {
  const scene = $('scene').value, size = referenceSize(scene), k = Number($('scale').value);
  const words = [`/scenes/${scene}.pbrt`, '--integrator', integratorOf(side), '--filter', 'box', '--res',
                 `${size.width * k}x${size.height * k}`, '--spp', String(spp())];
  if (side === 1 && selected())
    for (const name of ['select', ...Object.keys(USED).filter(id => USED[id].includes($('select').value))])
      if (name !== 'connections' || $(name).value !== '0')
        words.push('-P', `${name}=${$(name).value}`);
  return words;
}

// A worker that makes one call, with all files of scenes and the scene's reference. hear(message) gets what worker.js says.
function ask(call, words, hear) {
  const worker = new Worker(WORKER), reference = `ref/${$('scene').value}.pfm`;
  worker.onmessage = event => hear(event.data);
  worker.onerror = event => hear({ status: 1, out: '', err: event.message, files: {} });
  const files = Object.fromEntries(Object.entries(FILES).filter(([path]) => path.startsWith('scenes/') || path === reference));
  worker.postMessage({ wasm: FILES.wasm, files, call, words });
  return worker;
}

// ---- rendering ----
// A pause stops the workers, once the picture under way is complete. What comes until then is not shown: a picture that
// one looks at and clicks stands still.
let held = false;
function pause(on) {
  held = on;
  for (const side of sides)
    if (side.worker)
      side.worker.postMessage({ held });
  $('pause').textContent = held ? 'go on' : 'pause';
  if (!held)
    sides.forEach((side, i) => side.last && draw(i, side.last));
}

function start() {
  pause(false);
  $('error').textContent = $('at').textContent = '';
  $('small').textContent = smallSize();
  showReference();
  sides.forEach((side, i) => {
    if (side.worker)
      side.worker.terminate();
    Object.assign(side, { points: [], last: null, done: false, lit: [], sums: null });
    $(`caption${i}`).innerHTML = `<b>${nameOf(i)}</b> ...<br>&nbsp;`;
    $(`mark${i}`).hidden = true;
    $(`picture${i}`).setAttribute('aria-label', `image by ${nameOf(i)}: arrow keys choose a pixel, Enter shows its paths`);
    const words = [`/ref/${$('scene').value}.pfm`, 'render', ...options(i)];
    side.worker = ask('web_begin', words, message => hear(i, message));
  });
  plot();
}

function hear(i, message) {
  const side = sides[i];
  if (message.status !== undefined) {
    side.done = true;
    if (message.status !== 0)
      giveUp(i, message.err);
    return;
  }
  if (message.learnt !== undefined) {
    $(`caption${i}`).innerHTML = `<b>${nameOf(i)}</b>, learning where light is wanted, ${Math.round(100 * message.learnt)} %<br>&nbsp;`;
    return;
  }
  if (message.iterations > 0) {
    side.last = message;
    note(side, message);
    side.points.push([message.seconds, message.rmse8, 100 * (message.ratio - 1)]);
  }
  if (!held)
    draw(i, message);
}

// What the program says, with what this page has for its options and commands.
const CONTROLS = { res: 'picture', spp: 'samples per pixel', integrator: 'method', sample: 'sample', pixel: 'pixel' };
const plain = text => text.replace(/^asbdpt(-lab)?: /gm, '').replace(/; (try|see) \S*asbdpt[^;]*--help/g, '')
  .replace(/--([a-z]+)/g, (option, name) => CONTROLS[name] ? `"${CONTROLS[name]}"` : option);

// An error takes the place of the picture.
function giveUp(i, text) {
  $('error').textContent = plain(text);
  $(`picture${i}`).width = $(`picture${i}`).width; // clears it
  $(`caption${i}`).innerHTML = `<b>${nameOf(i)}</b>: not rendered, see above<br>&nbsp;`;
  sides[i].last = null;
}

function draw(i, message) {
  const canvas = $(`picture${i}`), caption = $(`caption${i}`);
  canvas.width = message.width;
  canvas.height = message.height;
  canvas.getContext('2d').putImageData(
    new ImageData(new Uint8ClampedArray(message.picture.buffer), message.width, message.height), 0, 0);
  caption.innerHTML = message.iterations === 0 ? `<b>${nameOf(i)}</b>, the first sample<br>&nbsp;`
    : `<b>${nameOf(i)}</b>, ${message.iterations} of ${spp()} samples per pixel, ` +
    `${message.seconds.toFixed(2)} s<br>error <b>${message.rmse8.toFixed(2)}</b> at ${smallSize()}, mean ` +
    `${(100 * (message.ratio - 1)).toFixed(2)} %`;
  requestPlot();
}

// Which pixels have more light now than before the last iterations? (A share of 2e-6 is what floats can hide.)
function note(side, { pixels, iterations }) {
  const n = pixels.length / 12, floats = new Float32Array(pixels.buffer, 0, 3 * n), bits = new Uint8Array(n / 8 + 1);
  side.sums = side.sums || new Float64Array(n);
  for (let i = 0; i < n; i++) {
    const sum = (floats[3 * i] + floats[3 * i + 1] + floats[3 * i + 2]) * iterations;
    if (sum - side.sums[i] > 2e-6 * sum)
      bits[i >> 3] |= 1 << (i & 7);
    side.sums[i] = sum;
  }
  while (side.lit.length < iterations)
    side.lit.push(bits);
}

// The first iteration from `k` on that lit the pixel; -1: none so far.
function nextLit(side, k, x, y) {
  const i = y * side.last.width + x;
  return side.lit.findIndex((bits, at) => at >= k && bits[i >> 3] >> (i & 7) & 1);
}

// ---- plots ----
let plotWanted = false;
function requestPlot() {
  if (!plotWanted)
    requestAnimationFrame(() => { plotWanted = false; plot(); });
  plotWanted = true;
}

const LEFT = 62, RIGHT = 530, TOP = 10, BOTTOM = 270;
const ticks = (low, high) => { // 1, 2, 5 times powers of ten
  const out = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high) + 1; e++)
    for (const m of [1, 2, 5])
      if (m * 10 ** e >= low * 0.999 && m * 10 ** e <= high * 1.001)
        out.push(Number((m * 10 ** e).toPrecision(1)));
  return out;
};

// Both at the time that both have reached.
function verdict() {
  const time = Math.min(...sides.map(s => s.points.length > 0 ? s.points[s.points.length - 1][0] : 0));
  const then = sides.map(s => s.points.filter(p => p[0] <= time).pop());
  if (!then[0] || !then[1])
    return '';
  const ratio = (then[1][1] / then[0][1]) ** 2;
  return `After ${time.toFixed(1)} s of each: error ${then[0][1].toFixed(2)} and ${then[1][1].toFixed(2)} ` +
    `at ${smallSize()} pixels; the squared error of ${nameOf(1)} is ${ratio.toFixed(2)} times that of bdpt.`;
}

function plot() {
  $('verdict').textContent = verdict();
  const all = sides.flatMap(s => s.points);
  if (all.length === 0) {
    $('plot0').innerHTML = $('plot1').innerHTML = '';
    return;
  }
  const seconds = all.map(p => p[0]), errors = all.map(p => p[1]);
  const low = Math.max(0.01, Math.min(...seconds)), high = Math.max(...seconds, low * 2);
  const x = t => LEFT + (RIGHT - LEFT) * Math.log(Math.max(t, low) / low) / Math.log(high / low);
  const least = Math.min(...errors) / 1.15, most = Math.max(...errors) * 1.15;
  const y = e => BOTTOM - (BOTTOM - TOP) * Math.log(e / least) / Math.log(most / least);
  const bound = Math.max(1, Math.min(10, 1.2 * Math.max(...all.slice(-20).map(p => Math.abs(p[2])))));
  const ySigned = v => (TOP + BOTTOM) / 2 - (BOTTOM - TOP) / 2 * v / bound;
  const line = (points, place, i, shown = () => true) => points.length === 0 ? '' : // what is not shown breaks the line
    `<path d="${points.map((p, k) => !shown(p) ? '' : (k > 0 && shown(points[k - 1]) ? 'L' : 'M') +
      place(p).map(v => v.toFixed(1)).join(' ')).join('')}" class="side${i}" fill="none" stroke-width="2"/>`;
  const vertical = ticks(low, high).map(t => `<path class="grid" d="M${x(t)} ${TOP}V${BOTTOM}"/>` +
    `<text x="${x(t)}" y="${BOTTOM + 18}" text-anchor="middle">${t}</text>`).join('') +
    `<text class="title" x="${(LEFT + RIGHT) / 2}" y="${BOTTOM + 34}" text-anchor="middle">rendering time, seconds</text>`;
  const title = words => `<text class="title" transform="rotate(-90)" x="${-(TOP + BOTTOM) / 2}" y="14" ` +
    `text-anchor="middle">${words}</text>`;
  const row = (at, label) => `<path class="grid" d="M${LEFT} ${at}H${RIGHT}"/>` +
    `<text x="${LEFT - 6}" y="${at + 4}" text-anchor="end">${label}</text>`;
  const fall = p => `<path d="M${x(p[0])} ${y(p[1])}L${x(high)} ${y(p[1] * Math.sqrt(p[0] / high))}" stroke="#999" ` +
    'stroke-dasharray="2 4"/>';
  $('plot0').innerHTML = vertical + title('error, of 255 levels') + ticks(least, most).map(e => row(y(e), e)).join('') +
    `<svg x="0" y="0" width="${RIGHT}" height="${BOTTOM}">` +
    sides.map(s => s.points[0] ? fall(s.points[0]) : '').join('') + '</svg>' +
    sides.map((s, i) => line(s.points, p => [x(p[0]), y(p[1])], i)).join('');
  $('plot1').innerHTML = vertical + title('mean, % from the reference') + [-bound, -bound / 2, 0, bound / 2, bound]
    .map(v => row(ySigned(v), v.toFixed(1))).join('') +
    sides.map((s, i) => line(s.points, p => [x(p[0]), ySigned(p[2])], i, p => Math.abs(p[2]) <= bound)).join('');
}

// ---- one sample ----
const chosen = { side: 0, x: 0, y: 0 };

// Tells of the sample whose number is shown. While `tries` are left, one that brought nothing by its own connections (a
// light sub-path of another pixel may have lit this one) makes place for the next that the picture says brought light.
function inspect(tries = 0) {
  $('inspector').hidden = false;
  $('pixel').textContent = `${chosen.x}, ${chosen.y}, ${integratorOf(chosen.side)}`;
  $('story').textContent = $('choice').textContent = $('tale').textContent = 'tracing ...';
  $('drawing').hidden = true;
  if (inspector)
    inspector.terminate();
  const words = ['asbdpt', 'trace', ...options(chosen.side), '--pixel', `${chosen.x},${chosen.y}`, '--sample',
                 $('sample').value, '--svg', '/paths.svg', '--all'];
  inspector = ask('web_command', words, message => {
    const received = /^The pixel receives (\S+) (\S+) (\S+)\. /m.exec(message.out + ' ');
    if (message.status === 0 && tries > 0 && received && received.slice(1).every(v => Number(v) === 0)) {
      const k = nextLit(sides[chosen.side], Number($('sample').value) + 1, chosen.x, chosen.y);
      if (k >= 0) {
        $('sample').value = k;
        inspect(tries - 1);
        return;
      }
    }
    const failed = plain(message.err);
    $('story').textContent = message.status === 0 ? message.out : failed;
    $('choice').textContent = message.status === 0 ? message.out.split('\n\n')[0].replace(/^.*\n/, '') : failed;
    $('tale').textContent = message.status === 0 ? tale(message.out) : failed;
    const drawn = message.files['paths.svg'];
    $('drawing').hidden = !drawn;
    $('drawing').src = drawn ? 'data:image/svg+xml,' + encodeURIComponent(new TextDecoder().decode(drawn)) : '';
    inspector = null;
  });
}

// What the trace says, in words for who sees one for the first time; '' if it says something else.
function tale(out) {
  const walk = name => (new RegExp(`^The ${name} sub-path: +(.*): \\d+ vert`, 'm').exec(out) || [])[1];
  const met = things => things.length > 0 ? `meets ${things.length} surface${things.length > 1 ? 's' : ''}: ${things.join(', ')}` :
    'meets nothing';
  const eye = walk('eye'), light = walk('light'), tried = /: (\d+) tried, (\d+) brought light/.exec(out);
  const most = /^ +\(\d+,\d+\) (\S.*?) +([\d.]+) % of the sum/m.exec(out);
  if (!eye)
    return '';
  const text = [`An eye sub-path starts at the camera. It ${met(eye.split(', ').slice(1))}.`];
  if (light)
    text.push(`A light sub-path starts at a light (${light.split(', ')[0]}). It ${met(light.split(', ').slice(1))}.`);
  if (tried)
    text.push(`The method tried ${tried[1]} connections. ${tried[2]} of them brought light to the pixel.`);
  if (most)
    text.push(`The strongest is ${most[1]}, with ${Math.round(most[2])} % of the light. Here z counts the points of the eye ` +
              'sub-path from the camera, and y those of the light sub-path from the light.');
  return text.join(' ');
}

// A frame about the chosen pixel, in the picture that it was chosen in.
function mark() {
  const canvas = $(`picture${chosen.side}`), box = $(`mark${chosen.side}`);
  sides.forEach((side, i) => { $(`mark${i}`).hidden = i !== chosen.side; });
  Object.assign(box.style, { left: `${100 * chosen.x / canvas.width}%`, top: `${100 * chosen.y / canvas.height}%`,
                             width: `${100 / canvas.width}%`, height: `${100 / canvas.height}%` });
}

// Choose a pixel of side i, as near as there is one.
function choose(i, x, y) {
  const canvas = $(`picture${i}`), within = (v, n) => Math.max(0, Math.min(n - 1, Math.floor(v)));
  Object.assign(chosen, { side: i, x: within(x, canvas.width), y: within(y, canvas.height) });
  $('at').textContent = `Pixel ${chosen.x}, ${chosen.y} of ${nameOf(i)}. Enter or a click shows its paths.`;
  mark();
}

function trace() {
  $('sample').value = Math.max(0, nextLit(sides[chosen.side], 0, chosen.x, chosen.y));
  inspect(8);
  $('inspector').scrollIntoView({ behavior: 'smooth' });
}

const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
sides.forEach((side, i) => {
  const canvas = $(`picture${i}`);
  canvas.addEventListener('click', event => {
    const box = canvas.getBoundingClientRect();
    if (!side.last)
      return;
    choose(i, (event.clientX - box.left) / box.width * canvas.width, (event.clientY - box.top) / box.height * canvas.height);
    trace();
  });
  // The first key chooses the pixel in the middle, if none of this image is chosen.
  canvas.addEventListener('keydown', event => {
    const step = STEPS[event.key], fresh = $(`mark${i}`).hidden;
    if (!side.last || event.ctrlKey || event.altKey || event.metaKey || (!step && event.key !== 'Enter'))
      return;
    event.preventDefault();
    if (fresh)
      choose(i, canvas.width / 2, canvas.height / 2);
    else if (step)
      choose(i, ...step.map((d, k) => [chosen.x, chosen.y][k] + d * (event.shiftKey ? 10 : 1)));
    if (!step)
      trace();
  });
});
$('sample').addEventListener('change', () => inspect());
$('next').addEventListener('click', () => {
  const k = nextLit(sides[chosen.side], Number($('sample').value) + 1, chosen.x, chosen.y);
  if (k >= 0) {
    $('sample').value = k;
    inspect(8);
  } else {
    $('tale').textContent = 'No later sample has brought light to this pixel so far.';
  }
});

// ---- controls ----
const USED = { connections: ['subspaces', 'vertices'], binpaths: ['bins'], restart: ['bins'] };

function label() {
  const size = referenceSize($('scene').value), k = Number($('scale').value);
  const say = { connections: v => v === '0' ? 'as usual' : v, binpaths: v => `${v} per pixel`,
                restart: v => v === '0' ? 'never: one picture' : `after ${v} samples`, spp: () => spp(),
                scale: () => `${size.width * k} x ${size.height * k}` };
  for (const [id, words] of Object.entries(say))
    $(id).parentElement.querySelector('output').textContent = words($(id).value);
  $('about').textContent = ABOUT[$('select').value];
  for (const [id, selects] of Object.entries(USED))
    $(id).disabled = !selects.includes($('select').value);
}

let later;
for (const id of ['scene', 'select', 'connections', 'binpaths', 'restart', 'spp', 'scale'])
  $(id).addEventListener('input', () => {
    label();
    clearTimeout(later);
    later = setTimeout(start, 250);
  });
$('start').addEventListener('click', start);
$('pause').addEventListener('click', () => pause(!held));
$('select').lastElementChild.innerHTML = FAMILY.map(name => `<option title="${ABOUT[name]}">${name}`).join('');
Promise.all([...document.querySelectorAll('script[data-path]')].map(unpack)).then(() => {
  SCENES = Object.keys(FILES).filter(path => /^scenes\/[^/]+\.pbrt$/.test(path)).map(path => path.slice(7, -5)).sort();
  $('scene').innerHTML = SCENES.map(name => `<option>${name}`).join('');
  $('scene').value = 'bathroom'; // the difference is seen at once, even where a machine is slow
  follow();
  window.addEventListener('hashchange', follow);
});

// A control as a link has it; what it cannot be stays as it was, and is said.
function set(id, value) {
  if (!['scene', 'select', 'connections', 'binpaths', 'restart', 'spp', 'scale'].includes(id))
    return `The link sets "${id}", which this page does not have.`;
  const control = $(id), before = control.value, what = { scene: 'scene', select: 'method' }[id];
  control.value = value;
  if (control.value === value)
    return '';
  control.value = before;
  return what ? `The link asks for the ${what} "${value}", which this page does not have. It shows ${before}. There are: ` +
    `${[...control.options].map(option => option.value).join(', ')}.` :
    `The link sets ${id} to "${value}", which is no step from ${control.min} to ${control.max}. It stays ${before}.`;
}

// asbdpt.html#scene=rooms&select=bins: controls that a link has set, by their names.
function follow() {
  const refused = [...new URLSearchParams(location.hash.slice(1))].map(([id, value]) => set(id, value)).filter(text => text);
  label();
  start();
  $('error').textContent = refused.join('\n');
}

/* page.c: see page.h. The style and the script come first. Axes and colours are like those of doc/web/page.html; the
 * reports of the course (test/course/judge.sh) have the same style. */
#include "lab/page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/version.h"
#include "lab/files.h"
#include "lab/text.h"

/* --- style and script --------------------------------------------------------------------------------- */

/* Lines; the last is NULL. */
static const char *const PAGE_STYLE[] = {
    ":root { color-scheme: light dark; --paper: #fff; --ink: #222; --soft: #666; --line: #ddd; --c0: #1d5fbf;",
    "  --c1: #c05a00; --c2: #00795a; --c3: #b0307f; --c4: #6a5acd; --c5: #8a6d00; --c6: #007d99; --c7: #a33; }",
    "@media (prefers-color-scheme: dark) { :root { --paper: #16181b; --ink: #e6e6e6; --soft: #a8a8a8;",
    "  --line: #3a3d42; --c0: #7db2ff; --c1: #ffab5c; --c2: #4fd6a8; --c3: #ff8fd0; --c4: #b7abff; --c5: #e3c64a;",
    "  --c6: #5fd3ee; --c7: #ff9a94; } }",
    "body { margin: 0 auto; max-width: 1240px; padding: 0 16px 3em; font: 15px/1.45 system-ui, sans-serif;",
    "  color: var(--ink); background: var(--paper); }",
    "h1 { font-size: 1.4em; margin: .8em 0 .2em; }",
    "h2 { font-size: 1.25em; margin: 2em 0 .4em; border-top: 1px solid var(--line); padding-top: .8em; }",
    "p, ul { max-width: 75em; margin: .4em 0 .8em; overflow-wrap: anywhere; }",
    "a { color: var(--c0); }",
    ".soft, figcaption { color: var(--soft); font-size: .9em; }",
    ".wide { overflow-x: auto; margin-bottom: 1em; font-size: .92em; }",
    "pre { white-space: pre-wrap; overflow-wrap: anywhere; font-size: .92em; }",
    "table { border-collapse: collapse; font-variant-numeric: tabular-nums; }",
    "td, th { padding: .2em .8em .2em 0; border-bottom: 1px solid var(--line); text-align: right; }",
    "td, th { white-space: nowrap; }",
    "th { color: var(--soft); font-weight: normal; }",
    "td:first-child, th:first-child { text-align: left; }",
    ".two { display: grid; grid-template-columns: 1fr 1fr; gap: 20px; margin: .8em 0; }",
    ".three { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 20px; margin: .8em 0; }",
    "@media (max-width: 700px) { .two, .three { grid-template-columns: minmax(0, 1fr); } }",
    "figure { margin: 0; min-width: 0; }",
    "svg { display: block; width: 100%; }",
    "svg text { font: 12px system-ui, sans-serif; fill: var(--ink); }",
    "svg .title { font-weight: 600; }",
    "svg .soft { fill: var(--soft); }",
    "svg .mid { text-anchor: middle; }",
    "svg .end { text-anchor: end; }",
    "svg .grid { stroke: var(--line); }",
    "canvas, img { display: block; width: 100%; background: #111; image-rendering: pixelated; }",
    ".bar { height: 12px; margin-top: 6px; }",
    ".ends { display: flex; justify-content: space-between; }",
    ".row { display: flex; flex-wrap: wrap; gap: .3em 1em; align-items: center; }",
    ".row input { width: 190px; vertical-align: middle; }",
    "select { max-width: 100%; }",
    "summary { cursor: pointer; margin: .8em 0; }",
    NULL};

/* Lines; the last is NULL. */
static const char *const PAGE_SCRIPT[] = {
    "'use strict';",
    "const DATA = JSON.parse(document.getElementById('data').textContent);",
    "const MEASURES = ['RMSE of 8-bit values (0 to 255)', 'relative RMSE of linear values',",
    "                  'relative RMSE of means of 8x8 pixels'];",
    "const VIRIDIS = [[68, 1, 84], [72, 40, 120], [62, 73, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137],",
    "                 [53, 183, 121], [110, 206, 88], [181, 222, 43], [253, 231, 37]];",
    "const add = (parent, tag, html = '', name = '') => {",
    "  const e = document.createElement(tag);",
    "  e.innerHTML = html;",
    "  e.className = name;",
    "  return parent.appendChild(e);",
    "};",
    "const safe = text => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/'/g, '&#39;');",
    "",
    "// ---- tables: of the page of Markdown that lies next to this one ----",
    "const words = text => safe(text).replace(/`([^`]*)`/g, '<code>$1</code>')",
    "  .replace(/\\*\\*([^*]*)\\*\\*/g, '<b>$1</b>')",
    "  .replace(/\\[([^\\]]*)\\]\\(([\\w./-]+)\\)/g, `<a href='$2'>$1</a>`);",
    "const cells = (row, tag) => '<tr>' + row.replace(/^\\||\\|$/g, '').split(/(?<!\\\\)\\|/).map(cell =>",
    "  `<${tag}>${words(cell.trim().replace(/\\\\([|\\\\])/g, '$1'))}</${tag}>`).join('') + '</tr>';",
    "const block = text => {",
    "  const [first, , ...rows] = text.split('\\n');",
    "  if (text[0] === '|')",
    "    return `<div class='wide'><table>${cells(first, 'th') + rows.map(r => cells(r, 'td')).join('')}` +",
    "      '</table></div>';",
    "  if (/^- /.test(text))",
    "    return `<ul>${text.slice(2).split('\\n- ').map(item => `<li>${words(item)}</li>`).join('')}</ul>`;",
    "  return /^## /.test(text) ? `<h3>${words(text.slice(3))}</h3>` : `<p>${words(text)}</p>`;",
    "};",
    "const html = blocks => blocks.filter(b => !/^(# |    )/.test(b)).map(block).join(''); // those are above",
    "const fold = (parent, title, blocks) =>",
    "  blocks.length && add(parent, 'details', `<summary>${title}</summary>${html(blocks)}`);",
    "// A part is what is below a heading: the first table and what is before it are shown, the rest is folded.",
    "const parts = DATA.text.split(/^(?=## )/m).filter(text => text.trim()).map(text => {",
    "  const blocks = text.trim().split(/\\n\\n+/), last = blocks.findIndex(b => b[0] === '|') + 1;",
    "  const title = (/^## (.*)/.exec(text) || ['', ''])[1];",
    "  return { title, lead: blocks.slice(0, last), rest: blocks.slice(last) };",
    "});",
    "",
    "// ---- curves ----",
    "const DASHES = ['', '7 3', '2 3', '9 3 2 3', '12 4', '4 2', '1 2', '6 2 1 2 1 2'];",
    "const MARKERS = ['M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0Z', 'M-4-4H4V4H-4Z', 'M0-5L5 4H-5Z',",
    "                 'M0-5L5 0L0 5L-5 0Z', 'M-4-4L4 4M4-4L-4 4', 'M0 5L5-4H-5Z', 'M0-5V5M-5 0H5', 'M-5 0H5'];",
    "const ticks = (low, high) => { // powers of ten, and between them what there is room for",
    "  const out = [], wide = Math.log10(high / low);",
    "  for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high); e++)",
    "    for (const m of wide > 3 ? [1] : wide > 1.6 ? [1, 3] : [1, 2, 5])",
    "      if (m * 10 ** e >= low * 0.999 && m * 10 ** e <= high * 1.001)",
    "        out.push(Number((m * 10 ** e).toPrecision(1)));",
    "  return out;",
    "};",
    "// A name in lines of so many letters, cut before a colon or blank.",
    "const inLines = (name, most) => name.split(/(?=[: ])/).reduce((out, part) => {",
    "  const last = out.length - 1;",
    "  if (last >= 0 && (out[last] + part).length <= most)",
    "    out[last] += part;",
    "  else",
    "    out.push(part);",
    "  return out;",
    "}, []);",
    "// lines: { name, points: [[x, y]], style }, style -1: grey, without a name. Names are at the ends, moved apart.",
    "function curves(svg, title, across, up, lines) {",
    "  const W = Math.max(320, svg.clientWidth), room = 0.36 * W, L = 52, T = 30, STEP = 14;",
    "  const end = l => l.points[l.points.length - 1], all = lines.flatMap(l => l.points);",
    "  const colour = l => `var(--${l.style < 0 ? 'line' : 'c' + l.style % 8})`;",
    "  const named = lines.filter(l => l.style >= 0 && l.points.length > 0).sort((a, b) => end(b)[1] - end(a)[1]);",
    "  const words = named.map(l => inLines(l.name, (room - 16) / 6.6)), rows = words.flat();",
    "  const R = W - Math.min(room, 16 + 6.6 * Math.max(...rows.map(row => row.length), 4));",
    "  const B = Math.max(298, T + STEP * rows.length), H = B + 42;",
    "  svg.setAttribute('viewBox', `0 0 ${W} ${H}`);",
    "  svg.setAttribute('aria-label', `${title}: ${up} over ${across}, both logarithmic`);",
    "  svg.innerHTML = `<text x='9' y='60'>No error is known: the reference is too noisy, or the time short.</text>`;",
    "  if (all.length === 0)",
    "    return;",
    "  const range = k => [Math.min(...all.map(p => p[k])) / 1.15, Math.max(...all.map(p => p[k])) * 1.15];",
    "  const [[x0, x1], [y0, y1]] = [range(0), range(1)];",
    "  const x = v => Math.round(10 * (L + (R - L) * Math.log(v / x0) / Math.log(x1 / x0))) / 10;",
    "  const y = v => Math.round(10 * (B - (B - T) * Math.log(v / y0) / Math.log(y1 / y0))) / 10;",
    "  const text = (at, name, words) => `<text ${at} class='${name}'>${words}</text>`;",
    "  let out = text(`x='${L}' y='16'`, 'title', safe(title)) +",
    "    text(`x='${(L + R) / 2}' y='${H - 6}'`, 'soft mid', across) +",
    "    text(`transform='translate(12 ${(T + B) / 2}) rotate(-90)'`, 'soft mid', up);",
    "  for (const v of ticks(x0, x1))",
    "    out += `<path class='grid' d='M${x(v)} ${T}V${B}'/>` + text(`x='${x(v)}' y='${B + 17}'`, 'mid', v);",
    "  for (const v of ticks(y0, y1))",
    "    out += `<path class='grid' d='M${L} ${y(v)}H${R}'/>` + text(`x='${L - 6}' y='${y(v) + 4}'`, 'end', v);",
    "  for (const l of [...lines].sort((a, b) => a.style - b.style)) {",
    "    const path = l.points.map(p => `${x(p[0])} ${y(p[1])}`).join('L'), i = Math.max(l.style, 0) % 8;",
    "    out += `<path d='M${path}' fill='none' stroke='${colour(l)}' stroke-width='${l.style < 0 ? 1 : 2}' ` +",
    "      `stroke-dasharray='${DASHES[i]}'><title>${safe(l.name)}</title></path>`;",
    "    for (const p of l.style < 0 ? [] : l.points)",
    "      out += `<path transform='translate(${x(p[0])} ${y(p[1])})' d='${MARKERS[i]}' stroke='${colour(l)}' ` +",
    "        `fill='${l.hollow ? 'var(--paper)' : colour(l)}'><title>${safe(l.name)}: ${p[1]} after ${p[0]}</title>` +",
    "        '</path>';",
    "  }",
    "  let least = T, below = STEP * rows.length;",
    "  named.forEach((l, i) => {",
    "    const place = Math.max(least, Math.min(y(end(l)[1]), B - below));",
    "    least = place + STEP * words[i].length;",
    "    below -= STEP * words[i].length;",
    "    out += `<path d='M${x(end(l)[0]) + 6} ${y(end(l)[1])}L${R + 6} ${place}' stroke='${colour(l)}' ` +",
    "      `opacity='.5'/>` + words[i].map((row, k) => `<text x='${R + 9}' y='${place + 4 + STEP * k}' ` +",
    "      `style='fill:${colour(l)}'>${safe(row)}</text>`).join('');",
    "  });",
    "  svg.innerHTML = out;",
    "}",
    "",
    "// ---- pictures: large, one at a time, and where it errs ----",
    "const pixels = async png => {",
    "  const image = new Image(), canvas = document.createElement('canvas'), context = canvas.getContext('2d');",
    "  image.src = 'data:image/png;base64,' + png;",
    "  await image.decode();",
    "  Object.assign(canvas, { width: image.width, height: image.height });",
    "  context.drawImage(image, 0, 0);",
    "  return context.getImageData(0, 0, image.width, image.height);",
    "};",
    "const viridis = t => {",
    "  const at = 9 * Math.min(Math.max(t, 0), 1), i = Math.min(Math.floor(at), 8);",
    "  return VIRIDIS[i].map((v, c) => v + (at - i) * (VIRIDIS[i + 1][c] - v));",
    "};",
    "// Of each pixel the root mean square of its three errors, in 8-bit values.",
    "const errors = (a, b) => Float32Array.from({ length: a.width * a.height }, (_, i) =>",
    "  Math.hypot(...[0, 1, 2].map(c => a.data[4 * i + c] - b.data[4 * i + c])) / Math.sqrt(3));",
    "async function show(place, scene, methods) {",
    "  const pictures = await Promise.all([...methods, scene.reference].map(m => pixels(m.png)));",
    "  const reference = pictures[methods.length], heat = pictures.map(p => errors(p, reference));",
    "  const sorted = heat.slice(0, -1).flatMap(h => [...h]).sort((a, b) => a - b);",
    "  const most = Math.max(1, sorted[Math.ceil(0.99 * sorted.length) - 1]);",
    "  const row = add(place, 'div', `<label>image <input type='range' min='0' max='${methods.length}' value='0'>` +",
    "    `</label><b></b><span class='soft'>slider, or its arrow keys; hold R for the reference</span>`, 'row');",
    "  const two = add(place, 'div', '<figure><canvas></canvas><figcaption></figcaption></figure>' +",
    "    `<figure><canvas></canvas><div class='bar'></div><div class='ends'><span>0</span>` +",
    "    `<span>${(most / 2).toPrecision(3)}</span><span>${most.toPrecision(3)} and more</span></div>` +",
    "    '<figcaption>error of each pixel: root mean square over its channels, in 8-bit values (0 to 255)' +",
    "    '</figcaption></figure>', 'two');",
    "  const [left, right] = two.querySelectorAll('canvas'), slider = row.querySelector('input');",
    "  two.querySelector('.bar').style.background = `linear-gradient(90deg, ${VIRIDIS.map(c => `rgb(${c})`)})`;",
    "  const draw = i => {",
    "    const m = methods[i], p = m && m.points[m.points.length - 1];",
    "    const map = new ImageData(reference.width, reference.height);",
    "    heat[i].forEach((e, k) => map.data.set([...viridis(e / most), 255], 4 * k));",
    "    for (const [canvas, image] of [[left, pictures[i]], [right, map]]) {",
    "      Object.assign(canvas, { width: image.width, height: image.height });",
    "      canvas.getContext('2d').putImageData(image, 0, 0);",
    "    }",
    "    row.querySelector('b').textContent = m ? m.name : 'reference';",
    "    two.querySelector('figcaption').textContent = m ? `${scene.name}, ${m.name}: ${p[0]} samples per pixel, ` +",
    "      `${p[1].toPrecision(3)} s of CPU ${m.mark && `(${m.mark})`}` :",
    "      `${scene.name}, reference, ${scene.reference.origin}`;",
    "  };",
    "  slider.addEventListener('input', () => draw(Number(slider.value)));",
    "  for (const [event, at] of [['keydown', () => methods.length], ['keyup', () => Number(slider.value)]])",
    "    document.addEventListener(event, e => e.key === 'r' && !e.ctrlKey && !e.metaKey && draw(at()));",
    "  draw(0);",
    "}",
    "",
    "// ---- the page ----",
    "const body = document.getElementById('page'), plots = [], later = [];",
    "const measure = () => Number(document.getElementById('measure').value);",
    "// Coordinate k and the error of points that are known. The first method and the seven with the least error have",
    "// styles.",
    "function linesOf(methods, k) {",
    "  const points = m => m.points.map(p => [p[k], p[2 + measure()]]).filter(p => p[0] > 0 && p[1] > 0);",
    "  const error = m => Math.min(...points(m).slice(-1).map(p => p[1]));",
    "  const best = [methods[0], ...methods.slice(1).sort((a, b) => error(a) - error(b)).slice(0, 7)];",
    "  const styled = methods.filter(m => best.includes(m));",
    "  return methods.map(m => ({ name: m.name, points: points(m), style: styled.indexOf(m), printed: m.printed }));",
    "}",
    "function plot(place, title, methods, sweep = false) {",
    "  const two = add(place, 'div', `<figure><svg role='img'></svg></figure>`.repeat(2), 'two');",
    "  plots.push(() => {",
    "    const [time, samples] = two.querySelectorAll('svg'), over = linesOf(methods, 0);",
    "    const printed = over.filter(l => measure() === 0 && !sweep && l.printed.length > 0)",
    "      .map(l => ({ name: `${l.name}, printed`, points: l.printed, style: l.style, hollow: true }));",
    "    curves(time, `${title}: error over time`, 'CPU seconds', MEASURES[measure()], linesOf(methods, 1));",
    "    over.push(...printed);",
    "    curves(samples, `${title}: error over samples`, 'samples per pixel', MEASURES[measure()], over);",
    "  });",
    "}",
    "add(body, 'h1', safe(DATA.title));",
    "add(body, 'p', safe(DATA.about), 'soft');",
    "add(body, 'pre', safe(DATA.command));",
    "for (const part of parts.filter(p => !DATA.scenes.some(s => s.name === p.title))) {",
    "  add(body, 'div', html(part.lead));",
    "  later.push(...part.rest);",
    "}",
    "const choices = MEASURES.map((m, i) => `<option value='${i}'>${m}`).join('');",
    "add(body, 'p', `<label>curves show the <select id='measure'>${choices}</select></label><br><span class='soft'>` +",
    "  'Both axes are logarithmic. Points are the same render after fewer samples; the noise of the reference is ' +",
    "  'subtracted if it is known. Noise falls as one over the root of time. Of more than eight methods ' +",
    "  'those with the most error are grey.</span>');",
    "for (const scene of DATA.scenes) {",
    "  const place = add(body, 'section', `<h2>${safe(scene.name)}, ${scene.width} x ${scene.height} pixels</h2>`);",
    "  const own = parts.find(p => p.title === scene.name) || { lead: [], rest: [] };",
    "  const compared = scene.methods.filter(m => m.png), family = m => m.text.replace(/=[^=]*$/, '');",
    "  add(place, 'div', html(own.lead.slice(1)));",
    "  plot(place, scene.name, compared);",
    "  const pictures = add(place, 'div');",
    "  new IntersectionObserver((seen, watch) => seen.some(s => s.isIntersecting) &&",
    "    (watch.disconnect(), show(pictures, scene, compared)), { rootMargin: '500px' }).observe(pictures);",
    "  for (const sweep of new Set(scene.methods.filter(m => !m.png).map(family)))",
    "    plot(place, `${scene.name}, sweep of ${sweep.replace(/.*:/, '')}`, scene.methods.filter(m =>",
    "      m.text === sweep.replace(/:[^:]*$/, '') || (!m.png && family(m) === sweep)), true);",
    "  fold(place, 'all numbers of this scene', own.rest);",
    "}",
    "fold(body, 'all other tables and notes', later);",
    "const redraw = () => plots.forEach(draw => draw());",
    "document.getElementById('measure').addEventListener('input', redraw);",
    "addEventListener('resize', redraw);",
    "redraw();",
    NULL};

/* --- text, numbers and pictures ---------------------------------------------------------------------- */

/* A text of JSON within HTML: nothing in it ends the string or the element. */
static void write_text(FILE *f, const char *name, const char *text)
{
    fprintf(f, "\"%s\":\"", name);
    for (const char *c = text; *c != '\0'; c++)
        fprintf(f, strchr("\"\\<>&", *c) != NULL || (unsigned char)*c < ' ' ? "\\u%04x" : "%c", (unsigned char)*c);
    fputs("\",", f);
}

/* [a, b, ...]; null where a number is not known. */
static void write_numbers(FILE *f, const double *x, int n)
{
    for (int i = 0; i < n; i++)
        fprintf(f, isfinite(x[i]) ? "%c%.5g" : "%cnull", i > 0 ? ',' : '[', x[i]);
    fputc(']', f);
}

static void write_base64(FILE *f, const uint8_t *data, size_t n)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < n; i += 3) {
        size_t left = n - i < 3 ? n - i : 3;
        unsigned long v = 0;
        for (size_t k = 0; k < 3; k++)
            v = v << 8 | (k < left ? data[i + k] : 0);
        for (size_t k = 0; k < 4; k++)
            fputc(k <= left ? digits[v >> (18 - 6 * k) & 63] : '=', f);
    }
}

/* A picture, also as images/SCENE--NAME.png. */
static bool write_picture(FILE *f, const struct scene_results *s, const char *name, const float *pixels,
                          struct error *err)
{
    char path[4096];
    uint8_t *png;
    size_t n;
    snprintf(path, sizeof path, "%s/images/%s--%s.png", s->plan->directory, s->name, name);
    if (!image_write(path, s->width, s->height, pixels, err) || !file_read(path, &png, &n, err))
        return false;
    fputs("\"png\":\"", f);
    write_base64(f, png, n);
    fputs("\",", f);
    free(png);
    return true;
}

/* --- scenes ------------------------------------------------------------------------------------------ */

/* Samples, CPU seconds and the roots of the mean squares: of all steps, the last one last. */
static void write_points(FILE *f, const struct scene_results *s, int method)
{
    int n = 0;
    fputs("\"points\":[", f);
    for (int i = 0; i < PLAN_MAX_STEPS; i++) {
        int step = s->plan->equal ? (i + 1) % PLAN_MAX_STEPS : i;
        const struct run *run = &s->run[method][0][step];
        if (run->spp == 0)
            continue;
        double x[2 + N_SQUARES] = {(double)run->spp, results_seconds(s, method, step)};
        for (int k = 0; k < N_SQUARES; k++)
            x[2 + k] = sqrt(results_square(s, method, step, (enum square)k));
        if (isnan(s->reference.noise8)) /* not subtracted then */
            x[2] = results_mean(s, method, step, Q_RMSE8).mean;
        fputs(n++ > 0 ? "," : "", f);
        write_numbers(f, x, 2 + N_SQUARES);
    }
    fputs("],\"printed\":[", f);
}

static bool write_method(FILE *f, const struct scene_results *s, int method,
                         double (*printed)(const char *, const char *, long), struct error *err)
{
    const struct plan *p = s->plan;
    const struct measured *m = &p->methods.item[method];
    static const char *const halves[] = {"", " (choice)", " (services)", ""};
    bool alone = true, ok = true;
    char name[METHOD_TEXT + 16];
    int n = 0;
    for (int v = 0; v < p->methods.n; v++)
        alone = alone && (v == method || strcmp(p->methods.item[v].label, m->label) != 0);
    fprintf(f, method > 0 ? ",\n{" : "\n{");
    snprintf(name, sizeof name, "%s%s", m->label, alone ? "" : halves[m->halves & 3]);
    write_text(f, "name", name);
    write_text(f, "text", m->text);
    write_text(f, "mark", MARKS[s->mark[method]]);
    if (method < p->n_compared)
        ok = write_picture(f, s, m->file, s->image[method], err);
    write_points(f, s, method);
    for (long spp = 1; printed != NULL && spp < 1L << 20; spp *= 2) {
        double x[2] = {(double)spp, printed(s->name, m->text, spp)};
        fputs(isfinite(x[1]) && n++ > 0 ? "," : "", f);
        if (isfinite(x[1]))
            write_numbers(f, x, 2);
    }
    fputs("]}", f);
    return ok;
}

static bool write_scene(FILE *f, const struct scene_results *s, double (*printed)(const char *, const char *, long),
                        struct error *err)
{
    fputs("{", f);
    write_text(f, "name", s->name);
    fprintf(f, "\"width\":%d,\"height\":%d,\"reference\":{", s->width, s->height);
    write_text(f, "origin", s->reference.origin);
    bool ok = write_picture(f, s, "reference", s->reference.pixels, err);
    fprintf(f, isfinite(s->reference.noise8) ? "\"noise\":%.4g},\"methods\":[" : "\"noise\":null},\"methods\":[",
            s->reference.noise8);
    for (int v = 0; ok && v < s->plan->methods.n; v++)
        ok = write_method(f, s, v, printed, err);
    fputs("]}", f);
    return ok;
}

/* --- the page ---------------------------------------------------------------------------------------- */

static void write_lines(FILE *f, const char *const *line)
{
    for (; *line != NULL; line++)
        fprintf(f, "%s\n", *line);
}

static bool write_data(FILE *f, const struct results *r, const char *title, const char *text,
                       double (*printed)(const char *, const char *, long), struct error *err)
{
    const char *commit = getenv("ASBDPT_COMMIT");
    char about[300], command[8192];
    bool ok = true;
    snprintf(about, sizeof about, "%s, estimator %d%s%.100s; %d seed%s", VERSION, ESTIMATOR,
             commit != NULL ? ", commit " : "", commit != NULL ? commit : "", r->plan->n_seeds,
             r->plan->n_seeds == 1 ? "" : "s");
    snprintf(command, sizeof command, "./asbdpt-lab %s -o %s", r->plan->command, r->plan->directory);
    bool whole = true;
    for (int i = 0; i < r->plan->n_scenes; i++)
        whole &= text_add(command, sizeof command, " %s", r->plan->scene[i]);
    error_clean(command);
    if (!whole)
        snprintf(command, sizeof command, "./asbdpt-lab %.4000s ...", r->plan->command);
    fputs("{", f);
    write_text(f, "title", title);
    write_text(f, "about", about);
    write_text(f, "command", command);
    write_text(f, "text", text);
    fputs("\"scenes\":[", f);
    for (int i = 0; ok && i < r->plan->n_scenes; i++) {
        fputs(i > 0 ? ",\n" : "\n", f);
        ok = write_scene(f, &r->scene[i], printed, err);
    }
    fputs("]}\n", f);
    return ok;
}

bool page_write(const struct results *r, const char *title, const char *markdown,
                double (*printed)(const char *, const char *, long), struct error *err)
{
    struct file_output out;
    char path[4096];
    uint8_t *text;
    size_t n;
    snprintf(path, sizeof path, "%s/%s", r->plan->directory, markdown);
    if (!file_read(path, &text, &n, err))
        return false;
    bool ok = plan_create(r->plan, "report.html", &out, err);
    if (ok) {
        FILE *f = out.stream;
        fprintf(f, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
                "content=\"width=device-width, initial-scale=1\">\n<title>%s</title>\n<style>\n", title);
        write_lines(f, PAGE_STYLE);
        fprintf(f, "</style>\n</head>\n<body>\n<main id=\"page\"></main>\n<noscript>A script draws this page; %s has "
                "its tables.</noscript>\n<script type=\"application/json\" id=\"data\">\n", markdown);
        ok = write_data(f, r, title, (const char *)text, printed, err);
        fputs("</script>\n<script>\n", f);
        write_lines(f, PAGE_SCRIPT);
        fputs("</script>\n</body>\n</html>\n", f);
        if (ok)
            ok = file_commit(&out, err);
        else
            file_abandon(&out);
    }
    free(text);
    return ok;
}

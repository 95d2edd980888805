// Pages of reports in a real browser:  node browser.mjs NODE_MODULES CHROMIUM PICTURES PAGE...
//     node browser.mjs NODE_MODULES CHROMIUM PICTURES --without-webgl PAGE
//     node browser.mjs NODE_MODULES CHROMIUM PICTURES --follow PAGE      a page of a run that goes on, until it has more rows
// Prints what was found of each page as JSON; tests/contrib/test_report judges it.
import { createRequire } from 'node:module';
import { basename, dirname, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { mkdirSync } from 'node:fs';

const [, , modules, executablePath, pictures, ...files] = process.argv;
const { chromium } = createRequire(resolve(modules) + '/')('playwright-core');
mkdirSync(pictures, { recursive: true });
const args = files[0] === '--without-webgl' ? ['--no-sandbox', '--disable-3d-apis'] : ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];
const browser = await chromium.launch({ executablePath, args });
const patiently = { timeout: 240000, polling: 100 }; // on a busy machine: not by frames, which may not come

/** Pixels that are drawn. */
const drawn = page => page.evaluate(() => {
  const { view, S } = window.page;
  if (!S.show) return 0;
  view.draw({ plain: false, edges: false, edge: [0, 0, 0, 0], wire: [1, 1, 1, 1] });
  const gl = view.gl, w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, a = new Uint8Array(4 * w * h);
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, a);
  let n = 0, sum = 0;
  for (let i = 3; i < a.length; i += 4) if (a[i] > 0) { ++n; sum = (sum * 31 + i) % 1000000007; }
  view.dirty = true;
  return { share: n / (w * h), sum };
});

/** Of 60 stations in view, how many are found under the pointer, and which names. */
const picked = page => page.evaluate(() => {
  const { view: v, G } = window.page, names = new Set(), n = Math.min(60, G.n), until = performance.now() + 5000;
  let tried = 0, hit = 0;
  v.size();
  for (let i = 0; i < n && performance.now() < until; ++i) {
    const s = Math.floor((i + 0.5) * G.n / n), [x, y, z] = v.seen(G.place.subarray(3 * s, 3 * s + 3));
    if (x < 5 || y < 5 || x > v.canvas.clientWidth - 5 || y > v.canvas.clientHeight - 5 || z > 1) continue;
    ++tried;
    const k = v.pick(x, y);
    if (k >= 0) { ++hit; names.add(G.model.objects[G.objectOf[k]][0]); }
  }
  v.dirty = true;
  return { tried, hit, names: [...names] };
});

/** Labels of objects that overlap. */
const overlaps = page => page.evaluate(() => {
  const boxes = [...document.querySelectorAll('#names span:not([hidden])')].map(e => e.getBoundingClientRect());
  let n = 0;
  boxes.forEach((a, i) => boxes.slice(i + 1).forEach(b => { if (a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom) ++n; }));
  return { shown: boxes.length, overlapping: n };
});

/** Drags the line of time in the first plot; what is told then, and the time of the drawing. */
async function drag(page) {
  const over = page.locator('.panel:not([hidden]) .u-over').first(), r = await over.boundingBox();
  await page.mouse.move(r.x + 0.6 * r.width, r.y + 40); await page.mouse.down(); await page.mouse.move(r.x + 0.63 * r.width, r.y + 40); await page.mouse.up();
  return page.evaluate(() => ({
    values: [...document.querySelectorAll('.panel:not([hidden]) output')].map(o => [o.dataset.probe, o.dataset.at, o.dataset.value]),
    times: Array.from(window.page.S.show?.times ?? []), frame: window.page.S.frame,
  }));
}

/** Corners of a picture of a motion, and how far halves of joints are apart when the deformation is magnified. */
const geometry = page => page.evaluate(() => {
  const { result, corners, nFrames, read } = window.page, shows = result.shows.filter(s => s.kind === 'frames').map(show => {
    const m = show.model, n = nFrames(show), frames = [...new Set([0, Math.floor(n / 2), n - 1])];
    return { name: show.name, times: Array.from(show.times), corners: frames.map(f => [f, Array.from(corners(show, { frame: f, factor: 1 }))]) };
  });
  const show = result.shows.find(s => s.kind === 'frames'), m = show.model, x0 = read(m.place), object = read(m.object), sample = read(m.sample), pairs = [];
  const firstCorner = new Map();
  sample.forEach((s, i) => { if (!firstCorner.has(s)) firstCorner.set(s, i); });
  const centre = (c, s) => { let k = 0, x = [0, 0, 0]; for (let i = 0; i < sample.length; ++i) if (sample[i] === s) { ++k; for (let d = 0; d < 3; ++d) x[d] += c[3 * i + d]; } return x.map(v => v / k); };
  for (let s = 0; s + 1 < object.length; ++s) for (let t = s + 1; t < object.length; ++t) {
    if (object[s] !== object[t]) break;
    if (m.objects[object[s]][1] === 'Joints' && Math.hypot(...[0, 1, 2].map(d => x0[3 * s + d] - x0[3 * t + d])) < 1e-9) pairs.push([s, t]);
  }
  const frame = Math.floor(nFrames(show) / 2), one = corners(show, { frame, factor: 1 }), eight = corners(show, { frame, factor: 8 });
  const gap = (c, [s, t]) => { const a = centre(c, s), b = centre(c, t); return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); };
  let most = 0, moved = 0;
  for (const pair of pairs.slice(0, 60)) most = Math.max(most, gap(eight, pair) - gap(one, pair));
  for (let i = 0; i < one.length; ++i) moved = Math.max(moved, Math.abs(eight[i] - one[i]));
  return { shows, pairs: pairs.length, gap: most, moved };
});

/** All that is known of the stations in the middle picture of a motion, or in the last one of statics. */
const stations = page => page.evaluate(() => {
  const { result, read, fieldsOf, fieldValues, setShow, setFrame, nFrames } = window.page, show = result.shows.find(s => s.kind === 'frames' && s.model.objects.some(o => o[1]));
  setShow(show);
  const frame = show.name === 'dynamic' ? Math.floor(nFrames(show) / 2) : nFrames(show) - 1;
  setFrame(frame);
  const { G } = window.page, fields = {};
  for (const f of fieldsOf(show)) { const v = fieldValues(show, f, frame); fields[f.name] = { known: Array.from(v.known), values: Array.from(v.values), n: v.n }; }
  return { name: show.name, time: show.times[frame], objects: show.model.objects.map(o => o[0]), object: Array.from(read(show.model.object)), reference: Array.from(read(show.model.place)), place: Array.from(G.place), turn: Array.from(G.turn), fields };
});

/** Way round of each mode that is drawn. */
const whirls = page => page.evaluate(() => window.page.result.shows.filter(s => s.kind === 'shape' && s.main && s.name.startsWith('mode_')).map(s => [s.number, ...window.page.whirl(s).axis, window.page.whirl(s).share]));

/** Of each mode at one speed, how far bodies move along the second axis of their first station: cosine and sine parts. */
const along2 = (page, speed) => page.evaluate(w => {
  const { result, read } = window.page, out = {};
  for (const show of result.shows.filter(s => s.kind === 'shape' && s.name.startsWith('mode_') && Math.abs(s.speed - w) < 1e-9 * w)) {
    const m = show.model, object = read(m.object), mean = read(show.mean), n = object.length, seen = new Set();
    const { partsOf } = window.page, z = partsOf(show, 0);
    for (let s = 0; s < n; ++s) {
      const [name, room] = m.objects[object[s]];
      if (room !== 'Bodies' || seen.has(name)) continue;
      seen.add(name);
      const [x, y, zz, q] = mean.slice(7 * s + 3, 7 * s + 7), e = [2 * (x * y - q * zz), 1 - 2 * (x * x + zz * zz), 2 * (y * zz + q * x)], dot = k => e[0] * z[12 * s + k] + e[1] * z[12 * s + k + 1] + e[2] * z[12 * s + k + 2];
      (out[show.number] ??= {})[name] = [dot(0), dot(3)];
    }
  }
  return out;
}, speed);

/** The track of a station of a motion: as many points as there are pictures, gone again at the second click. */
const tracked = page => page.evaluate(() => {
  const { result, setShow, select, nFrames } = window.page, show = result.shows.find(s => s.name === 'dynamic');
  if (!show) return null;
  setShow(show);
  const g = window.page.G, v = window.page.view, s = g.n - 1;
  select(g.objectOf[s], s);
  const n = v.plain.track?.n ?? 0;
  select(g.objectOf[s]);
  return { n, after: v.plain.track?.n ?? 0, frames: nFrames(show) };
});

/** What a printer is given: the drawing as a plain picture, every panel. */
const printed = page => page.evaluate(() => {
  dispatchEvent(new Event('beforeprint'));
  const c = document.getElementById('printed'), a = c ? c.getContext('2d').getImageData(0, 0, c.width, c.height).data : [];
  let n = 0;
  for (let i = 3; i < a.length; i += 4) if (a[i] > 0) ++n;
  const found = { share: c ? n / (c.width * c.height) : 0, panels: window.page.panels.filter(p => p.root.offsetHeight > 20).length, all: window.page.panels.length };
  dispatchEvent(new Event('afterprint'));
  return found;
});

/** What an open panel has: tables with all their cells, numbers of charts and maps, and what of these is to be seen. */
const contents = (page, name) => page.evaluate(name => {
  const { panels, plots } = window.page, root = panels.find(p => p.name === name).root, finite = a => Array.from(a, v => Number.isFinite(v) ? v : null);
  const copied = canvas => { const c = document.createElement('canvas'); c.width = canvas.width; c.height = canvas.height; const x = c.getContext('2d', { willReadFrequently: true }); x.drawImage(canvas, 0, 0); return x; };
  /** Of the points of a chart, how many are there with the colour of their curve. */
  const seen = q => { const c = copied(q.root), r = devicePixelRatio || 1; let n = 0; for (const [x, y] of q.spots()) { const d = c.getImageData(Math.round(x * r) - 2, Math.round(y * r) - 2, 5, 5).data; for (let i = 0; i < d.length; i += 4) if (d[i + 3] > 200 && Math.max(d[i], d[i + 1], d[i + 2]) - Math.min(d[i], d[i + 1], d[i + 2]) > 60) { ++n; break; } } return n; };
  const ink = canvas => { const d = copied(canvas).getImageData(0, 0, canvas.width, canvas.height).data; let n = 0; for (let i = 0; i < d.length; i += 4) if (d[i + 3] > 200 && Math.max(d[i], d[i + 1], d[i + 2]) - Math.min(d[i], d[i + 1], d[i + 2]) > 40) ++n; return n / (canvas.width * canvas.height); };
  return {
    tables: [...root.querySelectorAll('table')].map(t => ({ head: [...t.querySelectorAll('thead th')].map(e => e.textContent), rows: [...t.querySelectorAll('tbody tr')].map(r => [...r.children].map(c => c.dataset.value ?? c.textContent)) })),
    charts: plots.filter(q => root.contains(q.root)).map(q => ({ title: q.title, curves: q.curves?.map(c => ({ name: c.name, x: finite(c.x), y: finite(c.y) })), series: q.series?.map(s => s.name), cells: q.cells?.slice(0, 20000), n: q.spots?.().length, seen: q.spots ? seen(q) : undefined, ink: ink(q.root.tagName === 'CANVAS' ? q.root : q.root.querySelector('canvas')) })),
    marks: [...root.querySelectorAll('mark')].map(e => e.textContent), choices: [...root.querySelectorAll('select')].map(s => [...s.options].map(o => o.textContent)),
  };
}, name);

/** Every choice of the first list of a panel, one after the other. */
const choices = async (page, name) => {
  const n = await page.evaluate(name => { const s = window.page.panels.find(p => p.name === name).root.querySelector('select'); return s ? s.options.length : 0; }, name), out = [];
  for (let i = 0; i < Math.min(n, 12); ++i) {
    await page.evaluate(([name, i]) => { const s = window.page.panels.find(p => p.name === name).root.querySelector('select'); s.selectedIndex = i; s.dispatchEvent(new Event('change')); }, [name, i]);
    out.push((await contents(page, name)).charts);
  }
  return out;
};

/** Rows of stops show their onset: the time of all plots after a click on each. */
const onsets = page => page.evaluate(() => {
  const { panels, plots, open } = window.page, rows = [...panels.find(p => p.name === 'stops').root.querySelectorAll('tr.pick')], out = [];
  open('histories');
  for (const row of rows.slice(0, 20)) { row.click(); out.push([row.children[1].dataset.value, document.querySelector('#panel-histories output')?.dataset.at, window.page.S.show?.times?.[window.page.S.frame]]); }
  open('stops');
  return out;
});

/** Every point of the charts of frequencies, growth and root locus that has a drawing is clicked; what is shown then. */
const clicked = (page, name) => page.evaluate(name => {
  const { plots, S, panels } = window.page, root = panels.find(p => p.name === name).root, out = [], charts = plots.filter(p => p.spots && root.contains(p.root));
  for (const [number, chart] of charts.entries()) for (const [x, y, curve, i] of chart.spots().slice()) {
    chart.root.scrollIntoView();
    const b = chart.root.getBoundingClientRect();
    chart.root.dispatchEvent(new MouseEvent('click', { clientX: b.left + x, clientY: b.top + y, bubbles: true }));
    if (S.show.kind !== 'frames') out.push({ chart: number, name: S.show.name, speed: S.show.speed, number: S.show.number, growth: S.show.growth, imaginary: S.show.imaginary });
  }
  window.page.play(false);
  // and each row by its own key
  const modes = [...root.querySelectorAll('th')].findIndex(th => th.textContent === 'mode'), speeds = [...root.querySelectorAll('th')].findIndex(th => th.textContent.startsWith('speed'));
  const rows = [...root.querySelectorAll('tr.pick')].map(row => { row.dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter', bubbles: true })); return { cells: [...row.querySelectorAll('td')].map(td => td.dataset.value ?? td.textContent), growth: S.show.growth, imaginary: S.show.imaginary, speed: S.show.speed, number: S.show.number, row: [+row.children[speeds].dataset.value, +row.children[modes].dataset.value] }; });
  window.page.play(false);
  return { out, rows };
}, name);

/** Every panel, motion and mode by keys alone. */
async function byKeys(page) {
  const panels = await page.evaluate(() => { document.activeElement.blur(); return window.page.panels.length; }), seen = new Set(), shows = new Set();
  for (let i = 0; i < panels; ++i) { await page.keyboard.press('+'); seen.add(await page.evaluate(() => window.page.panels.findIndex(p => !p.root.hidden))); }
  const n = await page.evaluate(() => window.page.result.shows.length);
  await page.evaluate(() => window.page.S.show && window.page.setShow(window.page.result.shows[0]));
  for (let i = 0; i < Math.min(n, 12); ++i) { shows.add(await page.evaluate(() => window.page.result.shows.indexOf(window.page.S.show))); await page.keyboard.press('m'); }
  await page.evaluate(() => window.page.S.show && (window.page.setShow(window.page.result.shows[0]), window.page.play(false)));
  await page.keyboard.press('End'); const end = await page.evaluate(() => window.page.S.frame);
  await page.keyboard.press('Home'); const home = await page.evaluate(() => window.page.S.frame);
  return { panels, seen: seen.size, shows: n, shown: shows.size, home, end, frames: await page.evaluate(() => window.page.S.show ? window.page.nFrames(window.page.S.show) : 1) };
}

/** The least contrast of the colours of text on what they stand on, light and dark (WCAG). */
const contrast = page => page.evaluate(() => {
  const luminance = c => { const v = [1, 3, 5].map(i => parseInt(c.slice(i, i + 2), 16) / 255).map(u => u <= 0.03928 ? u / 12.92 : ((u + 0.055) / 1.055) ** 2.4); return 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]; };
  const full = c => c.length === 4 ? '#' + [...c.slice(1)].map(x => x + x).join('') : c, css = n => full(getComputedStyle(document.documentElement).getPropertyValue(n).trim());
  const pairs = [['--text', '--bg'], ['--text', '--panel'], ['--soft', '--panel'], ['--soft', '--bg'], ['--warn', '--warnbg'], ['--accent', '--panel'], ['--soft', '--scene2'], ['--soft', '--scene1'], ['--warn', '--panel']];
  return pairs.map(([a, b]) => { const x = luminance(css(a)), y = luminance(css(b)); return [a, b, +((Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05)).toFixed(2)]; });
});

/** A page that loads itself again: what the reader chose stays. */
async function follow(file) {
  const page = await browser.newPage(), said = [], rows = [];
  let loads = 0;
  page.on('console', m => ['error', 'warning'].includes(m.type()) && !/GPU stall|swiftshader/i.test(m.text()) && said.push(m.text()));
  page.on('pageerror', e => said.push('uncaught: ' + e.message));
  page.on('load', () => ++loads);
  await page.goto(pathToFileURL(resolve(file)).href);
  await page.waitForFunction(() => window.page?.ready, null, patiently);
  await page.evaluate(() => { window.page.open('energy'); window.page.theme(true); window.page.view.azimuth = 1.25; });
  const count = () => page.waitForFunction(() => window.page?.ready && window.page.result.tables.dynamic.rows, null, { timeout: 30000, polling: 100 }).then(h => h.jsonValue()).catch(() => 0);
  for (const until = Date.now() + 100000; Date.now() < until && (loads < 3 || rows[rows.length - 1] <= rows[0]);) { const n = await count(); if (n) rows.push(n); await page.waitForTimeout(500); }
  await page.waitForFunction(() => window.page?.ready, null, patiently);
  const found = await page.evaluate(() => ({ panel: window.page.panels.find(p => !p.root.hidden).name, dark: document.documentElement.classList.contains('dark'), azimuth: window.page.view.azimuth }));
  return { ...found, loads, rows, said };
}

/** A browser that cannot draw: all else works, by any key. */
async function withoutWebgl(file) {
  const page = await browser.newPage(), said = [];
  page.on('pageerror', e => said.push('uncaught: ' + e.message));
  await page.goto(pathToFileURL(resolve(file)).href);
  await page.waitForFunction(() => window.page?.ready || document.getElementById('failed'), null, patiently);
  for (const key of ['2', '3', 'n', 'f', 'm', 't', ' ', 'o', 'x', 'Home', '+']) await page.keyboard.press(key);
  return { ...await page.evaluate(() => ({ note: document.getElementById('note').textContent, panels: window.page.panels.map(p => p.name), open: window.page.panels.find(p => !p.root.hidden).name })), said };
}

if (files[0] === '--without-webgl') {
  console.log(JSON.stringify(await withoutWebgl(files[1])));
  await browser.close();
  process.exit(0);
}

if (files[0] === '--follow') {
  console.log(JSON.stringify(await follow(files[1])));
  await browser.close();
  process.exit(0);
}

const all = [];
for (const file of files) {
  const context = await browser.newContext({ viewport: { width: 1500, height: 900 }, colorScheme: 'light' }), page = await context.newPage();
  page.setDefaultTimeout(120000); // drawing by software, on a busy machine
  const said = [], requests = [], found = { file, name: basename(dirname(resolve(file))), contents: {}, choices: {} };
  page.on('console', m => ['error', 'warning'].includes(m.type()) && !/GPU stall|swiftshader/i.test(m.text()) && said.push(m.text()));
  page.on('pageerror', e => said.push('uncaught: ' + e.message));
  page.on('request', r => !r.url().startsWith('blob:') && requests.push(r.url().slice(0, 60)));
  const shot = name => page.screenshot({ path: `${pictures}/${found.name}_${name}.png` });
  const client = await context.newCDPSession(page);
  await client.send('Performance.enable', { timeDomain: 'threadTicks' }); // of the processor, counted from here on
  await page.goto(pathToFileURL(resolve(file)).href);
  await page.waitForFunction(() => window.page?.ready || document.getElementById('failed'), null, patiently);
  const metrics = Object.fromEntries((await client.send('Performance.getMetrics')).metrics.map(m => [m.name, m.value]));
  found.seconds_of_page = metrics.TaskDuration;
  found.panels = await page.evaluate(() => window.page.panels.map(p => p.name));
  found.shows = await page.evaluate(() => window.page.result.shows.map(s => s.name));
  found.title = await page.evaluate(() => document.getElementById('title').textContent);
  found.live = await page.evaluate(() => document.getElementById('live')?.textContent);
  found.verdict = await page.evaluate(() => document.getElementById('verdict').textContent);
  await page.waitForTimeout(200); await shot('start');
  const hasDrawing = found.shows.length > 0;
  if (hasDrawing) {
    const before = await drawn(page);
    await page.mouse.move(300, 450); await page.mouse.down(); await page.mouse.move(420, 400, { steps: 4 }); await page.mouse.up();
    const after = await drawn(page);
    found.share = before.share; found.turns = before.sum !== after.sum;
    found.picked = await picked(page);
    await page.keyboard.press('n'); await page.waitForTimeout(150); found.labels = await overlaps(page); await shot('names'); await page.keyboard.press('n');
  }
  if (found.panels[0] === 'histories') { found.cursor = await drag(page); await shot('cursor'); }
  if (found.shows.some(n => n === 'dynamic' || n === 'static')) found.geometry = await geometry(page);
  if (found.shows.some(n => n === 'dynamic' || n === 'static')) found.stations = await stations(page);
  found.whirls = await whirls(page);
  found.tracked = await tracked(page);
  found.stresses = await page.evaluate(() => { const { result, fieldsOf, rangeOf } = window.page, show = result.shows.find(s => s.name.startsWith('stresses ')), f = show && fieldsOf(show).find(x => x.name === 'von_Mises_stress'); return f ? { name: show.name, unit: f.unit, largest: rangeOf(show, f, -1)[1] } : null; });
  if (found.panels.includes('fan')) { await page.evaluate(() => window.page.open('fan')); await page.waitForTimeout(100); found.clicked = await clicked(page, 'fan'); await shot('fan'); found.along2 = await along2(page, 30); }
  if (found.panels.includes('stability')) { await page.evaluate(() => window.page.open('stability')); await page.waitForTimeout(100); found.clicked = await clicked(page, 'stability'); }
  for (const name of found.panels) { await page.evaluate(n => window.page.open(n), name); await page.waitForTimeout(60); await shot('panel_' + name.replace(/\W/g, '_')); found.contents[name] = await contents(page, name); if (/harmonics|rotor maps/.test(name)) found.choices[name] = await choices(page, name); if (name === 'stops') found.onsets = await onsets(page); }
  if (found.panels.includes('compare')) found.differ = await page.evaluate(() => [...document.querySelectorAll('#differ tbody tr')].map(r => [...r.children].map(c => c.textContent)));
  if (found.panels.includes('messages')) found.messages = await page.evaluate(() => document.getElementById('panel-messages').textContent);
  found.keys = await byKeys(page);
  const vectors = await page.evaluate(() => { const v = document.getElementById('vectors'); if (!window.page.S.show || v.hidden || v.options.length < 2) return null; const names = [...v.options].slice(1).map(o => o.value); const f = names.find(n => /lift|moment|force/.test(n)) ?? names[0]; v.value = f; v.dispatchEvent(new Event('change')); const { G, S } = window.page; return { names, of: S.vectors, n: G.arrows.length, legend: document.getElementById('arrows')?.textContent }; });
  if (vectors) { found.vectors = vectors; await page.waitForTimeout(100); await shot('arrows'); }
  const other = found.shows.findIndex(n => /^(mode|floquet)_/.test(n));
  if (other >= 0) { await page.evaluate(k => { window.page.setShow(window.page.result.shows[k], true); window.page.play(false); window.page.S.phase = 0.6; window.page.update(); }, other); await page.waitForTimeout(100); await shot('mode'); }
  found.light = await contrast(page);
  await page.keyboard.press('t'); found.dark = await contrast(page);
  await page.evaluate(() => { const { panels, open, S, result, setShow } = window.page; open(panels[0].name); if (result.shows.length) { setShow(result.shows[0]); const c = document.getElementById('colour'); if (c.options.length > 1) { c.value = c.options[1].value; c.dispatchEvent(new Event('change')); } } });
  await page.waitForTimeout(150); await shot('dark'); await page.keyboard.press('t');
  if (hasDrawing) found.ms_of_picture = await page.evaluate(() => { const { S, setFrame, view, nFrames } = window.page, n = nFrames(S.show), t = performance.now(); for (let i = 0; i < 20; ++i) { setFrame(i % n); view.draw({ plain: true, edges: true, edge: [0, 0, 0, 0.5], wire: [1, 1, 1, 1] }); view.gl.finish(); } return (performance.now() - t) / 20; });
  await page.emulateMedia({ media: 'print' });
  found.printed = await printed(page);
  found.pdf = (await page.pdf({ format: 'A4' })).length;
  found.said = said; found.requests = requests;
  all.push(found);
  await context.close();
}
await browser.close();
console.log(JSON.stringify(all));

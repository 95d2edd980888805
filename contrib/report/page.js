// The page: time, keys, and what holds drawing, plots and panels together.
import { byId, load, make, read, short } from './data.js';
import { clock, isShown, plots, redrawCharts } from './plots.js';
import { build, open, panels, shapeOf } from './panels.js';
import { G, S, dark, field, fieldsOf, fieldValues, fit, hover, isSection, isTime, names, pick, rangeOf, recolour, select, style, times, update, useShow, vectorFields, view } from './scene.js';
import { corners, nFrames, partsOf, whirl } from './place.js';

let report, result;

// -------------------------------------------------------------------------------------------------- time and playing

function setFrame(k, fromPlot) {
  if (!S.show) return;
  S.frame = Math.max(0, Math.min(nFrames(S.show) - 1, k));
  byId('frame').value = S.frame;
  update();
  if (!fromPlot && isTime()) setTime(times()[S.frame], true);
}

/** The drawing shows the nearest picture, never something between: a rotor between two pictures would turn backwards. */
function setTime(t, fromFrame) {
  clock.now = t;
  if (!fromFrame && isTime()) {
    const T = times();
    let k = 0;
    for (let i = 1; i < T.length; ++i) if (Math.abs(T[i] - t) < Math.abs(T[k] - t)) k = i;
    if (k !== S.frame) setFrame(k, true);
  }
  for (const p of plots) if (isShown(p)) p.cursorTo?.(t);
}

function play(on = !S.playing) {
  S.playing = on; S.clock = undefined;
  byId('play').textContent = on ? '❚❚' : '▶';
  byId('play').setAttribute('aria-label', on ? 'Stop' : 'Play');
}

let last = 0;
function tick(now) {
  requestAnimationFrame(tick);
  const dt = Math.min(0.1, (now - last) / 1000);
  last = now;
  if (S.playing && S.show) advance(dt);
  if (view?.dirty) { view.draw(style()); names(); }
}

function advance(dt) {
  if (S.show.kind === 'shape') { S.phase += dt * Math.PI * +byId('speed').value; update(); return; }
  const T = times(), n = T.length, first = T[0], period = S.show.kind === 'floquet' ? S.show.period : T[n - 1] - first;
  S.clock = (S.clock ?? T[S.frame]) + dt * +byId('speed').value;
  while (S.clock >= first + period && period > 0) { S.clock -= period; S.periods += 1; if (S.show.kind !== 'floquet') S.clock = first; }
  let k = 0;
  while (k < n - 1 && T[k + 1] <= S.clock) ++k;
  if (S.show.kind !== 'floquet') S.periods = 0;
  if (k !== S.frame) setFrame(k);
}

// --------------------------------------------------------------------------------------------------- what is shown

const nameOf = show => show.name === 'dynamic' ? 'motion' : show.name.replaceAll('_', ' ') + (show.speed !== undefined && !/ at /.test(show.name) ? ` at ${short(show.speed, 6)} rad/s` : '') + (show.kind === 'shape' && show.frequency > 0 ? `  ${short(show.frequency, 5)} rad/s` : '');

function options(select, list, value) {
  select.replaceChildren(...list.map(([v, text]) => make('option', { value: v }, text)));
  select.value = value;
}

function setShow(show, keepView) {
  if (!show) return;
  const before = S.show, first = !before, model = before?.model, same = S.show?.kind === 'frames' && show.kind === 'frames';
  play(false);
  const was = { colour: S.colour, vectors: S.vectors };
  useShow(show);
  byId('show').value = result.shows.indexOf(show); byId('factor').value = 1;
  const n = nFrames(show), isShape = show.kind === 'shape';
  byId('frame').max = n - 1; byId('frame').hidden = isShape || n < 2; byId('play').hidden = !isShape && n < 2;
  const fields = fieldsOf(show);
  S.colour = fields.some(f => f.name === was.colour) ? was.colour : isSection(show) && fields.length ? (fields.find(f => /Mises_stress/.test(f.name)) ?? fields[0]).name : 'kind';
  options(byId('colour'), [['kind', 'colour: kind'], ...fields.map(f => [f.name, `${f.name}${f.unit && f.unit !== '1' ? ` [${f.unit}]` : ''}`])], S.colour);
  byId('colour').hidden = !fields.length;
  const vectors = vectorFields();
  S.vectors = vectors.some(f => f.name === was.vectors) ? was.vectors : '';
  options(byId('vectors'), [['', 'no arrows'], ...vectors.map(f => [f.name, '→ ' + f.name])], S.vectors);
  byId('vectors').hidden = !vectors.length;
  byId('orbits').hidden = !isShape;
  setComponents();
  const T = times(), span = show.kind === 'floquet' ? show.period : T ? T[n - 1] - T[0] : 1;
  options(byId('speed'), isShape ? [[0.5, 'slow'], [1, 'normal'], [2, 'fast']] : [[1, show.name === 'static' ? '1 / s' : 'real time'], [0.1, '1/10'], [0.01, '1/100'], [0.001, '1/1000'], [span / 3, 'all in 3 s'], [span / 8, 'all in 8 s'], [span / 30, 'all in 30 s']], isShape ? 1 : span / (show.kind === 'floquet' ? 3 : 8));
  byId('speed').hidden = byId('play').hidden;
  S.frame = 0;
  if (first || !keepView || model !== show.model && (!same || isSection(show) || isSection(before))) fit(isSection(show) ? [1, 0, 0] : first || (before && isSection(before)) ? [1, -1.3, 0.8] : undefined);
  setFrame(isTime() || show.kind === 'floquet' ? 0 : n - 1);
  if (show.kind !== 'frames' && !matchMedia('(prefers-reduced-motion: reduce)').matches && !first) play(true);
  for (const row of document.querySelectorAll('[data-show]')) row.classList.toggle('now', row.dataset.show === show.name);
  redrawCharts();
}

function setComponents() {
  const f = field(), components = f?.components ?? [];
  if (S.component >= components.length) S.component = -1;
  options(byId('component'), [[-1, 'size'], ...components.map((c, i) => [i, c])], S.component);
  byId('component').hidden = !components.length;
}

const toggle = (button, name) => { S[name] = !S[name]; byId(button).setAttribute('aria-pressed', S[name]); if (view) { update(); view.dirty = true; } };

function theme(on = !dark()) {
  document.documentElement.classList.toggle('dark', on);
  recolour();
  for (const p of plots) if (isShown(p)) p.draw();
}

function redraw() {
  if (view) view.dirty = true;
  for (const p of plots) if (isShown(p)) p.draw();
}

function grow(percent) {
  byId('scene').style.width = Math.max(15, Math.min(85, percent)) + '%';
  redraw();
}

// ------------------------------------------------------------------------------------------------------------ events

function listenToControls() {
  byId('show').onchange = e => setShow(result.shows[e.target.value], true);
  byId('colour').onchange = e => { S.colour = e.target.value; S.component = -1; setComponents(); update(); };
  byId('component').onchange = e => { S.component = +e.target.value; update(); };
  byId('vectors').onchange = e => { S.vectors = e.target.value; update(); };
  byId('factor').oninput = e => { S.factor = e.target.value !== '' && Number.isFinite(+e.target.value) ? +e.target.value : 1; update(); };
  byId('frame').oninput = e => { play(false); setFrame(+e.target.value); };
  byId('play').onclick = () => play(); byId('theme').onclick = () => theme(); byId('help').onclick = () => byId('keys').showModal();
  byId('fit').onclick = () => fit(); byId('names_on').onclick = () => toggle('names_on', 'names'); byId('orbits').onclick = () => toggle('orbits', 'orbits');
  for (const b of document.querySelectorAll('[data-view]')) b.onclick = () => fit(b.dataset.view.split(',').map(Number));
  byId('tabs').addEventListener('keydown', e => {
    const i = panels.findIndex(p => p.tab === document.activeElement), j = e.key === 'ArrowRight' ? i + 1 : e.key === 'ArrowLeft' ? i - 1 : -1;
    if (i >= 0 && panels[j]) { open(panels[j].name); panels[j].tab.focus(); }
    if (i >= 0 && /Arrow/.test(e.key)) e.stopPropagation();
  });
  const divider = byId('divider');
  divider.addEventListener('pointerdown', e => divider.setPointerCapture(e.pointerId));
  divider.addEventListener('pointermove', e => e.buttons && grow(100 * e.clientX / innerWidth));
  divider.addEventListener('keydown', e => { const w = 100 * byId('scene').offsetWidth / innerWidth; if (e.key === 'ArrowLeft') grow(w - 4); if (e.key === 'ArrowRight') grow(w + 4); if (/Arrow/.test(e.key)) e.stopPropagation(); });
}

function listenToCanvas() {
  let wait = false, down = null;
  const canvas = byId('view');
  canvas.addEventListener('pointermove', e => { if (wait || !G) return; wait = true; requestAnimationFrame(() => { wait = false; hover(e); }); });
  canvas.addEventListener('pointerleave', () => (byId('name').hidden = true));
  canvas.addEventListener('pointerdown', e => (down = [e.clientX, e.clientY]));
  canvas.addEventListener('pointerup', e => {
    if (!down || Math.hypot(e.clientX - down[0], e.clientY - down[1]) >= 4 || !G) return;
    const hit = pick(e);
    if (hit) select(hit.object, hit.sample); else if (S.selected >= 0) select(S.selected);
  });
}

function listenToKeys() {
  addEventListener('keydown', e => {
    if ((/INPUT|SELECT|TEXTAREA/.test(e.target.tagName) && e.target.type !== 'range') || e.ctrlKey || e.metaKey || e.altKey || document.querySelector('dialog[open]')) return;
    const k = e.key.toLowerCase(), n = S.show ? nFrames(S.show) : 1, next = d => setShow(result.shows[result.shows.indexOf(S.show) + d], true);
    const act = {
      ' ': () => play(), arrowleft: () => setFrame(S.frame - 1), arrowright: () => setFrame(S.frame + 1), home: () => setFrame(0), end: () => setFrame(n - 1),
      x: () => fit([1, 0, 0]), y: () => fit([0, 1, 0]), z: () => fit([0, 0, 1]), c: () => fit([1, -1.3, 0.8]), f: () => fit(), n: () => toggle('names_on', 'names'), o: () => toggle('orbits', 'orbits'),
      t: () => theme(), m: () => next(1), mshift: () => next(-1), '?': () => byId('keys').showModal(),
      '+': () => cycle(1), '-': () => cycle(-1),
    }[k === 'm' && e.shiftKey ? 'mshift' : k] || (panels[+k - 1] && (() => open(panels[+k - 1].name)));
    if (!act || (!S.show && !/^[1-9t?+-]$/.test(k))) return;
    if (e.target.tagName === 'BUTTON' && k === ' ') return;
    e.preventDefault(); act();
  });
}

/** The next panel, or that before. */
function cycle(d) { const i = panels.findIndex(p => !p.root.hidden); open(panels[(i + d + panels.length) % panels.length].name); }

function listenToPrint() {
  let was;
  addEventListener('beforeprint', () => {
    was = panels.find(p => !p.root.hidden).name;
    for (const p of panels) { p.root.hidden = false; if (!p.done) { p.done = true; p.build(p.root); } if (!p.root.querySelector('.printed')) p.root.prepend(make('h2', { class: 'printed' }, p.name)); }
    for (const p of plots) p.draw();
    if (!view) return;
    view.draw(style()); // a canvas of WebGL comes out empty on paper, a plain one does not
    const c = byId('view'), copy = make('canvas', { id: 'printed', width: c.width, height: c.height });
    copy.getContext('2d').drawImage(c, 0, 0);
    byId('scene').append(copy);
  });
  addEventListener('afterprint', () => { byId('printed')?.remove(); open(was); });
  addEventListener('resize', redraw);
}

// ------------------------------------------------------------------------------------------------------- while it runs

/** What the reader chose is kept from one loading to the next. */
function live() {
  const key = 'samara ' + location.pathname, was = JSON.parse(sessionStorage.getItem(key) || 'null');
  const keep = () => sessionStorage.setItem(key, JSON.stringify({
    tab: panels.find(p => !p.root.hidden).name, scroll: byId('panels').scrollTop, dark: dark(), names: S.names, colour: S.colour, vectors: S.vectors, component: S.component, show: S.show?.name, width: byId('scene').style.width,
    end: !S.show || S.show.kind !== 'frames' || S.frame >= nFrames(S.show) - 1, frame: S.frame, camera: view && [view.azimuth, view.elevation, view.distance, ...view.target],
  }));
  if (was) restore(was);
  else if (S.show?.kind === 'frames') setFrame(nFrames(S.show) - 1);
  const age = Date.now() / 1000 - result.written, late = 10 * Math.max(2, result.period || 0);
  const status = make('span', { class: 'chip', role: 'status', id: 'live' }, result.progress || 'running');
  byId('facts').before(status);
  if (age > late) { status.textContent = `the run did not end: nothing new for ${short(age, 3)} s, last ${result.progress || 'nothing'}`; status.classList.add('bad'); return; }
  setInterval(() => { if (S.playing || document.hidden || document.querySelector('dialog[open]')) return; keep(); location.reload(); }, 3000);
}

function restore(was) {
  if (was.dark !== dark()) theme(was.dark);
  if (was.width) grow(parseFloat(was.width));
  if (panels.some(p => p.name === was.tab)) open(was.tab);
  byId('panels').scrollTop = was.scroll;
  if (was.names) toggle('names_on', 'names');
  const show = view && result.shows.find(s => s.name === was.show);
  if (!show) return;
  S.colour = was.colour; S.vectors = was.vectors; S.component = was.component;
  setShow(show, true); play(false);
  if (was.camera) { [view.azimuth, view.elevation, view.distance] = was.camera; view.target = was.camera.slice(3); }
  setFrame(was.end && show.kind === 'frames' ? nFrames(show) - 1 : was.frame);
}

// -------------------------------------------------------------------------------------------------------------- page

function verdict() {
  const v = byId('verdict'), warnings = result.log.split('\n').filter(l => /(^|: )warning:/i.test(l)).length, parts = [];
  if (result.state === 'failed') parts.push('the run failed');
  if (result.state === 'stopped') parts.push('the run was stopped');
  if (result.state === 'running' && !report.live) parts.push('the run had not ended');
  if (warnings) parts.push(`${warnings} warning${warnings > 1 ? 's' : ''}`);
  v.textContent = parts.join(', '); v.className = parts.length ? 'warn' : ''; v.tabIndex = parts.length ? 0 : -1;
  v.onclick = () => open('messages'); v.onkeydown = e => e.key === 'Enter' && open('messages');
}

function useResult(which) {
  result = report.results[which];
  byId('title').textContent = document.title = result.title;
  verdict();
  const t = result.tables.dynamic;
  clock.now = t?.column(0)[0] ?? 0;
  S.show = null; S.selected = -1;
  options(byId('show'), result.shows.map((s, i) => [i, nameOf(s)]), 0);
  build(report.results, result, show => setShow(show, true));
  const m = result.shows[0]?.model;
  byId('facts').textContent = [m && `${m.objects.length} objects`, m && `${m.place.s[0]} stations`, t && `${t.rows} rows in time`].filter(Boolean).join(' · ');
  for (const id of ['bar', 'transport', 'view']) byId(id).hidden = false;
  byId('note').textContent = '';
  byId('scene').style.width = result.shows.length ? '' : '18%';
  try {
    if (!result.shows.length) throw new Error('There are no drawings in these results.');
    setShow(result.shows[0]);
  } catch (e) { S.show = null; byId('note').textContent = e.message; for (const id of ['bar', 'transport', 'legend', 'view']) byId(id).hidden = true; }
  redraw(); // the panels have the width that the drawing leaves
}

async function main() {
  const began = performance.now();
  document.documentElement.classList.toggle('dark', matchMedia('(prefers-color-scheme: dark)').matches);
  report = await load();
  clock.drag = t => setTime(t); clock.stop = () => play(false);
  const results = byId('results');
  options(results, report.results.map((r, i) => [i, `${r.name}: ${r.title}`]), 0);
  results.hidden = report.results.length < 2;
  results.onchange = e => useResult(+e.target.value);
  useResult(0);
  listenToControls(); listenToCanvas(); listenToKeys(); listenToPrint();
  byId('orbits').setAttribute('aria-pressed', S.orbits);
  requestAnimationFrame(tick);
  if (report.live) live();
  window.page = { S, report, corners, fieldsOf, fieldValues, fit, nFrames, open, panels, partsOf, play, plots, rangeOf, read, select, setFrame, setShow, setTime, shapeOf, theme, update, useResult, whirl, get G() { return G; }, get view() { return view; }, get result() { return result; }, ready: performance.now() - began };
}
main().catch(e => { document.body.prepend(make('p', { class: 'panel', id: 'failed' }, `This page could not be opened: ${e.message}.`)); throw e; });

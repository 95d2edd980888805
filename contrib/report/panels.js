// The panels beside the drawing. Each is built when it is opened first.
import { byId, make, short, withUnit } from './data.js';
import { chart, clock, diskMap, isShown, plots, redrawCharts, spectrum, timePlot } from './plots.js';
import { S, fieldsOf, fieldValues, mapColour, rangeOf, select } from './scene.js';
import { whirl } from './place.js';

export const panels = [];
let result, results, showIt;

function panel(name, build) {
  const root = make('div', { class: 'panel', role: 'tabpanel', id: 'panel-' + name.replace(/\W/g, '-'), hidden: true });
  byId('panels').append(root);
  panels.push({ name, root, build, done: false });
}

export function open(name) {
  for (const p of panels) {
    const is = p.name === name;
    p.root.hidden = !is; p.tab.setAttribute('aria-selected', is); p.tab.tabIndex = is ? 0 : -1;
    if (!is) continue;
    if (!p.done) { p.done = true; p.build(p.root); }
    for (const q of plots) if (p.root.contains(q.root)) q.draw();
  }
}

const table = name => result.tables[name];

/** Drops plots that are in an element that is emptied. */
function emptied(element) {
  for (let i = plots.length; i--;) if (element.contains(plots[i].root)) plots.splice(i, 1);
  element.replaceChildren();
}

// ----------------------------------------------------------------------------------------------------------- tables

function htmlTable(t, options = {}) {
  const n = t.kept, limit = options.limit || 400, rows = [];
  // a share of what has no name says nothing
  const isOf = c => { const of = t.named(t.names[c].replace(/^share of /, '')); return of && /^share of /.test(t.names[c]) && Array.from(of).every(v => !v); };
  const cols = t.names.map((_, c) => c).filter(c => !isOf(c)).filter(c => !n || Array.from({ length: Math.min(n, limit) }, (_, i) => t.column(c)[i]).some(v => typeof v === 'string' ? v : Number.isFinite(v)));
  const cell = v => typeof v === 'string' ? make('td', { class: 't' }, v) : make('td', { 'data-value': v }, short(v, 6));
  const more = options.more;
  for (let i = 0; i < Math.min(n, limit); ++i) rows.push(make('tr', options.row?.(i) || {}, ...cols.flatMap((c, k) => k === (more ? 2 : -1) ? [make('td', { class: 't' }, more.of(i)), cell(t.column(c)[i])] : [cell(t.column(c)[i])])));
  return [make('div', { class: 'wide' }, make('table', {}, make('thead', {}, make('tr', {}, ...cols.flatMap((i, k) => [k === (more ? 2 : -1) ? make('th', { scope: 'col', title: more.title }, more.name) : null, make('th', { scope: 'col', class: t.isText(i) ? 't' : '' }, withUnit(t.names[i], t.units[i]))]))), make('tbody', {}, ...rows))),
    t.rows > Math.min(n, limit) ? make('p', { class: 'soft' }, `${Math.min(n, limit)} of ${t.rows} rows`) : ''];
}

/** A row that shows a drawing, by mouse and by keys. */
const rowOf = show => show ? { class: 'pick', 'data-show': show.name, tabindex: 0, title: 'Show it', onclick: () => showIt(show), onkeydown: e => e.key === 'Enter' && showIt(show) } : {};

/** The shape of a row: by its number, and of several speeds the one nearest to the row's; the latest that was found. */
export function shapeOf(number, speed, tolerance = 1e-9) {
  let best, least = tolerance * Math.abs(speed);
  for (const s of result.shows) {
    if (s.kind !== 'shape' || !s.name.startsWith('mode_') || s.number !== number) continue;
    if (speed === undefined) { if (s.main) best = s; continue; }
    const off = Math.abs(s.speed - speed);
    if (off <= least) { best = s; least = off; }
  }
  return best;
}

const whirlColumn = showOf => ({
  name: 'whirl', title: 'Way round of the stations, about the axis with the largest part, in the axes of the modes; 1: circles, 0: to and fro',
  of(i) {
    const show = showOf(i);
    if (!show) return '';
    const { axis, share } = whirl(show), k = [0, 1, 2].sort((a, b) => Math.abs(axis[b]) - Math.abs(axis[a]))[0];
    return share < 0.02 ? '↔ 0' : `${axis[k] > 0 ? '↺ +' : '↻ −'}${'xyz'[k]} ${short(share, 2)}`;
  },
});

// -------------------------------------------------------------------------------------------------------- histories

function groupsByUnit(t) {
  const groups = new Map();
  t.names.forEach((name, i) => { if (i && !t.isText(i)) (groups.get(t.units[i]) ?? groups.set(t.units[i], []).get(t.units[i])).push({ name, unit: t.units[i], y: t.column(i) }); });
  return groups;
}

function historyPanel(name) {
  return root => {
    const t = table(name), x = t.column(0), groups = groupsByUnit(t), xLabel = withUnit(t.names[0], t.units[0]), body = make('div');
    const kinds = ['against ' + t.names[0], ...(name === 'dynamic' && x.length > 15 ? ['spectrum'] : []), ...(t.names.length > 2 ? ['one against another'] : [])];
    const kind = make('select', { 'aria-label': 'Kind of plot' }, ...kinds.map(v => make('option', {}, v)));
    const filter = make('input', { type: 'search', placeholder: 'probes …', 'aria-label': 'Only probes with these letters' });
    root.append(make('div', { class: 'row' }, kind, filter, make('span', { class: 'soft' }, t.kept < t.rows ? `${t.kept} of ${t.rows} rows: the least and the largest of each piece` : `${t.rows} rows`)), body);
    const has = s => s.name.toLowerCase().includes(filter.value.toLowerCase());
    const redo = () => {
      emptied(body);
      if (kind.selectedIndex === 0) {
        for (const [unit, list] of groups) { const some = list.filter(has); for (let i = 0; i < some.length; i += 8) timePlot(body, `[${unit || 1}]`, x, xLabel, some.slice(i, i + 8), { own: name !== 'dynamic' }); }
      } else if (kind.value === 'spectrum') {
        for (const [unit, list] of groups) spectrumPlot(body, unit, x, list.filter(has).slice(0, 8));
      } else againstPlot(body, [...groups.values()].flat().filter(has));
      for (const p of plots) if (body.contains(p.root)) p.draw();
    };
    kind.onchange = filter.oninput = redo;
    redo();
  };
}

function spectrumPlot(parent, unit, x, list) {
  const some = list.map(s => ({ name: s.name, f: spectrum(x, s.y) })).filter(s => s.f);
  if (!some.length) return;
  let most = 0, upTo = 0;
  for (const q of some) q.f[1].forEach((v, i) => { if (i > 3 && v > most) { most = v; upTo = 12 * q.f[0][i]; } });
  timePlot(parent, `amplitude [${unit || 1}]`, some[0].f[0], 'frequency [Hz]', some.map(s => ({ name: s.name, y: Array.from(s.f[1], v => v > 1e-9 * most ? v : null) })), { own: true, log: true, height: 220, upTo: Math.min(upTo, some[0].f[0].at(-1)) });
}

function againstPlot(parent, all) {
  const choose = label => make('select', { 'aria-label': label }, ...all.map((s, i) => make('option', { value: i }, s.name))), a = choose('across'), b = choose('up'), area = make('div');
  b.value = Math.min(1, all.length - 1);
  parent.append(make('div', { class: 'row' }, a, ' across, ', b, ' up'), area);
  const draw = () => { emptied(area); const p = all[a.value], q = all[b.value]; if (p && q) chart(area, `${q.name} against ${p.name}`, withUnit(p.name, p.unit), withUnit(q.name, q.unit), [{ name: q.name, x: p.y, y: q.y, line: true }], { equal: p.unit === q.unit }).draw(); };
  a.onchange = b.onchange = draw;
  draw();
}

// ------------------------------------------------------------------------------------------- modes, fans, stability

function modesPanel(root) {
  const names = Object.keys(result.tables).filter(n => /^modes(_|$)/.test(n)).sort((a, b) => (+a.slice(6) || -1) - (+b.slice(6) || -1));
  root.append(make('p', { class: 'soft' }, 'A row with a drawing shows it: click, or Enter. ↺ +x: the stations go round x by the right hand, in the axes of the modes.'));
  for (const name of names.slice(0, 40)) {
    const t = table(name), number = t.column(0), speed = name === 'modes' ? undefined : +name.slice(6), showOf = i => shapeOf(number[i], speed, 1e-5);
    root.append(make('h2', {}, name === 'modes' ? 'modes' : `at ${name.slice(6)} rad/s`), ...htmlTable(t, { row: i => rowOf(showOf(i)), more: whirlColumn(showOf) }));
  }
}

function fanPanel(name) {
  return root => {
    const t = table(name), speed = t.named('speed'), branch = t.named('branch') || t.named('mode'), frequency = t.named('frequency'), growth = t.named('growth rate') || t.named('real');
    const damping = t.named('damping ratio'), family = t.named('family') || [], pattern = t.named('pattern') || [], number = t.named('mode'), unit = t.unitOf('frequency'), by = new Map();
    const showOf = i => !number ? undefined : name === 'fan' ? shapeOf(number[i], speed[i]) : result.shows.find(s => s.name === `floquet_${number[i]}` && Math.abs(s.speed - speed[i]) <= 1e-9 * Math.abs(speed[i]));
    branch.forEach((b, i) => (by.get(b) ?? by.set(b, []).get(b)).push(i));
    const curve = (rows, ys, xs) => {
      rows.sort((a, b) => speed[a] - speed[b]);
      const label = [...new Set([family[rows[0]], pattern[rows[0]]].filter(x => typeof x === 'string' && x))].join(', ') || `branch ${branch[rows[0]]}`;
      return { name: label, x: rows.map(i => xs[i]), y: rows.map(i => ys[i]), line: true, dots: true, rows, pick: (k, now) => { const show = showOf(rows[k]); if (show && now) showIt(show); return show; }, isNow: k => { const show = showOf(rows[k]); return show && show === S.show; }, say: k => damping ? `, damping ${short(damping[rows[k]], 3)}` : '', filled: k => !(growth && growth[rows[k]] > 0) };
    };
    const curves = [...by.values()], xLabel = withUnit('speed', t.unitOf('speed'));
    root.append(make('p', { class: 'soft' }, 'Open circles are unstable. Larger points have a drawing: click.'));
    if (frequency) chart(root, 'Frequencies', xLabel, withUnit('frequency', unit), curves.map(r => curve(r, frequency, speed)), { from0: true, rays: unit === 'rad/s' ? [1, 2, 3, 4, 5, 6] : [] });
    if (growth) chart(root, 'Growth rates', xLabel, 'growth rate [1/s]', curves.map(r => curve(r, growth, speed)));
    if (growth && frequency) chart(root, 'Root locus', 'growth rate [1/s]', withUnit('frequency', unit), curves.map(r => curve(r, frequency, growth)), { zero: 0 });
    root.append(...htmlTable(t, { row: i => rowOf(showOf(i)) }));
  };
}

// ------------------------------------------------------------------------------------------------ energy, steps, maps

function energyPanel(root) {
  const t = table('dynamic_energy'), x = t.column(0), pick = f => t.names.map((n, i) => [n, i]).filter(([n, i]) => i && f(n)).map(([n, i]) => ({ name: n, y: t.column(i) })), isBalance = n => /balance/.test(n);
  const all = pick(n => !isBalance(n)).filter(s => s.y.some(v => v !== 0));
  timePlot(root, 'Energies, works and losses [J]', x, 'time [s]', all.slice(0, 16), { height: 280 });
  let scale = 1e-300;
  for (const s of all) for (const v of s.y) scale = Math.max(scale, Math.abs(v));
  const balance = pick(isBalance);
  if (balance.length) timePlot(root, `What does not balance, part of the largest (${short(scale, 3)} J)`, x, 'time [s]', balance.map(s => ({ name: s.name, y: Array.from(s.y, v => Math.abs(v) / scale || null) })), { log: true });
}

function stepsPanel(root) {
  const t = table('dynamic_steps'), x = t.column(0);
  t.names.forEach((n, i) => {
    if (!i || t.isText(i)) return;
    const y = t.column(i), isSize = /step|error|size|estimate/.test(n), positive = y.some(v => v > 0);
    if (!y.some(v => Math.abs(v - y[0]) > 1e-6 * Math.abs(y[0]))) // but for round-off of times
      { if (Number.isFinite(y[0])) root.append(make('p', {}, `${withUnit(n, t.units[i])}: ${short(y[0], 6)} always`)); return; }
    timePlot(root, withUnit(n, t.units[i]), x, 'time [s]', [{ name: n, y: isSize && positive ? Array.from(y, v => v > 0 ? v : null) : y }], { height: 130, log: isSize && positive });
  });
}

/** Fields of blades over azimuth and radius, from the pictures of the last turns. */
function mapsPanel(root) {
  const show = result.shows.find(s => s.kind === 'frames' && s.name === 'dynamic') , all = fieldsOf(show), azimuth = all.find(f => f.name === 'azimuth'), radius = all.find(f => f.name === 'radius');
  const n = show.times.length, known = fieldValues(show, azimuth, 0).known, object = show.model.object.values, names = show.model.objects;
  const scalar = all.filter(f => !f.components.length && !/azimuth|radius/.test(f.name) && fieldValues(show, f, 0).known.some(s => known.includes(s)));
  const which = make('select', { 'aria-label': 'Field' }, ...scalar.map((f, i) => make('option', { value: i }, withUnit(f.name, f.unit)))), area = make('div');
  // the pictures of the last turn: back from the last one until a station has gone round
  let first = n - 1, turned = 0, most = 0;
  for (; first > 0 && turned < 360; --first) { const step = Math.abs((fieldValues(show, azimuth, first).values[0] - fieldValues(show, azimuth, first - 1).values[0] + 540) % 360 - 180); turned += step; most = Math.max(most, step); }
  const start = scalar.findIndex(f => f.name === 'angle of attack');
  which.value = Math.max(0, start);
  root.append(make('div', { class: 'row' }, which, make('span', { class: 'soft' }, 'from the pictures of the last turn; azimuth as the inflow counts it')), area);
  const draw = () => {
    emptied(area);
    const f = scalar[which.value], cells = [];
    for (let k = first; k < n; ++k) {
      const a = fieldValues(show, azimuth, k), r = fieldValues(show, radius, k), v = fieldValues(show, f, k), at = new Map(), bySurface = new Map();
      for (let i = 0; i < r.known.length; ++i) at.set(r.known[i], [r.values[i]]);
      for (let i = 0; i < v.known.length; ++i) at.get(v.known[i])?.push(v.values[i]);
      for (let i = 0; i < a.known.length; ++i) { const [rr, vv] = at.get(a.known[i]) ?? [], o = object[a.known[i]]; if (vv !== undefined) (bySurface.get(o) ?? bySurface.set(o, []).get(o)).push([a.values[i], rr, vv]); }
      for (const list of bySurface.values()) { // each station stands for what lies nearer to it than to its neighbours
        list.sort((p, q) => p[1] - q[1]);
        list.forEach((c, i) => cells.push([...c, (c[1] + (list[i - 1]?.[1] ?? c[1])) / 2, (c[1] + (list[i + 1]?.[1] ?? c[1])) / 2]));
      }
    }
    diskMap(area, withUnit(f.name, f.unit), cells, f.unit === '1' ? '' : f.unit, mapColour, most).draw();
  };
  which.onchange = draw;
  draw();
}

// -------------------------------------------------------------------------------------------------------- comparison

function comparePanel(root) {
  const [a, b] = results, dash = [6, 4];
  root.append(make('p', {}, `Full lines: ${a.title} (${a.name}). Dashed: ${b.title} (${b.name}).`));
  const ta = a.tables.dynamic, tb = b.tables.dynamic;
  if (ta && tb) {
    const common = ta.names.filter((n, i) => i && tb.names.includes(n) && !ta.isText(i)), x = Float64Array.from(new Set([...ta.column(0), ...tb.column(0)])).sort();
    const on = (t, y) => { const own = t.column(0); let k = 0; return Array.from(x, v => { while (k < own.length - 2 && own[k + 1] < v) ++k; if (v < own[0] || v > own[own.length - 1]) return null; const u = own.length > 1 ? (v - own[k]) / (own[k + 1] - own[k] || 1) : 0; return own.length > 1 ? y[k] + u * (y[k + 1] - y[k]) : y[k]; }); };
    root.append(make('h2', {}, 'Histories of the same name, at the times of both'));
    for (const name of common.slice(0, 24)) { const ya = on(ta, ta.named(name)), yb = on(tb, tb.named(name)); let most = 0; ya.forEach((v, i) => { if (v !== null && yb[i] !== null) most = Math.max(most, Math.abs(v - yb[i])); }); timePlot(root, `${withUnit(name, ta.unitOf(name))}: largest difference ${short(most, 4)}`, x, 'time [s]', [{ name: a.name, y: ya }, { name: b.name, y: yb, dash }], { height: 150 }); }
    const only = [...ta.names.filter(n => !tb.names.includes(n)).map(n => `${n} (${a.name})`), ...tb.names.filter(n => !ta.names.includes(n)).map(n => `${n} (${b.name})`)];
    if (only.length) root.append(make('p', { class: 'soft' }, 'In one of them only: ' + only.join(', ')));
  }
  for (const name of Object.keys(a.tables)) {
    const p = a.tables[name], q = b.tables[name];
    if (!q || name === 'dynamic' || /_energy|_steps/.test(name) || p.kept > 60 || q.kept > 60) continue;
    const cols = p.names.map((_, i) => i).filter(i => q.names.includes(p.names[i]) && !p.isText(i)), rows = [];
    for (let r = 0; r < Math.max(p.kept, q.kept); ++r) rows.push(make('tr', {}, ...cols.flatMap(i => [p.column(i)[r], q.named(p.names[i])[r]].map((v, k) => make('td', { class: k ? 'soft' : '' }, v === undefined ? '' : short(v, 6))))));
    root.append(make('h2', {}, name), make('div', { class: 'wide' }, make('table', {}, make('thead', {}, make('tr', {}, ...cols.flatMap(i => [a.name, b.name].map((n, k) => make('th', {}, `${withUnit(p.names[i], p.units[i])} ${k ? '²' : '¹'}`))))), make('tbody', {}, ...rows))));
  }
  root.append(make('h2', {}, 'Entries that differ'));
  const lines = t => { const path = [], out = new Map(); for (const line of t.split('\n')) { const w = line.trim(); if (w.startsWith('subsection ')) path.push(w.slice(11)); else if (w === 'end') path.pop(); else if (w.startsWith('set ')) { const k = w.indexOf('='); out.set([...path, w.slice(4, k).trim()].join(' / '), w.slice(k + 1).trim()); } } return out; };
  const la = lines(a.used), lb = lines(b.used), differ = [...new Set([...la.keys(), ...lb.keys()])].filter(k => la.get(k) !== lb.get(k));
  root.append(differ.length ? make('div', { class: 'wide' }, make('table', { id: 'differ' }, make('thead', {}, make('tr', {}, ...['entry', a.name, b.name].map(n => make('th', {}, n)))), make('tbody', {}, ...differ.slice(0, 300).map(k => make('tr', {}, make('td', { class: 't' }, k), make('td', { class: 't' }, la.get(k) ?? '–'), make('td', { class: 't' }, lb.get(k) ?? '–')))))) : make('p', {}, 'None.'));
}

// ------------------------------------------------------------------------------------------------- tables and texts

/** Rows by what stands in a column, in the order in which it comes first. */
function grouped(column, n) {
  const by = new Map();
  for (let i = 0; i < n; ++i) (by.get(column?.[i] ?? '') ?? by.set(column?.[i] ?? '', []).get(column?.[i] ?? '')).push(i);
  return [...by];
}

/** Errors of the members of a study, of those that have one above zero: of each method or level one curve. */
function errorChart(root, t, what) {
  const x = t.named(what), e = t.named('error'), wanted = t.named('tolerance');
  if (!x || !e || Array.isArray(x) || Array.isArray(e)) return;
  const has = i => x[i] > 0 && e[i] > 0, curves = grouped(t.named('method') || t.named('level'), t.kept).map(([k, all]) => { const r = all.filter(has); return { name: String(k), x: r.map(i => x[i]), y: r.map(i => e[i]), line: true, dots: true }; }).filter(c => c.x.length);
  if (!curves.length) return;
  const xs = curves.flatMap(c => c.x);
  if (wanted?.[0] > 0) curves.push({ name: 'tolerance', x: [Math.min(...xs), Math.max(...xs)], y: [wanted[0], wanted[0]], line: true, dash: [4, 4] });
  chart(root, `Error against ${what}`, withUnit(what, t.unitOf(what)), 'error', curves, { log: true });
}

/** Amplitudes of the harmonics of one quantity, along each of its axes. */
function harmonicsChart(root, t) {
  const quantity = t.named('quantity'), axes = t.named('axes'), unit = t.named('unit'), n = t.named('harmonic'), a = t.named('amplitude');
  if (!quantity || !n || !a) return;
  const all = grouped(quantity, t.kept), which = make('select', { 'aria-label': 'Quantity' }, ...all.map(([q], i) => make('option', { value: i }, q))), area = make('div');
  root.append(make('div', { class: 'row' }, which), area);
  const draw = () => {
    emptied(area);
    const [q, rows] = all[which.value], u = unit?.[rows[0]];
    const curves = grouped(Array.isArray(axes) ? axes : null, t.kept).map(([axis, r]) => { const own = r.filter(i => quantity[i] === q); return { name: String(axis || q), x: own.map(i => n[i]), y: own.map(i => a[i]), stems: true, dots: true }; }).filter(c => c.x.length);
    chart(area, `Amplitudes of ${q}; 0: the mean`, 'harmonic', withUnit('amplitude', u || ''), curves, { from0: true }).draw();
  };
  which.onchange = draw;
  draw();
}

const tableCharts = {
  study: (root, t) => errorChart(root, t, 'unknowns'),
  study_ladder: (root, t) => { errorChart(root, t, 'cost'); errorChart(root, t, 'unknowns'); },
  harmonics: harmonicsChart,
  trim_history: (root, t) => { const x = t.column(0), some = ['periodicity', 'miss'].filter(n => t.named(n)); if (x.length > 1 && some.length) chart(root, 'What is left', withUnit(t.names[0], t.units[0]), 'part', some.map(n => ({ name: n, x, y: t.named(n), line: true, dots: true })), { logy: true }); },
};

function tablePanel(name) {
  return root => {
    const t = table(name);
    tableCharts[name]?.(root, t);
    // sections and their stresses have a mesh that can be seen
    const drawn = { stresses: t.named('place'), sections: t.named('section') ?? t.named('name') }[name], showOf = i => result.shows.find(s => s.name === `${name === 'stresses' ? 'stresses' : 'section'} ${drawn[i]}`);
    const onset = name === 'dynamic_stops' && t.named('onset'), toTime = i => ({ class: 'pick', tabindex: 0, title: 'Show its onset', onclick: () => clock.drag(onset[i]), onkeydown: e => e.key === 'Enter' && clock.drag(onset[i]) });
    root.append(...htmlTable(t, drawn && Array.isArray(drawn) ? { row: i => rowOf(showOf(i)) } : onset ? { row: toTime } : {}));
  };
}

function valuesPanel(root) {
  const t = table('static');
  root.append(make('table', {}, make('tbody', {}, ...t.names.map((p, i) => make('tr', {}, make('td', {}, p), make('td', { 'data-probe': p, 'data-value': t.column(i)[0] }, short(t.column(i)[0], 9)), make('td', { class: 't soft' }, t.units[i]))))));
}

function modelPanel(root) {
  const summary = table('summary'), objects = S.show?.model.objects ?? [];
  if (summary) root.append(make('h2', {}, 'Sizes and times'), ...htmlTable(summary));
  const list = make('div');
  objects.forEach((o, i) => list.append(make('span', { class: 'chip', role: 'button', 'data-object': i, tabindex: 0, title: `${o[1]}, ${o[2]}`, onclick: () => select(i), onkeydown: e => e.key === 'Enter' && select(i) }, o[0])));
  if (objects.length) root.append(make('h2', {}, 'What is drawn'), list);
  root.append(make('h2', {}, 'The model as it was used'));
  let now = null;
  for (const line of result.used.split('\n')) {
    if (/^subsection /.test(line)) { now = make('pre'); root.append(make('details', {}, make('summary', {}, line.slice(11)), now)); }
    if (!now) { root.append(make('pre', {}, line)); continue; }
    now.append(line + '\n');
    if (/^end/.test(line)) now = null;
  }
}

function messagesPanel(root) {
  for (const n of result.notes) root.append(make('p', {}, 'Page: ' + n));
  if (result.message) root.append(make('pre', { class: 'bad' }, result.message));
  const pre = make('pre');
  for (const line of result.log.split('\n')) pre.append(/(^|: )(warning|error):/i.test(line) ? make('mark', {}, line) : line, '\n');
  root.append(pre);
}

/** All panels of a result. @p show: what a chosen row or point shows. */
export function build(all, of, show) {
  results = all; result = of; showIt = show;
  plots.length = 0; panels.length = 0;
  byId('panels').replaceChildren(); byId('tabs').replaceChildren();
  if (results.length > 1) panel('compare', comparePanel);
  const title = { dynamic: 'histories', static: 'load steps', static_speeds: 'speeds', static_path: 'path' }, titles = { dynamic_stops: 'stops', study_ladder: 'ladder' };
  for (const name of ['dynamic', 'static', 'static_speeds', 'static_path']) if (table(name)?.rows > 1 && table(name).names.length > 1) panel(title[name], historyPanel(name));
  if (table('static')?.rows === 1 && table('static').names.length > 1) panel('static', valuesPanel);
  if (Object.keys(result.tables).some(n => /^modes(_|$)/.test(n))) panel('modes', modesPanel);
  if (table('fan')?.rows) panel('fan', fanPanel('fan'));
  if (table('floquet_speeds')?.rows) panel('stability', fanPanel('floquet_speeds'));
  if (table('floquet')) panel('floquet', root => root.append(...htmlTable(table('floquet'), { row: i => rowOf(result.shows.find(s => s.name === 'floquet_' + (i + 1))) })));
  if (result.shows.some(s => s.name === 'dynamic' && fieldsOf(s).some(f => f.name === 'azimuth'))) panel('rotor maps', mapsPanel);
  if (table('dynamic_energy')?.rows > 1) panel('energy', energyPanel);
  if (table('dynamic_steps')?.rows > 1) panel('steps', stepsPanel);
  const shown = new Set(['dynamic', 'static', 'static_speeds', 'static_path', 'fan', 'floquet_speeds', 'floquet', 'dynamic_energy', 'dynamic_steps', 'summary']);
  for (const name of Object.keys(result.tables)) if (!shown.has(name) && !/^modes(_|$)/.test(name) && table(name).rows) panel(titles[name] ?? name.replaceAll('_', ' '), tablePanel(name));
  if (result.used || S.show) panel('model', modelPanel);
  panel('messages', messagesPanel);
  for (const p of panels) { p.tab = make('button', { role: 'tab', 'aria-controls': p.root.id, onclick: () => open(p.name) }, p.name); byId('tabs').append(p.tab); }
  open(panels[0].name);
}

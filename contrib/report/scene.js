// The drawing: what is shown, how it is coloured, arrows, names, tracks and orbits.
import { byId, make, read, short, unpackRow } from './data.js';
import { View } from './view.js';
import { nFrames, nSamples, partsOf, place, rigidly, segmentOf } from './place.js';

export const css = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
export const dark = () => document.documentElement.classList.contains('dark');
export const rgb = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16) / 255);

/** What the reader chose. */
export const S = { show: null, frame: 0, phase: 0, periods: 0, factor: 1, colour: 'kind', component: -1, vectors: '', names: false, orbits: true, ownRange: false, playing: false, selected: -1 };

/** What belongs to the model that is drawn: places, turns and colours of its samples. */
export let G = null;
export let view = null;
let box = [0, 0, 0, 1, 1, 1], gridStep = 1;

const KIND = {
  'Bodies/beam': ['#5b8fc7', '#7fb2ea'], 'Bodies/rigid body': ['#8b95a0', '#a9b3bd'], 'Bodies/shell': ['#4f9f98', '#6fc7be'],
  'Joints/rigid': ['#8b95a0', '#a9b3bd'], Joints: ['#d98d2b', '#f0ad55'], Surfaces: ['#9a86c9', '#b8a5e6'], Inflows: ['#9ec9dc', '#6f97aa'], Contacts: ['#b08968', '#caa27f'],
};
const MAP = [[0.267, 0.005, 0.329], [0.283, 0.141, 0.458], [0.254, 0.265, 0.53], [0.207, 0.372, 0.553], [0.164, 0.471, 0.558], [0.128, 0.567, 0.551], [0.135, 0.659, 0.518], [0.267, 0.749, 0.441], [0.478, 0.821, 0.318], [0.741, 0.873, 0.15], [0.993, 0.906, 0.144]];
export function mapColour(u) { // viridis
  const x = Math.min(Math.max(u, 0), 1) * (MAP.length - 1), i = Math.min(MAP.length - 2, Math.floor(x)), f = x - i;
  return [0, 1, 2].map(k => MAP[i][k] + f * (MAP[i + 1][k] - MAP[i][k]));
}
const FINE_MAP = Array.from({ length: 256 }, (_, i) => mapColour(i / 255));
const kindColour = ([, room, kind]) => rgb((KIND[`${room}/${kind}`] || KIND[room] || ['#8b95a0', '#a9b3bd'])[dark() ? 1 : 0]);

// ------------------------------------------------------------------------------------------------------------ model

/** Takes the model of a show for that which is drawn. */
function useModel(model) {
  if (G?.model === model) return;
  const n = nSamples(model), f3 = () => new Float32Array(3 * n), f4 = () => new Float32Array(4 * n);
  const local = read(model.local).slice(), sample = read(model.sample), objectOf = read(model.object);
  const reach = new Float32Array(n), symbol = new Float32Array(n);
  for (let i = 0; i < sample.length; ++i) reach[sample[i]] = Math.max(reach[sample[i]], Math.hypot(local[3 * i], local[3 * i + 1], local[3 * i + 2]));
  const largest = new Map();
  for (let s = 0; s < n; ++s) if (model.objects[objectOf[s]][1] === 'Joints') largest.set(objectOf[s], Math.max(largest.get(objectOf[s]) ?? 0, reach[s]));
  // symbols have a size in metres: of a small model they are drawn smaller, but not those that are as large as they are
  const P = read(model.place), size = Math.hypot(...[0, 1, 2].map(k => { let low = Infinity, high = -Infinity; for (let s = 0; s < n; ++s) { const r = largest.has(objectOf[s]) ? 0 : reach[s]; low = Math.min(low, P[3 * s + k] - r); high = Math.max(high, P[3 * s + k] + r); } return high - low; }));
  const isReal = o => /rolling|contact|slid|curve|spring|distance/.test(model.objects[o][2]), shrunk = o => largest.has(o) && !isReal(o) && size > 0 ? Math.min(1, 0.03 * size / largest.get(o)) : 1;
  for (let i = 0; i < sample.length; ++i) { const k = shrunk(objectOf[sample[i]]); for (let d = 0; d < 3 && k < 1; ++d) local[3 * i + d] *= k; }
  for (let s = 0; s < n; ++s) reach[s] *= shrunk(objectOf[s]);
  for (const [o, most] of largest) largest.set(o, most * shrunk(o));
  // of what reaches from body to body, springs, rods and arms, the thickness grows a little
  const isLong = o => /spring|distance|rigid/.test(model.objects[o][2]);
  for (let s = 0; s < n; ++s) { const most = largest.get(objectOf[s]); symbol[s] = !most ? 0 : !isLong(objectOf[s]) && reach[s] > 0.25 * most ? most : 5 * reach[s]; }
  // beams that carry wings are drawn thin within these, unless it is they that are coloured
  const carrier = read(model.carrier), covered = new Set();
  for (let s = 0; s < n; ++s) if (model.objects[objectOf[s]][1] === 'Surfaces' && carrier[s] >= 0 && model.objects[carrier[s]][2] === 'beam') covered.add(carrier[s]);
  G = null;
  view?.release();
  view = new View(byId('view'), { local, sample, place: read(model.place), turn: read(model.turn), quads: read(model.quads), lines: read(model.lines) });
  G = { model, n, sample, local, objectOf, place: f3(), turn: f4(), colours: f3(), scratch: { P: f3(), Q: f4() }, reach, symbol, covered, firstOf: null };
  G.objectColours = model.objects.map(kindColour);
  byId('names').replaceChildren();
}

export const times = () => S.show && S.show.kind !== 'shape' ? S.show.times : null;
export const isTime = () => S.show?.name === 'dynamic';

export function update() {
  if (!G || !S.show) return;
  place(S.show, S, G.place, G.turn, G.scratch);
  paint(); arrows(); orbits(); label();
}

// ----------------------------------------------------------------------------------------------------------- fields

const derived = [
  { name: 'displacement', unit: 'm', components: ['x', 'y', 'z'], of: 'reference' },
  { name: 'deformation', unit: 'm', components: ['x', 'y', 'z'], of: 'rigid' },
];

/** A section's mesh is no part of the model: it is seen flat, along axis 1. */
export const isSection = show => show.kind === 'frames' && !show.model.objects.some(o => o[1]);

/** Fields of a show: those of the run, and how far a sample is from where it was, and from where it were if it was rigid. */
export function fieldsOf(show) {
  if (show.kind !== 'frames') return [];
  if (isSection(show)) return show.segments[0].fields;
  return [...show.segments[show.segments.length - 1].fields, ...derived];
}

/** Values of a field in a picture: {known, values, n}, n numbers for each known sample. */
export function fieldValues(show, field, frame) {
  const n = field.components.length || 1;
  if (field.of) {
    const N = nSamples(show.model), known = Uint32Array.from({ length: N }, (_, i) => i), values = new Float32Array(3 * N), P = new Float32Array(3 * N), Q = new Float32Array(4 * N);
    place(show, { frame, factor: 1 }, P, Q, { P: new Float32Array(3 * N), Q: new Float32Array(4 * N) });
    let from = read(show.model.place);
    if (field.of === 'rigid') { from = new Float32Array(3 * N); rigidly(show, frame, from, Q); }
    for (let i = 0; i < values.length; ++i) values[i] = P[i] - from[i];
    return { known, values, n };
  }
  const [segment, row] = segmentOf(show, frame), own = segment.fields.find(f => f.name === field.name);
  if (!own) return { known: new Uint32Array(), values: new Float32Array(), n };
  const known = read(own.known);
  return { known, values: unpackRow(own.values, row, new Float32Array(known.length * n)), n };
}

/** The number that is shown of one sample: a component, or the size. */
function shown(values, i, n, component) {
  if (n === 1) return values[i];
  if (component >= 0 && component < n) return values[n * i + component];
  let sum = 0;
  for (let d = 0; d < n; ++d) sum += values[n * i + d] ** 2;
  return Math.sqrt(sum);
}

const ranges = new Map();
/** Least and largest over all pictures, so that colours and arrows can be compared between them. */
export function rangeOf(show, field, component) {
  const key = `${field.name} ${component}`, of = ranges.get(show) ?? ranges.set(show, new Map()).get(show);
  if (!of.has(key)) {
    let low = Infinity, high = -Infinity;
    const n = nFrames(show), every = Math.max(1, Math.floor(n / 400));
    for (let k = 0; k < n; k += every) {
      const f = fieldValues(show, field, k);
      for (let i = 0; i < f.known.length; ++i) { const v = shown(f.values, i, f.n, component); low = Math.min(low, v); high = Math.max(high, v); }
    }
    of.set(key, [low, high]);
  }
  return of.get(key);
}

export const field = () => S.show?.kind === 'frames' ? fieldsOf(S.show).find(f => f.name === S.colour) : undefined;

export function paint() {
  if (!G || !S.show) return;
  const f = field(), c = G.colours;
  G.shown = null;
  if (f) {
    const v = fieldValues(S.show, f, S.frame), value = new Float32Array(G.n).fill(NaN);
    for (let i = 0; i < v.known.length; ++i) value[v.known[i]] = shown(v.values, i, v.n, S.component);
    let [low, high] = S.ownRange ? value.reduce(([a, b], x) => Number.isNaN(x) ? [a, b] : [Math.min(a, x), Math.max(b, x)], [Infinity, -Infinity]) : rangeOf(S.show, f, S.component);
    const isOne = !(high > low);
    if (isOne) high = low + (Math.abs(low) || 1) * 1e-12;
    G.range = [low, high, isOne]; G.shown = value;
    const unknown = dark() ? [0.4, 0.42, 0.44] : [0.72, 0.74, 0.76];
    for (let s = 0; s < G.n; ++s) c.set(Number.isNaN(value[s]) ? unknown : FINE_MAP[Math.max(0, Math.min(255, Math.round(255 * (value[s] - low) / (high - low))))], 3 * s);
  } else for (let s = 0; s < G.n; ++s) c.set(G.objectColours[G.objectOf[s]], 3 * s);
  if (S.selected >= 0 && !f) { const k = rgb(css('--accent')); for (let s = 0; s < G.n; ++s) if (G.objectOf[s] === S.selected) c.set(k, 3 * s); }
  const isThin = !f || G.shown.some((v, s) => !Number.isNaN(v) && G.model.objects[G.objectOf[s]][1] === 'Surfaces');
  for (let s = 0; s < G.n; ++s) if (G.covered.has(G.objectOf[s])) G.symbol[s] = isThin ? -0.12 : 0;
  view.setSamples(f ? withoutUnknown(G.shown) : G.place, G.turn, c, G.symbol);
  legend(f);
}

/** Places with all stations of a shell without a value at one, if it is its layers that have one, or the other way. */
function withoutUnknown(value) {
  const first = new Map(), known = new Set(), P = Float32Array.from(G.place), name = o => G.model.objects[o][0];
  for (let s = 0; s < G.n; ++s) if (!Number.isNaN(value[s])) known.add(name(G.objectOf[s]));
  for (let s = 0; s < G.n; ++s) {
    const o = G.objectOf[s];
    if (known.has(name(o)) || !(known.has(name(o) + ' layers') || known.has(name(o).replace(/ layers$/, '')))) continue;
    if (!first.has(o)) first.set(o, s);
    for (let i = 0; i < 3; ++i) P[3 * s + i] = G.place[3 * first.get(o) + i];
  }
  return P;
}

function legend(f) {
  const root = byId('legend'), parts = [];
  root.hidden = !f;
  if (f) {
    const canvas = make('canvas', { width: 1, height: 128 }), x = canvas.getContext('2d');
    for (let i = 0; i < 128; ++i) { x.fillStyle = `rgb(${mapColour(1 - i / 127).map(u => Math.round(255 * u))})`; x.fillRect(0, i, 1, 1); }
    const what = f.components.length === 0 ? '' : S.component >= 0 ? ' ' + f.components[S.component] : ', size';
    parts.push(`${f.name}${what} [${f.unit || '1'}]`, make('br'), G.range[2] ? 'everywhere ' : short(G.range[1], 4), G.range[2] ? '' : make('br'), G.range[2] ? '' : canvas, make('br'), short(G.range[0], 4), make('br'),
      make('button', { title: 'Range of the colours', onclick: () => { S.ownRange = !S.ownRange; paint(); } }, S.ownRange ? 'this picture' : 'all pictures'));
  }
  root.replaceChildren(...parts);
}

// ----------------------------------------------------------------------------------------------------------- arrows

export const vectorFields = () => S.show?.kind === 'frames' ? fieldsOf(S.show).filter(f => f.components.join('') === 'xyz') : [];

/** Corners of the triangles of an arrow: a bar of four sides and a head of six. */
function addArrow(out, p, v, radius) {
  const length = Math.hypot(...v), d = v.map(x => x / length), k = Math.abs(d[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  let e = cross(d, k); const l = Math.hypot(...e); e = e.map(x => x / l);
  const f = cross(d, e), head = Math.min(5 * radius, 0.5 * length);
  const ring = (at, r, n) => Array.from({ length: n }, (_, i) => { const a = 2 * Math.PI * i / n, c = r * Math.cos(a), s = r * Math.sin(a); return [0, 1, 2].map(i2 => p[i2] + at * d[i2] + c * e[i2] + s * f[i2]); });
  const a = ring(0, radius, 4), b = ring(length - head, radius, 4), c = ring(length - head, 2.6 * radius, 6), tip = [0, 1, 2].map(i => p[i] + v[i]);
  for (let i = 0; i < 4; ++i) { const j = (i + 1) % 4; out.push(...a[i], ...a[j], ...b[j], ...a[i], ...b[j], ...b[i]); }
  for (let i = 0; i < 6; ++i) out.push(...c[i], ...c[(i + 1) % 6], ...tip);
}

/** Arrows of the chosen field: the longest of all pictures is a fifth of the model. */
function arrows() {
  const f = vectorFields().find(x => x.name === S.vectors);
  G.arrowLegend = null; G.arrows = [];
  if (!f) { view.setArrows(null); return; }
  const [, largest] = rangeOf(S.show, f, -1), scale = largest > 0 ? 0.4 * view.radius / largest : 0, v = fieldValues(S.show, f, S.frame), out = [], radius = 0.004 * view.radius * Math.min(1, Math.sqrt(60 / v.known.length));
  let last = null;
  const every = Math.ceil(v.known.length / 2000); // more would hide each other
  for (let i = 0; i < v.known.length; i += every) {
    const s = v.known[i], w = [0, 1, 2].map(d => scale * v.values[3 * i + d]), p = [0, 1, 2].map(d => G.place[3 * s + d]);
    // samples of one place, and shorter ones than a thousandth of the longest, have no arrow of their own
    if (Math.hypot(...w) < 1e-3 * 0.4 * view.radius || (last && Math.hypot(...last.map((x, d) => x - p[d])) < 1e-9 * view.radius)) continue;
    addArrow(out, p, w, radius); last = p; G.arrows.push([s, ...w.map(x => x / scale)]);
  }
  view.setArrows(new Float32Array(out), [...rgb(dark() ? '#ff8091' : '#c8374d'), 1]);
  G.arrowLegend = `arrows: ${f.name}, the longest of all pictures is ${short(largest, 4)} ${f.unit || ''}`;
}

/** Orbits of a shape: of each body the station that moves most, with a head that says which way round. */
function orbits() {
  for (const name of Object.keys(view.plain)) if (name.startsWith('orbit')) view.setLines(name, null);
  G.orbits = 0;
  if (S.show.kind !== 'shape' || !S.orbits) return;
  const z = partsOf(S.show, 0), mean = read(S.show.mean), best = new Map();
  let most = 0;
  for (let s = 0; s < G.n; ++s) {
    if (G.model.objects[G.objectOf[s]][1] !== 'Bodies') continue;
    const a = z.subarray(12 * s, 12 * s + 6), size = Math.hypot(...a);
    most = Math.max(most, size);
    if (size > (best.get(G.objectOf[s])?.[1] ?? 0)) best.set(G.objectOf[s], [s, size]);
  }
  const lines = [], at = (s, phi) => [0, 1, 2].map(i => mean[7 * s + i] + S.factor * (Math.cos(phi) * z[12 * s + i] + Math.sin(phi) * z[12 * s + 3 + i]));
  for (const [s, size] of best.values()) {
    if (size < 0.05 * most) continue;
    ++G.orbits;
    for (let i = 0; i < 48; ++i) lines.push(...at(s, 2 * Math.PI * i / 48), ...at(s, 2 * Math.PI * (i + 1) / 48));
    const tip = at(s, 0.25), u = z.subarray(12 * s, 12 * s + 6), area = Math.hypot(u[1] * u[5] - u[2] * u[4], u[2] * u[3] - u[0] * u[5], u[0] * u[4] - u[1] * u[3]);
    if (area < 0.02 * size * size) continue; // to and fro: no way round
    const back = at(s, -0.05), middle = mean.subarray(7 * s, 7 * s + 3);
    for (const k of [0.9, 1.1]) lines.push(...tip, ...back.map((x, i) => middle[i] + k * (x - middle[i])));
  }
  view.setLines('orbits', lines, [...rgb(dark() ? '#ffb84d' : '#b86e00'), 1]);
}

// ----------------------------------------------------------------------------------------------------- camera, names

function findBalls() {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity], balls = [], n = nFrames(S.show), every = Math.ceil(G.n / 4000), P = new Float32Array(3 * G.n), Q = new Float32Array(4 * G.n);
  for (const u of n > 1 ? [0, 0.2, 0.4, 0.6, 0.8, 1] : [0]) {
    place(S.show, { frame: Math.round(u * (n - 1)), phase: 0, periods: 0, factor: S.show.kind === 'frames' ? S.factor : 0 }, P, Q, G.scratch);
    for (let s = 0; s < G.n; ++s) {
      const p = P.slice(3 * s, 3 * s + 3);
      if (s % every === 0) balls.push([...p, G.reach[s]]);
      for (let k = 0; k < 3; ++k) { low[k] = Math.min(low[k], p[k] - G.reach[s]); high[k] = Math.max(high[k], p[k] + G.reach[s]); }
    }
  }
  box = [...low, ...high];
  return balls;
}

function drawGrid() {
  const r = view.radius, raw = 0.24 * r, p = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map(k => k * p).find(k => k >= 0.7 * raw), n = 9;
  const [cx, cy] = [0, 1].map(k => Math.round((box[k] + box[k + 3]) / 2 / step) * step), z = box[2] - 0.03 * r, lines = [];
  for (let i = -n; i <= n; ++i) lines.push(cx + i * step, cy - n * step, z, cx + i * step, cy + n * step, z, cx - n * step, cy + i * step, z, cx + n * step, cy + i * step, z);
  view.setLines('grid', lines, [...rgb(dark() ? '#333c44' : '#c9d1d8'), 1]);
  gridStep = step;
  const l = 0.15 * r;
  [['x', [l, 0, 0], '#d1495b'], ['y', [0, l, 0], '#2a9d5c'], ['z', [0, 0, l], '#3b7dd8']].forEach(([name, e, colour]) => view.setLines(name, [0, 0, 0, ...e], [...rgb(colour), 1]));
}

export function fit(direction) {
  if (!G) return;
  const balls = findBalls();
  G.arrows = null; // their length follows the view
  if (direction) view.look(direction);
  view.size();
  view.target = [0, 1, 2].map(k => (box[k] + box[k + 3]) / 2);
  view.fit(balls);
  drawGrid(); update();
}

export function pick(event) {
  const r = byId('view').getBoundingClientRect(), s = view.pick(event.clientX - r.left, event.clientY - r.top);
  return s < 0 ? null : { sample: s, object: G.objectOf[s] };
}

export function hover(event) {
  const name = byId('name');
  if (event.buttons) { name.hidden = true; return; }
  const hit = pick(event);
  name.hidden = !hit; byId('view').style.cursor = hit ? 'pointer' : '';
  if (!hit) return;
  const [word, room, kind] = G.model.objects[hit.object], r = byId('scene').getBoundingClientRect(), f = field();
  const lines = [make('b', {}, word), ' ', make('small', {}, kind || room)];
  if (f && !Number.isNaN(G.shown[hit.sample])) lines.push(`\n${f.name}: ${short(G.shown[hit.sample], 5)} ${f.unit}`);
  lines.push(make('small', {}, `\n(${[0, 1, 2].map(i => short(G.place[3 * hit.sample + i], 4)).join(', ')}) m`));
  name.replaceChildren(...lines);
  name.style.left = Math.min(event.clientX - r.left + 14, r.width - name.offsetWidth - 6) + 'px';
  name.style.top = Math.min(event.clientY - r.top + 14, r.height - name.offsetHeight - 6) + 'px';
}

/** Names of all objects beside them, as long as they do not overlap. */
export function names() {
  const root = byId('names');
  root.hidden = !S.names;
  if (!S.names) return;
  if (!root.children.length) {
    G.firstOf = G.model.objects.map(() => []);
    for (let s = 0; s < G.n; ++s) G.firstOf[G.objectOf[s]].push(s);
    root.replaceChildren(...G.model.objects.map(o => make('span', { class: o[1] }, o[0])));
    G.widths = [...root.children].map(e => e.offsetWidth);
  }
  const taken = [];
  [...root.children].forEach((e, o) => {
    const list = G.firstOf[o];
    if (!list.length) { e.hidden = true; return; }
    const s = list[list.length >> 1], [x, y, z] = view.seen(G.place.subarray(3 * s, 3 * s + 3)), w = G.widths[o] + 4;
    const free = z < 1 && x > 0 && y > 40 && !taken.some(t => Math.abs(t[0] - x) < (t[2] + w) / 2 && Math.abs(t[1] - y) < 19);
    e.hidden = !free;
    if (free) { taken.push([x, y, w]); e.style.transform = `translate(${Math.round(x - w / 2)}px,${Math.round(y - 9)}px)`; }
  });
}

/** Selects an object, or none; the track of the sample over all pictures is drawn. */
export function select(object, sample = -1) {
  S.selected = S.selected === object ? -1 : object;
  view?.setLines('track', null);
  if (S.selected >= 0 && sample >= 0 && S.show.kind === 'frames' && nFrames(S.show) > 2) {
    const n = nFrames(S.show), points = new Float32Array(3 * n), row = new Float32Array(3 * G.n);
    for (let t = 0; t < n; ++t) { const [part, k] = segmentOf(S.show, t); points.set(unpackRow(part.places, k, row).subarray(3 * sample, 3 * sample + 3), 3 * t); }
    view.setLines('track', points, [...rgb(dark() ? '#ff8091' : '#c8374d'), 1], true);
  }
  paint();
  for (const e of document.querySelectorAll('[data-object]')) e.style.borderColor = +e.dataset.object === S.selected ? css('--accent') : '';
}

export const style = () => ({ plain: !!field(), edges: view.edges.n < 60000, edge: dark() ? [0, 0, 0, 0.5] : [0, 0, 0, 0.32], wire: dark() ? [0.62, 0.66, 0.7, 1] : [0.35, 0.4, 0.45, 1] });

function label() {
  const note = [`grid ${short(gridStep, 3)} m`];
  if (G.arrowLegend) note.push(G.arrowLegend);
  if (S.show.kind === 'frames' && S.factor !== 1) note.push(`deformation × ${short(S.factor)}, about the rigid motion of each body`);
  if (S.show.kind !== 'frames') note.push(`amplitude × ${short(S.factor)}; 1: a twentieth of the model`);
  if (S.show.kind === 'shape' && S.orbits && G.orbits) note.push('ellipses: orbits of the stations that move most, heads: which way round');
  byId('note').textContent = note.join('\n');
  const t = times();
  byId('time').textContent = isSection(S.show) ? '' : S.show.kind === 'shape' ? `phase ${Math.round(S.phase * 180 / Math.PI) % 360}°` : S.show.kind === 'floquet' ? `${short(t[S.frame], 6)} s + ${S.periods} T` : isTime() ? `${short(t[S.frame], 6)} s` : S.show.name === 'static_speeds' ? `${short(t[S.frame], 6)} rad/s` : `${S.show.name} ${short(t[S.frame], 6)}`;
}

export function recolour() { if (G) { G.objectColours = G.model.objects.map(kindColour); drawGrid(); update(); } }

/** Shows a motion or a shape; the view is kept if it is the same model. */
export function useShow(show) {
  S.show = show; S.phase = 0; S.periods = 0; S.factor = 1;
  useModel(show.model);
  view.setLines('track', null);
}

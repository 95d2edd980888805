// What the page was given: JSON in its head, and streams of arrays. Nothing is fetched.

export const byId = id => document.getElementById(id);

/** An element with attributes (class, on... for events) and children; null children are left out. */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (name === 'class') element.className = value;
    else if (value !== false && value !== undefined) element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.filter(c => c !== null && c !== undefined));
  return element;
}

/** A number for people. */
export function short(x, digits = 5) {
  if (!Number.isFinite(x)) return '–';
  if (x === 0) return '0';
  const size = Math.abs(x);
  return size >= 1e6 || size < 1e-4 ? x.toExponential(digits - 1).replace(/\.?0*e\+?/, 'e') : String(+x.toPrecision(digits));
}

export const withUnit = (name, unit) => unit && unit !== '1' ? `${name} [${unit}]` : name;

const KINDS = { f4: Float32Array, f8: Float64Array, i2: Int16Array, u2: Uint16Array, u4: Uint32Array, u1: Uint8Array };
const buffers = [];

/** The numbers of an array; bytes of equal weight stand together in the stream. */
export function read(entry) {
  if (entry.values) return entry.values;
  const Kind = KINDS[entry.k], size = Kind.BYTES_PER_ELEMENT, n = entry.s.reduce((a, b) => a * b, 1);
  const from = new Uint8Array(buffers[entry.stream], entry.o, n * size), to = new Uint8Array(n * size);
  for (let b = 0; b < size; ++b) for (let i = 0, j = b, k = b * n; i < n; ++i, j += size, ++k) to[j] = from[k];
  Object.defineProperty(entry, 'values', { value: new Kind(to.buffer) });
  return entry.values;
}

/** A row of numbers that are packed in two bytes each, some in three, column behind column. */
export function unpackRow(packed, row, out) {
  const q = read(packed.q), low = read(packed.low), step = read(packed.step), n = low.length, rows = packed.q.s[1];
  for (let i = 0, k = row; i < n; ++i, k += rows) out[i] = low[i] + step[i] * (q[k] + 32768);
  if (packed.fine) {
    const fine = read(packed.fine), of = read(packed.of);
    for (let j = 0; j < of.length; ++j) { const i = of[j]; out[i] = low[i] + step[i] * (q[i * rows + row] + 32768 + fine[j * rows + row] / 256); }
  }
  return out;
}

async function inflate(element) {
  const text = element.textContent;
  const bytes = Uint8Array.fromBase64 ? Uint8Array.fromBase64(text) : Uint8Array.from(atob(text), c => c.charCodeAt(0));
  element.remove();
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'))).arrayBuffer();
}

/** Each array knows its stream. */
function tag(value, stream) {
  if (!value || typeof value !== 'object') return;
  if (value.k !== undefined && value.o !== undefined) { value.stream = stream; return; }
  for (const inner of Object.values(value)) tag(inner, stream);
}

/** Pictures of one motion, of a run and of those that it went on from: where the later begins the earlier ends. */
function joined(parts) {
  const last = parts[parts.length - 1], show = { ...last, segments: [] };
  parts.forEach((part, i) => {
    const times = Array.from(read(part.times)), next = i + 1 < parts.length ? read(parts[i + 1].times)[0] : Infinity;
    show.segments.push({ ...part, times: times.filter(t => t < next) });
  });
  show.times = Float64Array.from(show.segments.flatMap(s => s.times));
  return show;
}

function showsOf(result) {
  const shows = [], motions = new Map();
  for (const { data } of result.drawings)
    for (const show of data.shows) {
      const full = { ...show, result, model: data.models[show.model] };
      if (show.mean !== undefined) full.mean = data.means[show.mean];
      if (show.kind !== 'frames') {
        if (show.kind === 'floquet') full.times = read(show.times);
        shows.push(full);
        continue;
      }
      const alike = motions.get(show.name), objects = m => JSON.stringify(m.objects) + m.place.s[0];
      if (alike && objects(alike[0].model) === objects(full.model)) alike.push(full);
      else motions.set(alike ? show.name + ' ' + shows.length : show.name, [full]);
    }
  const order = { dynamic: 0, static: 1, static_speeds: 2 };
  const rank = s => s.kind === 'frames' ? order[s.name] ?? 7 : s.name.startsWith('free_motion') ? 6 : s.kind === 'floquet' ? 4 : s.main ? 3 : 5;
  const all = [...[...motions.values()].map(joined), ...shows];
  return all.map((show, i) => [rank(show), i, show]).sort((a, b) => a[0] - b[0] || a[1] - b[1]).map(x => x[2]);
}

/** What a table has: names, units and columns of numbers or words. */
function tableOf(raw) {
  return {
    rows: raw.rows, kept: raw.kept, names: raw.columns.map(c => c[0]), units: raw.columns.map(c => c[1]),
    column: i => Array.isArray(raw.columns[i][2]) ? raw.columns[i][2] : read(raw.columns[i][2]),
    isText: i => Array.isArray(raw.columns[i][2]),
    named(name) { const i = this.names.indexOf(name); return i < 0 ? null : this.column(i); },
    unitOf(name) { return this.units[this.names.indexOf(name)] ?? ''; },
  };
}

/** The report, once its streams are inflated: results with title, state, tables, shows. */
export async function load() {
  const report = JSON.parse(byId('header').textContent);
  const elements = [...document.querySelectorAll('script[id^=data]')];
  if (!globalThis.DecompressionStream) throw new Error('it needs a browser of 2023 or later');
  for (const buffer of await Promise.all(elements.map(inflate)).catch(() => { throw new Error('its data are cut or damaged'); })) buffers.push(buffer);
  for (const result of report.results) {
    for (const drawing of result.drawings) tag(drawing.data, drawing.stream);
    tag(result.tables, result.stream);
    result.tables = Object.fromEntries(Object.entries(result.tables).map(([name, raw]) => [name, tableOf(raw)]));
    const last = result.drawings[result.drawings.length - 1]?.data ?? { state: 'done', message: '', progress: '', notes: [] };
    Object.assign(result, { state: last.state, message: last.message, progress: last.progress, written: last.written, period: last.period });
    result.notes = [...result.drawings.flatMap(d => d.data.notes), ...(result.earlier ?? []).map(n => `${n} is of an earlier run in this folder and is not shown`)];
    for (const [name, t] of Object.entries(result.tables))
      if (t.kept < t.rows) result.notes.push(`${name}.csv: ${t.kept} of ${t.rows} rows are kept, those with the least and the largest values, so that the page stays small`);
    const title = /^\s*set Title\s*=\s*(.*)$/m.exec(result.used);
    result.title = title?.[1].trim() || result.name;
    result.shows = showsOf(result);
  }
  return report;
}

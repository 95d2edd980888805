// Curves over time by uPlot, charts of two numbers by hand, spectra.
import uPlot from 'uplot';
import { make, short, withUnit } from './data.js';
import { css, dark } from './scene.js';

const PALETTE = {
  light: ['#1f5fa8', '#c8374d', '#1d8a50', '#b86e00', '#7b4fa3', '#0c8599', '#8c564b', '#5c6670'],
  dark: ['#6cb2ff', '#ff8091', '#5fd194', '#ffb84d', '#c39bea', '#4fd0e3', '#d3a28f', '#a8b2bc'],
};
export const colours = () => PALETTE[dark() ? 'dark' : 'light'];

export const plots = [];
export const isShown = p => p.root.isConnected && p.root.offsetParent !== null;
export const redrawCharts = () => { for (const p of plots) if (p.own && isShown(p)) p.draw(); };

/** One time for all: what is told when a plot is dragged. */
export const clock = { now: 0, drag: () => {}, stop: () => {} };

function ticksOfLog(u, i, low, high) {
  const a = Math.ceil(Math.log10(low) - 1e-9), b = Math.floor(Math.log10(high) + 1e-9), k = Math.max(1, Math.ceil((b - a) / 6)), out = [];
  for (let e = a; e <= b; e += k) out.push(10 ** e);
  // of less than two decades parts, too
  if (out.length < 2) for (let e = a - 1; e <= b; ++e) for (const m of [1, 2, 5]) if (m > 1 || e < a) out.push(m * 10 ** e);
  return out.filter(v => v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9)).sort((p, q) => p - q);
}

/** Series {name, y} over x, all of one unit; own: x is no time of the run. */
export function timePlot(parent, title, x, xLabel, series, options = {}) {
  const holder = make('div', { class: 'plot' }), values = make('div', { class: 'values' });
  parent.append(make('h2', {}, title), holder, values);
  const hidden = new Set(), spans = [], dots = [];
  let plot;
  const me = {
    root: holder, own: options.own, title, x, series,
    draw() {
      series.forEach((_, i) => (dots[i].style.background = colours()[i % 8]));
      plot?.destroy();
      const c = colours(), axis = { stroke: css('--soft'), grid: { stroke: css('--grid'), width: 1 }, ticks: { stroke: css('--grid'), width: 1 }, font: '12px system-ui,"DejaVu Sans"' };
      const line = u => { // of the time that is shown
        if (options.own) return;
        const X = u.valToPos(clock.now, 'x', true);
        if (X < u.bbox.left || X > u.bbox.left + u.bbox.width) return;
        u.ctx.save(); u.ctx.strokeStyle = css('--accent'); u.ctx.lineWidth = devicePixelRatio * 1.2; u.ctx.beginPath(); u.ctx.moveTo(X, u.bbox.top); u.ctx.lineTo(X, u.bbox.top + u.bbox.height); u.ctx.stroke(); u.ctx.restore();
      };
      plot = new uPlot({
        width: Math.max(200, holder.clientWidth || 600), height: options.height || 190,
        scales: { x: { time: false }, y: options.log ? { distr: 3 } : {} },
        axes: [{ ...axis, label: xLabel, labelSize: 20, size: 34, labelFont: axis.font }, { ...axis, size: 66, ...(options.log ? { splits: ticksOfLog, filter: (u, v) => v } : {}), values: (u, v) => v.map(y => y === null ? '' : short(y, 4)) }],
        cursor: { drag: { x: false, y: false }, points: { size: 6 }, sync: options.own ? undefined : { key: 't' } }, legend: { show: false },
        series: [{}, ...series.map((s, i) => ({ label: s.name, stroke: s.colour ?? c[i % 8], width: 1.3, dash: s.dash ?? (i >= 8 ? [5, 3] : undefined), show: !hidden.has(i), points: { show: x.length < 60, size: 5 } }))],
        hooks: { draw: [line], setCursor: [u => options.own && tell(u.cursor.idx ?? x.length - 1)] },
      }, [x, ...series.map(s => s.y)], holder);
      listen();
      options.own ? tell(x.length - 1) : me.cursorTo(clock.now);
      if (options.upTo) me.zoom(x[0], options.upTo);
    },
    zoom: (a, b) => plot?.setScale('x', { min: a, max: b }),
    cursorTo(t) {
      if (options.own) return;
      let low = 0, high = x.length - 1;
      while (high - low > 1) { const m = (low + high) >> 1; x[m] <= t ? (low = m) : (high = m); }
      tell(Math.abs(x[high] - t) < Math.abs(x[low] - t) ? high : low);
      plot?.redraw(false, false);
    },
  };
  /** The numbers of a row under the plot. */
  function tell(k) { series.forEach((s, i) => { spans[i].textContent = short(s.y[k], 6); spans[i].dataset.value = s.y[k]; spans[i].dataset.at = x[k]; }); }
  function listen() {
    const over = plot.over, same = options.own ? [me] : plots.filter(q => !q.own);
    const at = e => plot.posToVal(e.clientX - over.getBoundingClientRect().left, 'x'), to = e => clock.drag(Math.max(x[0], Math.min(x[x.length - 1], at(e))));
    let dragging = false;
    if (!options.own) {
      over.addEventListener('pointerdown', e => { if (e.button) return; dragging = true; over.setPointerCapture(e.pointerId); clock.stop(); to(e); });
      over.addEventListener('pointermove', e => dragging && to(e));
      over.addEventListener('pointerup', () => (dragging = false));
    }
    over.addEventListener('wheel', e => {
      e.preventDefault();
      const middle = at(e), k = e.deltaY < 0 ? 0.8 : 1.25, { min, max } = plot.scales.x;
      for (const p of same) p.zoom?.(Math.max(x[0], middle - (middle - min) * k), Math.min(x[x.length - 1], middle + (max - middle) * k));
    }, { passive: false });
    over.addEventListener('dblclick', () => { for (const p of same) p.zoom?.(x[0], x[x.length - 1]); });
  }
  series.forEach((s, i) => {
    const out = make('output', { 'data-probe': s.name }), dot = make('i'), label = make('label', { title: s.name }, dot, make('span', {}, s.name), out);
    spans.push(out); dots.push(dot);
    label.addEventListener('click', () => { hidden.has(i) ? hidden.delete(i) : hidden.add(i); label.classList.toggle('off', hidden.has(i)); plot.setSeries(i + 1, { show: !hidden.has(i) }); });
    values.append(label);
  });
  plots.push(me);
  return me;
}

function ticks(a, b, n) {
  const raw = (b - a) / n, p = 10 ** Math.floor(Math.log10(raw)), s = [1, 2, 5, 10].map(k => k * p).find(k => k >= raw * 0.999), out = [];
  for (let v = Math.ceil(a / s - 1e-9) * s; v <= b + 1e-9 * s; v += s) out.push(Math.abs(v) < 1e-9 * s ? 0 : v);
  return out;
}

/** 1, 2, 5 times powers of ten, or powers alone where these are many; as logarithms. */
function ticksOfDecades(a, b, n) {
  const few = b - a > n / 2, out = [];
  for (let e = Math.floor(a); e <= b; ++e) for (const k of few ? [1] : [1, 2, 5]) { const v = e + Math.log10(k); if (v >= a && v <= b && (!few || e % Math.ceil((b - a) / n) === 0)) out.push(v); }
  return out.length > 1 ? out : ticks(a, b, n);
}

function rangeOfCurves(curves, fx, fy, options, w, h, [L, R, T, B]) {
  let x0 = Infinity, x1 = -Infinity, y0 = Infinity, y1 = -Infinity;
  for (const k of curves) for (let i = 0; i < k.x.length; ++i) {
    const X = fx(k.x[i]), Y = fy(k.y[i]);
    if (Number.isFinite(X) && Number.isFinite(Y)) { x0 = Math.min(x0, X); x1 = Math.max(x1, X); y0 = Math.min(y0, Y); y1 = Math.max(y1, Y); }
  }
  if (!(x1 >= x0)) { x0 = 0; x1 = 1; y0 = 0; y1 = 1; }
  if (options.from0) y0 = Math.min(0, y0);
  if (!(x1 > x0)) { x0 -= 1; x1 += 1; }
  if (!(y1 > y0)) { y0 -= 1; y1 += 1; }
  const px = 0.04 * (x1 - x0), py = 0.05 * (y1 - y0);
  x0 -= px; x1 += px; y0 -= options.from0 && y0 === 0 ? 0 : py; y1 += py;
  if (options.equal) {
    const s = Math.max((x1 - x0) / (w - L - R), (y1 - y0) / (h - T - B)), mx = (x0 + x1) / 2, my = (y0 + y1) / 2;
    x0 = mx - s * (w - L - R) / 2; x1 = mx + s * (w - L - R) / 2; y0 = my - s * (h - T - B) / 2; y1 = my + s * (h - T - B) / 2;
  }
  return [x0, x1, y0, y1];
}

/** Points and lines in a plane of two numbers: fan, locus, orbit, study. curves: {name, x, y, line, dots, stems, pick, isNow, filled, say} */
export function chart(parent, title, xLabel, yLabel, curves, options = {}) {
  const canvas = make('canvas', { class: 'chart', role: 'img', 'aria-label': title }), tip = make('div', { class: 'soft' }, '\u00a0');
  const legend = make('div', { class: 'values' });
  parent.append(make('h2', {}, title), canvas, curves.length > 1 && curves.length < 25 ? legend : '', tip);
  const logy = options.log || options.logy, fy = a => logy ? Math.log10(a) : a, fx = a => options.log || options.logx ? Math.log10(a) : a;
  let spots = [];
  const me = { root: canvas, own: true, title, curves, spots: () => spots, draw() {
    const w = canvas.clientWidth || 600, h = options.height || Math.min(420, Math.max(240, 0.6 * w)), r = devicePixelRatio || 1, L = 70, B = 40, T = 10, R = 14;
    canvas.width = w * r; canvas.height = h * r; canvas.style.height = h + 'px';
    const c = canvas.getContext('2d'); c.scale(r, r); c.font = '12px system-ui,"DejaVu Sans"';
    legend.replaceChildren(...curves.map((k, j) => { const dot = make('i'); dot.style.background = k.colour ?? colours()[j % 8]; return make('label', { title: k.name }, dot, make('span', {}, k.name)); }));
    const [x0, x1, y0, y1] = rangeOfCurves(curves, fx, fy, options, w, h, [L, R, T, B]);
    const X = v => L + (v - x0) / (x1 - x0) * (w - L - R), Y = v => h - B - (v - y0) / (y1 - y0) * (h - T - B);
    c.strokeStyle = css('--grid'); c.fillStyle = css('--soft'); c.textAlign = 'center';
    const stroke = (a, b, e, d) => { c.beginPath(); c.moveTo(a, b); c.lineTo(e, d); c.stroke(); };
    for (const v of (options.log || options.logx ? ticksOfDecades : ticks)(x0, x1, w / 90)) { stroke(X(v), T, X(v), h - B); c.fillText(short(options.log || options.logx ? 10 ** v : v, 4), X(v), h - B + 16); }
    c.textAlign = 'right';
    for (const v of (logy ? ticksOfDecades : ticks)(y0, y1, h / 50)) { stroke(L, Y(v), w - R, Y(v)); c.fillText(short(logy ? 10 ** v : v, 4), L - 6, Y(v) + 4); }
    c.textAlign = 'center'; c.fillText(xLabel, (L + w - R) / 2, h - 6);
    c.save(); c.translate(13, (T + h - B) / 2); c.rotate(-Math.PI / 2); c.fillText(yLabel, 0, 0); c.restore();
    c.save(); c.beginPath(); c.rect(L, T, w - L - R, h - T - B); c.clip();
    if (options.zero !== undefined) { c.strokeStyle = css('--warn'); stroke(X(options.zero), T, X(options.zero), h - B); }
    const labels = []; // of rays, where they do not lie on one another
    for (const n of options.rays || []) {
      c.strokeStyle = css('--line'); c.setLineDash([4, 4]); stroke(X(0), Y(0), X(x1), Y(n * x1)); c.setLineDash([]);
      const at = Math.min(x1, y1 / n), p = [X(at) - 6, Math.max(T + 10, Y(n * at) - 4)];
      if (labels.some(q => Math.abs(q[0] - p[0]) < 36 && Math.abs(q[1] - p[1]) < 13)) continue;
      labels.push(p); c.fillStyle = css('--soft'); c.textAlign = 'right'; c.fillText(n + '/rev', ...p); c.textAlign = 'center';
    }
    spots = [];
    curves.forEach((k, j) => {
      c.strokeStyle = c.fillStyle = k.colour ?? colours()[j % 8]; c.lineWidth = 1.4; c.setLineDash(k.dash ?? (j >= 16 ? [2, 2] : j >= 8 ? [5, 3] : []));
      if (k.line) {
        c.beginPath();
        let on = false;
        for (let i = 0; i < k.x.length; ++i) { const a = X(fx(k.x[i])), b = Y(fy(k.y[i])); if (!Number.isFinite(a + b)) { on = false; continue; } on ? c.lineTo(a, b) : c.moveTo(a, b); on = true; }
        c.stroke();
      }
      c.setLineDash([]);
      if (k.stems) for (let i = 0; i < k.x.length; ++i) if (Number.isFinite(Y(fy(k.y[i])))) stroke(X(fx(k.x[i])), Y(Math.max(y0, Math.min(y1, 0))), X(fx(k.x[i])), Y(fy(k.y[i])));
      if (k.dots) for (let i = 0; i < k.x.length; ++i) {
        const a = X(fx(k.x[i])), b = Y(fy(k.y[i]));
        if (!Number.isFinite(a + b)) continue;
        c.beginPath(); c.arc(a, b, k.isNow?.(i) ? 7 : k.pick?.(i) ? 4.5 : 2.5, 0, 7); k.filled?.(i) === false ? c.stroke() : c.fill();
        spots.push([a, b, j, i]);
      }
    });
    c.restore();
  } };
  const near = e => { const r = canvas.getBoundingClientRect(), a = e.clientX - r.left, b = e.clientY - r.top; let best = null, d = 400; for (const s of spots) { const q = (s[0] - a) ** 2 + (s[1] - b) ** 2; if (q < d) { d = q; best = s; } } return best; };
  canvas.addEventListener('pointermove', e => { const s = near(e); tip.textContent = s ? `${curves[s[2]].name}: ${xLabel} ${short(curves[s[2]].x[s[3]], 6)}, ${yLabel} ${short(curves[s[2]].y[s[3]], 6)}${curves[s[2]].say?.(s[3]) || ''}` : '\u00a0'; });
  canvas.addEventListener('click', e => { const s = near(e); if (s) curves[s[2]].pick?.(s[3], true); redrawCharts(); });
  plots.push(me);
  return me;
}

/** Frequencies [Hz] and amplitudes by a Hann window at equal steps: the height of a peak is the amplitude of a sine. */
export function spectrum(t, y) {
  const n0 = t.length;
  if (n0 < 16) return null;
  const N = 2 ** Math.min(15, Math.ceil(Math.log2(n0))), dt = (t[n0 - 1] - t[0]) / (N - 1), M = 2 * N, a = new Float64Array(M), b = new Float64Array(M);
  let k = 0, mean = 0, sum = 0;
  for (let i = 0; i < N; ++i) { const x = t[0] + i * dt; while (k < n0 - 2 && t[k + 1] < x) ++k; const u = (x - t[k]) / (t[k + 1] - t[k] || 1); a[i] = y[k] + u * (y[k + 1] - y[k]); mean += a[i] / N; }
  for (let i = 0; i < N; ++i) { const w = 0.5 - 0.5 * Math.cos(2 * Math.PI * i / (N - 1)); sum += w; a[i] = (a[i] - mean) * w; }
  for (let i = 0, j = 0; i < M; ++i) { if (j > i) [a[i], a[j]] = [a[j], a[i]]; let m = M >> 1; while (m >= 1 && j & m) { j ^= m; m >>= 1; } j |= m; }
  for (let len = 2; len <= M; len <<= 1) for (let i = 0; i < M; i += len) for (let j = 0; j < len / 2; ++j) {
    const w = -2 * Math.PI * j / len, c = Math.cos(w), s = Math.sin(w), p = i + j, q = p + len / 2, x = a[q] * c - b[q] * s, z = a[q] * s + b[q] * c;
    a[q] = a[p] - x; b[q] = b[p] - z; a[p] += x; b[p] += z;
  }
  const n = M / 2, f = new Float64Array(n), A = new Float64Array(n);
  for (let i = 0; i < n; ++i) { f[i] = i / (M * dt); A[i] = 2 / sum * Math.hypot(a[i], b[i]); }
  return [f, A];
}

/** A disk seen from above its thrust: colours over azimuth [deg] and radius [m]. cells: [azimuth, radius, value, from, to]; step [deg] */
export function diskMap(parent, title, cells, unit, colourOf, step) {
  const canvas = make('canvas', { class: 'chart', role: 'img', 'aria-label': title }), tip = make('div', { class: 'soft' }, '\u00a0');
  parent.append(make('h2', {}, title), canvas, tip);
  let low = Infinity, high = -Infinity, R = 0, near = null;
  for (const [, r, v] of cells) { low = Math.min(low, v); high = Math.max(high, v); R = Math.max(R, r); }
  if (!(high > low)) high = low + 1e-12 * (Math.abs(low) || 1);
  const me = { root: canvas, own: true, title, cells, draw() {
    const w = canvas.clientWidth || 600, h = Math.min(440, w), d = devicePixelRatio || 1, c = canvas.getContext('2d'), cx = h / 2, cy = h / 2, scale = (h / 2 - 26) / R;
    canvas.width = w * d; canvas.height = h * d; canvas.style.height = h + 'px'; c.scale(d, d); c.font = '12px system-ui,"DejaVu Sans"'; c.textAlign = 'center';
    near = e => { const r = canvas.getBoundingClientRect(), x = (e.clientX - r.left - cx) / scale, y = (e.clientY - r.top - cy) / scale; let best = null, least = (0.1 * R) ** 2; for (const cell of cells) { const a = cell[0] * Math.PI / 180, q = (cell[1] * Math.sin(a) - x) ** 2 + (cell[1] * Math.cos(a) - y) ** 2; if (q < least) { least = q; best = cell; } } return best; };
    for (const [psi, , v, a, b] of cells) { // azimuth 0 is behind, at the bottom; 90 on the right
      const angle = Math.PI / 2 - psi * Math.PI / 180;
      c.strokeStyle = `rgb(${colourOf((v - low) / (high - low)).map(u => Math.round(255 * u))})`; c.lineWidth = Math.max(1.5, scale * (b - a) + 0.7); c.beginPath(); c.arc(cx, cy, scale * (a + b) / 2, angle - me.half, angle + me.half); c.stroke();
    }
    c.fillStyle = css('--soft');
    for (const [text, x, y] of [['0°', cx, h - 6], ['90°', h - 14, cy + 4], ['180°', cx, 16], ['270°', 16, cy + 4]]) c.fillText(text, x, y);
    c.textAlign = 'left'; for (let i = 0; i < 100; ++i) { c.fillStyle = `rgb(${colourOf(1 - i / 99).map(u => Math.round(255 * u))})`; c.fillRect(h + 10, 30 + 1.6 * i, 14, 2); }
    c.fillStyle = css('--soft'); c.fillText(short(high, 4) + ' ' + unit, h + 30, 36); c.fillText(short(low, 4) + ' ' + unit, h + 30, 192);
  } };
  me.half = Math.min(step || 5, 24) / 2 * Math.PI / 180 + 0.01;
  canvas.addEventListener('pointermove', e => { const c = near?.(e); tip.textContent = c ? `azimuth ${short(c[0], 4)}°, radius ${short(c[1], 4)} m: ${short(c[2], 5)} ${unit}` : '\u00a0'; });
  plots.push(me);
  return me;
}

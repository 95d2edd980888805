// Where the samples of a picture are: motions, shapes about a state, shapes along a motion, deformations magnified.
import { read, unpackRow } from './data.js';

/** out = q x, of a unit quaternion x y z w. */
export function turn(q, o, x, y, z, out, k) {
  const qx = q[o], qy = q[o + 1], qz = q[o + 2], qw = q[o + 3];
  const tx = 2 * (qy * z - qz * y), ty = 2 * (qz * x - qx * z), tz = 2 * (qx * y - qy * x);
  out[k] = x + qw * tx + qy * tz - qz * ty;
  out[k + 1] = y + qw * ty + qz * tx - qx * tz;
  out[k + 2] = z + qw * tz + qx * ty - qy * tx;
}

function times(a, i, b, j, out, k) {
  const ax = a[i], ay = a[i + 1], az = a[i + 2], aw = a[i + 3], bx = b[j], by = b[j + 1], bz = b[j + 2], bw = b[j + 3];
  out[k] = aw * bx + ax * bw + ay * bz - az * by;
  out[k + 1] = aw * by - ax * bz + ay * bw + az * bx;
  out[k + 2] = aw * bz + ax * by - ay * bx + az * bw;
  out[k + 3] = aw * bw - ax * bx - ay * by - az * bz;
}

function ofVector(x, y, z, out, k) {
  const a = Math.hypot(x, y, z), s = a < 1e-9 ? 0.5 : Math.sin(a / 2) / a;
  out[k] = x * s; out[k + 1] = y * s; out[k + 2] = z * s; out[k + 3] = Math.cos(a / 2);
}

/** out = (factor times the rotation from b to a) b */
function magnified(a, i, b, j, factor, out, k) {
  const t = magnified.t;
  t[0] = -b[j]; t[1] = -b[j + 1]; t[2] = -b[j + 2]; t[3] = b[j + 3];
  times(a, i, t, 0, t, 4);
  const sign = t[7] < 0 ? -1 : 1, l = Math.hypot(t[4], t[5], t[6]), f = factor * sign * (l < 1e-12 ? 2 : 2 * Math.atan2(l, sign * t[7]) / l);
  ofVector(f * t[4], f * t[5], f * t[6], t, 8);
  times(t, 8, b, j, out, k);
}
magnified.t = new Float64Array(12);

/** The segment of a joined motion, and the number in it, of a picture. */
export function segmentOf(show, frame) {
  let k = frame;
  for (const segment of show.segments) { if (k < segment.times.length) return [segment, k]; k -= segment.times.length; }
  const last = show.segments[show.segments.length - 1];
  return [last, last.times.length - 1];
}

export const nSamples = model => model.place.s[0];
export const nFrames = show => show.kind === 'shape' ? 1 : show.times.length;

function normalise(Q) {
  for (let k = 0; k < Q.length; k += 4) {
    const l = 1 / (Math.hypot(Q[k], Q[k + 1], Q[k + 2], Q[k + 3]) || 1);
    Q[k] *= l; Q[k + 1] *= l; Q[k + 2] *= l; Q[k + 3] *= l;
  }
}

/** Where each sample was if its body had not deformed in this picture: the reference moved rigidly. */
export function rigidly(show, frame, P, Q) {
  const m = show.model, n = nSamples(m), x0 = read(m.place), q0 = read(m.turn), carrier = read(m.carrier);
  const [part, row] = segmentOf(show, frame), rigid = read(part.rigid), nO = part.rigid.s[1];
  for (let s = 0; s < n; ++s) {
    if (carrier[s] < 0) {
      for (let i = 0; i < 3; ++i) P[3 * s + i] = x0[3 * s + i];
      for (let i = 0; i < 4; ++i) Q[4 * s + i] = q0[4 * s + i];
      continue;
    }
    const f = (row * nO + carrier[s]) * 7;
    turn(rigid, f + 3, x0[3 * s], x0[3 * s + 1], x0[3 * s + 2], P, 3 * s);
    for (let i = 0; i < 3; ++i) P[3 * s + i] += rigid[f + i];
    times(rigid, f + 3, q0, 4 * s, Q, 4 * s);
  }
}

function placeFrame(show, frame, factor, P, Q, scratch) {
  const [part, row] = segmentOf(show, frame);
  unpackRow(part.places, row, P); unpackRow(part.turns, row, Q); normalise(Q);
  if (factor === 1) return;
  const { P: R, Q: D } = scratch;
  rigidly(show, frame, R, D);
  for (let i = 0; i < P.length; ++i) P[i] = R[i] + factor * (P[i] - R[i]);
  for (let k = 0; k < Q.length; k += 4) magnified(Q, k, D, k, factor, Q, k);
}

/** Mean and parts of a shape, of Floquet in one of its pictures. */
export function partsOf(show, frame) {
  if (show.kind === 'shape') {
    if (!show.unpacked) {
      const n = nSamples(show.model), z = new Float32Array(12 * n), row = new Float32Array(12);
      for (let s = 0; s < n; ++s) z.set(unpackRow(show.parts, s, row), 12 * s);
      Object.defineProperty(show, 'unpacked', { value: z });
    }
    return show.unpacked;
  }
  const z = show.scratch ?? (Object.defineProperty(show, 'scratch', { value: new Float32Array(12 * nSamples(show.model)) }), show.scratch);
  return unpackRow(show.parts, frame, z);
}

function placeShape(show, frame, phase, factor, P, Q) {
  const n = nSamples(show.model), z = partsOf(show, frame), c = factor * Math.cos(phase), s = factor * Math.sin(phase), t = magnified.t;
  if (show.kind === 'shape') {
    const mean = read(show.mean);
    for (let k = 0; k < n; ++k) {
      for (let i = 0; i < 3; ++i) P[3 * k + i] = mean[7 * k + i];
      for (let i = 0; i < 4; ++i) Q[4 * k + i] = mean[7 * k + 3 + i];
    }
  } else { unpackRow(show.places, frame, P); unpackRow(show.turns, frame, Q); normalise(Q); }
  for (let k = 0; k < n; ++k) {
    const a = 12 * k;
    for (let i = 0; i < 3; ++i) P[3 * k + i] += c * z[a + i] + s * z[a + 3 + i];
    ofVector(c * z[a + 6] + s * z[a + 9], c * z[a + 7] + s * z[a + 10], c * z[a + 8] + s * z[a + 11], t, 0);
    times(t, 0, Q, 4 * k, t, 4);
    for (let i = 0; i < 4; ++i) Q[4 * k + i] = t[4 + i];
  }
}

/** Places (3 a sample) and turns (4) of what is shown. Periods of Floquet that have passed turn the shape on. */
export function place(show, { frame, phase, factor, periods }, P, Q, scratch) {
  if (show.kind === 'frames') placeFrame(show, frame, factor, P, Q, scratch);
  else placeShape(show, frame, show.kind === 'floquet' ? phase + periods * show.phase : phase, factor, P, Q);
}

/** Corners in space, for tests and for who wants them. */
export function corners(show, at) {
  const m = show.model, n = nSamples(m), P = new Float32Array(3 * n), Q = new Float32Array(4 * n), scratch = { P: new Float32Array(3 * n), Q: new Float32Array(4 * n) };
  place(show, at, P, Q, scratch);
  const local = read(m.local), sample = read(m.sample), out = new Float32Array(local.length);
  for (let i = 0; i < sample.length; ++i) {
    turn(Q, 4 * sample[i], local[3 * i], local[3 * i + 1], local[3 * i + 2], out, 3 * i);
    for (let d = 0; d < 3; ++d) out[3 * i + d] += P[3 * sample[i] + d];
  }
  return out;
}

/**
 * How a shape goes round: the vector Σ u_c × u_s of all stations of bodies, and its length as a part of what it would be if
 * all went round in circles in one plane: 0, all move to and fro; 1, all in circles, one way.
 */
export function whirl(show) {
  const m = show.model, n = nSamples(m), z = partsOf(show, 0), object = read(m.object), w = [0, 0, 0];
  let all = 0;
  for (let s = 0; s < n; ++s) {
    if (m.objects[object[s]][1] !== 'Bodies') continue;
    const a = 12 * s;
    for (let i = 0; i < 3; ++i) { const j = (i + 1) % 3, k = (i + 2) % 3; w[i] += z[a + j] * z[a + 3 + k] - z[a + k] * z[a + 3 + j]; all += 0.5 * (z[a + i] ** 2 + z[a + 3 + i] ** 2); }
  }
  return { axis: w, share: all > 0 ? Math.hypot(...w) / all : 0 };
}

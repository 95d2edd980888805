// The drawing: WebGL 2, without a library. Corners are fixed in the axes of their samples and stay on the card; a picture
// is a texture with the place, the turn and the colour of each sample. So a picture costs as much as there are samples.

// In w of its colour a sample of a symbol has its size, which is drawn no smaller than uLeast; what is drawn thinner has
// minus its factor there.
const HEAD = `#version 300 es
precision highp float; precision highp int; precision highp sampler2D;
uniform mat4 uMatrix; uniform sampler2D uSamples; uniform vec3 uEye; uniform float uLeast;
vec4 texel(int sampleNumber, int k) { int w = textureSize(uSamples, 0).x, i = 3 * sampleNumber + k; return texelFetch(uSamples, ivec2(i % w, i / w), 0); }
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
float grown(vec4 c) { return c.w > 0.0 ? max(1.0, uLeast / c.w) : c.w < 0.0 ? -c.w : 1.0; }
`;
const SURFACE = [HEAD + `
layout(location=0) in vec3 aLocal; layout(location=1) in vec3 aNormal; layout(location=2) in float aSample;
out vec3 vNormal, vPlace, vColour;
void main() { int s = int(aSample); vec4 p = texel(s, 0), q = texel(s, 1), c = texel(s, 2);
  vPlace = p.xyz + turned(q, grown(c) * aLocal); vNormal = turned(q, aNormal); vColour = c.rgb; gl_Position = uMatrix * vec4(vPlace, 1.0); }`,
HEAD + `
in vec3 vNormal, vPlace, vColour; out vec4 colour; uniform float uPlain;
void main() { vec3 to = normalize(uEye - vPlace), n = dot(vNormal, vNormal) > 0.1 ? normalize(vNormal) : normalize(cross(dFdx(vPlace), dFdy(vPlace)));
  if (dot(n, to) < 0.0) n = -n;
  float up = 0.5 + 0.5 * n.z, key = max(dot(n, normalize(to + vec3(0.35, 0.25, 0.7))), 0.0), shine = pow(key, 40.0);
  float light = mix(0.34 + 0.2 * up + 0.5 * key, 0.62 + 0.1 * up + 0.3 * key, uPlain);
  colour = vec4(vColour * light + vec3(0.13 * shine * (1.0 - uPlain)), 1.0); }`];
const EDGES = [HEAD + `
layout(location=0) in vec3 aLocal; layout(location=2) in float aSample; uniform float uCloser;
void main() { int s = int(aSample); gl_Position = uMatrix * vec4(texel(s, 0).xyz + turned(texel(s, 1), grown(texel(s, 2)) * aLocal), 1.0); gl_Position.z -= uCloser * gl_Position.w; }`,
HEAD + `out vec4 colour; uniform vec4 uColour; void main() { colour = uColour; }`];
const PLAIN = [HEAD + `
layout(location=0) in vec3 aLocal; void main() { gl_Position = uMatrix * vec4(aLocal, 1.0); }`, EDGES[1]];
const ARROWS = [HEAD + `
layout(location=0) in vec3 aLocal; out vec3 vPlace; void main() { vPlace = aLocal; gl_Position = uMatrix * vec4(aLocal, 1.0); }`,
HEAD + `in vec3 vPlace; out vec4 colour; uniform vec4 uColour;
void main() { vec3 n = normalize(cross(dFdx(vPlace), dFdy(vPlace))), to = normalize(uEye - vPlace); colour = vec4(uColour.rgb * (0.55 + 0.45 * abs(dot(n, to))), 1.0); }`];
const NUMBERS = [HEAD + `
layout(location=0) in vec3 aLocal; layout(location=2) in float aSample; flat out int vSample;
void main() { int s = int(aSample); vSample = s + 1; gl_Position = uMatrix * vec4(texel(s, 0).xyz + turned(texel(s, 1), grown(texel(s, 2)) * aLocal), 1.0); }`,
HEAD + `flat in int vSample; out vec4 colour; void main() { colour = vec4(vSample & 255, (vSample >> 8) & 255, (vSample >> 16) & 255, 255) / 255.0; }`];

const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]], dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => { const l = Math.hypot(...a) || 1; return a.map(x => x / l); };
function times(a, b) { const c = new Float32Array(16); for (let i = 0; i < 4; ++i) for (let j = 0; j < 4; ++j) { let s = 0; for (let k = 0; k < 4; ++k) s += a[k * 4 + j] * b[i * 4 + k]; c[i * 4 + j] = s; } return c; }

/** Of a unit quaternion x y z w: q v, and back: the components of v in the axes q. */
function turned(q, o, x, y, z, out, k) { const a = q[o], b = q[o + 1], c = q[o + 2], w = q[o + 3], tx = 2 * (b * z - c * y), ty = 2 * (c * x - a * z), tz = 2 * (a * y - b * x); out[k] = x + w * tx + b * tz - c * ty; out[k + 1] = y + w * ty + c * tx - a * tz; out[k + 2] = z + w * tz + a * ty - b * tx; }
function back(q, o, v, out) { turned([-q[o], -q[o + 1], -q[o + 2], q[o + 3]], 0, v[0], v[1], v[2], out, 0); }

/** Corners split where the surface has an edge, and the edges: what is drawn of quadrilaterals. */
export function mesh(local, sample, place, turn, quads) {
  const n = sample.length, nQ = quads.length / 4, world = new Float32Array(3 * n), normals = new Float32Array(3 * nQ), count = new Uint16Array(place.length / 3);
  for (let i = 0; i < n; ++i) { turned(turn, 4 * sample[i], local[3 * i], local[3 * i + 1], local[3 * i + 2], world, 3 * i); for (let k = 0; k < 3; ++k) world[3 * i + k] += place[3 * sample[i] + k]; }
  const at = (i, k) => world[3 * i + k];
  for (let i = 0; i < n; ++i) if (count[sample[i]] < 60000) ++count[sample[i]];
  const faces = new Array(n), sides = new Map();
  for (let c = 0; c < nQ; ++c) {
    const [a, b, d, e] = quads.subarray(4 * c, 4 * c + 4), p = [0, 1, 2].map(k => at(d, k) - at(a, k)), q = [0, 1, 2].map(k => at(e, k) - at(b, k));
    normals.set(unit(cross(p, q)), 3 * c);
    for (let k = 0; k < 4; ++k) { const i = quads[4 * c + k], j = quads[4 * c + (k + 1) % 4]; (faces[i] ??= []).push(c); if (i !== j) { const key = i < j ? i * n + j : j * n + i; const s = sides.get(key); s === undefined ? sides.set(key, c) : sides.set(key, s < 0 ? s : -1 - s * nQ - c); } }
  }
  const corner = [], normal = [], index = [], known = new Map(), smooth = 0.7, isOpen = i => count[sample[i]] === 1;
  const vertex = (i, c) => {
    if (isOpen(i)) { let v = known.get(i * 4096); if (v === undefined) { known.set(i * 4096, (v = corner.length)); corner.push(i); normal.push(0, 0, 0); } return v; }
    let x = 0, y = 0, z = 0; const own = normals.subarray(3 * c, 3 * c + 3);
    for (const d of faces[i]) { const m = normals.subarray(3 * d, 3 * d + 3); if (dot(own, m) > smooth) { x += m[0]; y += m[1]; z += m[2]; } }
    const u = unit([x, y, z]), key = i * 4096 + (Math.round(7 * u[0] + 7) * 256 + Math.round(7 * u[1] + 7) * 16 + Math.round(7 * u[2] + 7));
    let v = known.get(key); if (v === undefined) { known.set(key, (v = corner.length)); corner.push(i); back(turn, 4 * sample[i], u, own3); normal.push(own3[0], own3[1], own3[2]); } return v;
  }, own3 = [0, 0, 0];
  for (let c = 0; c < nQ; ++c) { const v = [0, 1, 2, 3].map(k => vertex(quads[4 * c + k], c)); if (v[0] !== v[1]) index.push(v[0], v[1], v[2]); if (v[2] !== v[3]) index.push(v[0], v[2], v[3]); }
  const edges = []; // of open surfaces all sides of cells, of solids those where faces meet at an angle
  for (const [key, s] of sides) { const i = Math.floor(key / n), j = key % n; if (isOpen(i)) { edges.push(i, j); continue; } if (s >= 0) continue; const a = Math.floor((-1 - s) / nQ), b = (-1 - s) % nQ; if (dot(normals.subarray(3 * a, 3 * a + 3), normals.subarray(3 * b, 3 * b + 3)) < 0.6) edges.push(i, j); }
  return { corner: Uint32Array.from(corner), normal: Float32Array.from(normal), index: Uint32Array.from(index), edges: edges.length < 400000 ? Uint32Array.from(edges) : new Uint32Array() };
}

export class View {
  constructor(canvas, geometry) {
    const gl = (this.gl = canvas.getContext('webgl2', { antialias: true, alpha: true, premultipliedAlpha: true }));
    if (!gl) throw new Error('This browser has no WebGL 2: there is no drawing, all else is here.');
    this.canvas = canvas; this.nSamples = geometry.place.length / 3; this.azimuth = -0.9; this.elevation = 0.45; this.distance = 10; this.target = [0, 0, 0]; this.radius = 1; this.dirty = true;
    this.programs = Object.fromEntries(Object.entries({ SURFACE, EDGES, PLAIN, ARROWS, NUMBERS }).map(([k, v]) => [k, this.program(...v)]));
    const m = mesh(geometry.local, geometry.sample, geometry.place, geometry.turn, geometry.quads); this.mesh = m;
    const pack = list => { const out = new Float32Array(7 * list.length); list.forEach((i, v) => { for (let k = 0; k < 3; ++k) out[7 * v + k] = geometry.local[3 * i + k]; out[7 * v + 6] = geometry.sample[i]; }); return out; };
    const solid = pack(m.corner); for (let v = 0; v < m.corner.length; ++v) for (let k = 0; k < 3; ++k) solid[7 * v + 3 + k] = m.normal[3 * v + k];
    this.solid = this.array(solid, m.index); this.edges = this.array(pack(m.edges)); this.wires = this.array(pack(geometry.lines));
    const w = Math.min(gl.getParameter(gl.MAX_TEXTURE_SIZE), 4096); this.width = Math.min(w, 3 * this.nSamples); this.height = Math.ceil(3 * this.nSamples / this.width); this.texels = new Float32Array(4 * this.width * this.height);
    this.texture = gl.createTexture(); gl.bindTexture(gl.TEXTURE_2D, this.texture); for (const p of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, p, gl.NEAREST);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, this.width, this.height, 0, gl.RGBA, gl.FLOAT, null);
    this.plain = {}; this.arrows = null; this.listen();
  }
  program(vertex, fragment) {
    const gl = this.gl, p = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) { const s = gl.createShader(kind); gl.shaderSource(s, text); gl.compileShader(s); gl.attachShader(p, s); if (!gl.getShaderParameter(s, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(s)); }
    gl.linkProgram(p); if (!gl.getProgramParameter(p, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(p));
    return { p, u: n => gl.getUniformLocation(p, n) };
  }
  array(data, index) {
    const gl = this.gl, vao = gl.createVertexArray(); gl.bindVertexArray(vao); gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    [[0, 3, 0], [1, 3, 12], [2, 1, 24]].forEach(([i, size, at]) => { gl.enableVertexAttribArray(i); gl.vertexAttribPointer(i, size, gl.FLOAT, false, 28, at); });
    if (index) { gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, index, gl.STATIC_DRAW); } gl.bindVertexArray(null);
    return { vao, n: index ? index.length : data.length / 7 };
  }
  /** Lines in space: points x y z two by two; strip: one after another. */
  setLines(name, points, colour, strip = false) {
    const gl = this.gl; if (this.plain[name]) { gl.deleteBuffer(this.plain[name].buffer); gl.deleteVertexArray(this.plain[name].vao); }
    if (!points) { delete this.plain[name]; this.dirty = true; return; }
    const vao = gl.createVertexArray(), buffer = gl.createBuffer(); gl.bindVertexArray(vao); gl.bindBuffer(gl.ARRAY_BUFFER, buffer); gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(points), gl.STATIC_DRAW); gl.enableVertexAttribArray(0); gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 12, 0); gl.bindVertexArray(null);
    this.plain[name] = { vao, buffer, n: points.length / 3, colour, strip }; this.dirty = true;
  }
  /** Solid arrows in space, or none: three corners of each triangle. */
  setArrows(points, colour) {
    const gl = this.gl; this.dirty = true; if (this.arrows) { gl.deleteBuffer(this.arrows.buffer); gl.deleteVertexArray(this.arrows.vao); } this.arrows = null; if (!points?.length) return;
    const vao = gl.createVertexArray(), buffer = gl.createBuffer(); gl.bindVertexArray(vao); gl.bindBuffer(gl.ARRAY_BUFFER, buffer); gl.bufferData(gl.ARRAY_BUFFER, points, gl.DYNAMIC_DRAW); gl.enableVertexAttribArray(0); gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 12, 0); gl.bindVertexArray(null); this.arrows = { vao, buffer, n: points.length / 3, colour };
  }
  /** A picture: places (3 a sample), turns (x y z w), colours (3, 0 to 1). */
  setSamples(place, turn, colour, symbol) {
    const t = this.texels; for (let s = 0, k = 0; s < this.nSamples; ++s, k += 12) { t[k] = place[3 * s]; t[k + 1] = place[3 * s + 1]; t[k + 2] = place[3 * s + 2]; t[k + 4] = turn[4 * s]; t[k + 5] = turn[4 * s + 1]; t[k + 6] = turn[4 * s + 2]; t[k + 7] = turn[4 * s + 3]; t[k + 8] = colour[3 * s]; t[k + 9] = colour[3 * s + 1]; t[k + 10] = colour[3 * s + 2]; t[k + 11] = symbol[s]; }
    const gl = this.gl; gl.bindTexture(gl.TEXTURE_2D, this.texture); gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, this.width, this.height, gl.RGBA, gl.FLOAT, t); this.dirty = true;
  }
  get direction() { const c = Math.cos(this.elevation); return [c * Math.cos(this.azimuth), c * Math.sin(this.azimuth), Math.sin(this.elevation)]; }
  get eye() { return this.target.map((x, i) => x + this.distance * this.direction[i]); }
  get right() { return [-Math.sin(this.azimuth), Math.cos(this.azimuth), 0]; }
  look(direction) { const d = unit(direction); this.elevation = Math.max(-1.5707, Math.min(1.5707, Math.asin(d[2]))); this.azimuth = Math.hypot(d[0], d[1]) < 1e-6 ? -Math.PI / 2 : Math.atan2(d[1], d[0]); this.dirty = true; }
  matrix() {
    const z = this.direction, x = this.right, y = cross(z, x), e = this.eye, f = 1 / Math.tan(0.26), a = this.canvas.width / this.canvas.height || 1, near = Math.max(this.distance - 30 * this.radius, this.distance / 400), far = this.distance + 60 * this.radius, g = Math.min(1, a);
    return times(new Float32Array([f * g / a, 0, 0, 0, 0, f * g, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0]), new Float32Array([x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -dot(x, e), -dot(y, e), -dot(z, e), 1]));
  }
  /** So near that all balls (x, y, z, radius) are seen; the target is the middle of what is seen. */
  fit(balls) {
    const z = this.direction, x = this.right, y = cross(z, x), a = this.canvas.width / this.canvas.height || 1, g = Math.min(1, a), t = [Math.tan(0.26) / g * a, Math.tan(0.26) / g]; this.distance = 0; let far = 0;
    for (let round = 0; round < 3; ++round) { // in each of two directions the planes that touch all balls meet in the eye
      const high = [-Infinity, -Infinity], low = [Infinity, Infinity];
      for (const [px, py, pz, r] of balls) { const p = [px - this.target[0], py - this.target[1], pz - this.target[2]], d = dot(p, z); [x, y].forEach((e, k) => { const u = dot(p, e), w = t[k] * d, m = r * Math.hypot(1, t[k]); high[k] = Math.max(high[k], u + w + m); low[k] = Math.min(low[k], u - w - m); }); }
      far = Math.max(...[0, 1].map(k => (high[k] - low[k]) / 2 / t[k])); const m = [0, 1].map(k => (high[k] + low[k]) / 2);
      this.target = this.target.map((v, i) => v + m[0] * x[i] + m[1] * y[i]);
    }
    this.radius = 1e-9; for (const [px, py, pz, r] of balls) this.radius = Math.max(this.radius, r + Math.hypot(px - this.target[0], py - this.target[1], pz - this.target[2])); this.distance = 1.1 * far; this.dirty = true;
  }
  /** Where a place is seen: x, y in CSS pixels, depth. */
  seen(p) { const m = this.matrix(), q = [0, 1, 2, 3].map(j => m[j] * p[0] + m[4 + j] * p[1] + m[8 + j] * p[2] + m[12 + j]); return [(q[0] / q[3] + 1) / 2 * this.canvas.clientWidth, (1 - q[1] / q[3]) / 2 * this.canvas.clientHeight, q[2] / q[3]]; }
  /** The least size [m] of symbols: 1.5 % of what is seen, but no more than a hundredth of the model. */
  get least() { return Math.min(0.015 * 2 * this.distance * Math.tan(0.26), 0.02 * this.radius); }
  size() { const c = this.canvas, r = Math.min(devicePixelRatio || 1, 2), w = Math.max(1, Math.round(c.clientWidth * r)), h = Math.max(1, Math.round(c.clientHeight * r)); if (c.width !== w || c.height !== h) { c.width = w; c.height = h; } }
  use(name) { const gl = this.gl, { p, u } = this.programs[name]; gl.useProgram(p); gl.uniformMatrix4fv(u('uMatrix'), false, this.matrix()); gl.uniform3fv(u('uEye'), this.eye); gl.uniform1f(u('uLeast'), this.least); gl.uniform1i(u('uSamples'), 0); gl.bindTexture(gl.TEXTURE_2D, this.texture); return u; }
  draw(style) {
    this.size(); this.dirty = false; const gl = this.gl; gl.viewport(0, 0, this.canvas.width, this.canvas.height); gl.clearColor(0, 0, 0, 0); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT); gl.enable(gl.DEPTH_TEST);
    let u = this.use('PLAIN'); for (const l of Object.values(this.plain)) { gl.uniform4fv(u('uColour'), l.colour); gl.bindVertexArray(l.vao); gl.drawArrays(l.strip ? gl.LINE_STRIP : gl.LINES, 0, l.n); }
    gl.enable(gl.POLYGON_OFFSET_FILL); gl.polygonOffset(1, 1); u = this.use('SURFACE'); gl.uniform1f(u('uPlain'), style.plain ? 1 : 0); gl.bindVertexArray(this.solid.vao); gl.drawElements(gl.TRIANGLES, this.solid.n, gl.UNSIGNED_INT, 0); gl.disable(gl.POLYGON_OFFSET_FILL);
    if (this.arrows) { u = this.use('ARROWS'); gl.uniform4fv(u('uColour'), this.arrows.colour); gl.bindVertexArray(this.arrows.vao); gl.drawArrays(gl.TRIANGLES, 0, this.arrows.n); }
    u = this.use('EDGES'); gl.uniform1f(u('uCloser'), 2e-5); gl.uniform4fv(u('uColour'), style.edge); gl.enable(gl.BLEND); gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    if (style.edges && this.edges.n) { gl.bindVertexArray(this.edges.vao); gl.drawArrays(gl.LINES, 0, this.edges.n); } gl.uniform4fv(u('uColour'), style.wire); if (this.wires.n) { gl.bindVertexArray(this.wires.vao); gl.drawArrays(gl.LINES, 0, this.wires.n); } gl.disable(gl.BLEND); gl.bindVertexArray(null);
  }
  /** The sample seen at a place of the canvas, in CSS pixels; -1: none. */
  pick(x, y) {
    const gl = this.gl, w = this.canvas.width, h = this.canvas.height, r = w / this.canvas.clientWidth;
    if (!this.numbers || this.numbers.w !== w || this.numbers.h !== h) { if (this.numbers) { gl.deleteFramebuffer(this.numbers.f); gl.deleteRenderbuffer(this.numbers.c); gl.deleteRenderbuffer(this.numbers.d); }
      const f = gl.createFramebuffer(), c = gl.createRenderbuffer(), d = gl.createRenderbuffer(); gl.bindFramebuffer(gl.FRAMEBUFFER, f); gl.bindRenderbuffer(gl.RENDERBUFFER, c); gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, w, h); gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, c); gl.bindRenderbuffer(gl.RENDERBUFFER, d); gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT16, w, h); gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, d); this.numbers = { f, c, d, w, h }; }
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.numbers.f); gl.viewport(0, 0, w, h); const px = Math.round(x * r), py = h - 1 - Math.round(y * r), near = 3;
    gl.enable(gl.SCISSOR_TEST); gl.scissor(px - near, py - near, 2 * near + 1, 2 * near + 1); gl.clearColor(0, 0, 0, 0); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT); gl.enable(gl.DEPTH_TEST); this.use('NUMBERS'); gl.bindVertexArray(this.solid.vao); gl.drawElements(gl.TRIANGLES, this.solid.n, gl.UNSIGNED_INT, 0); if (this.wires.n) { gl.bindVertexArray(this.wires.vao); gl.drawArrays(gl.LINES, 0, this.wires.n); } gl.bindVertexArray(null);
    const n = 2 * near + 1, out = new Uint8Array(4 * n * n); gl.readPixels(px - near, py - near, n, n, gl.RGBA, gl.UNSIGNED_BYTE, out); gl.disable(gl.SCISSOR_TEST); gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    let best = -1, d = 99; for (let j = 0; j < n; ++j) for (let i = 0; i < n; ++i) { const k = 4 * (j * n + i), s = out[k] + 256 * out[k + 1] + 65536 * out[k + 2] - 1, e = Math.hypot(i - near, j - near); if (s >= 0 && e < d) { d = e; best = s; } } return best;
  }
  /** Lets go of the canvas, for another view of it. */
  release() { this.off.abort(); const gl = this.gl; for (const name of Object.keys(this.plain)) this.setLines(name, null); this.setArrows(null); gl.deleteTexture(this.texture); for (const a of [this.solid, this.edges, this.wires]) gl.deleteVertexArray(a.vao); for (const p of Object.values(this.programs)) gl.deleteProgram(p.p); }
  listen() {
    this.off = new AbortController(); const signal = this.off.signal;
    const c = this.canvas, at = new Map(); c.style.touchAction = 'none'; c.addEventListener('contextmenu', e => e.preventDefault(), { signal });
    const pan = (dx, dy) => { const s = 2 * this.distance * Math.tan(0.26) / Math.min(c.clientWidth, c.clientHeight), x = this.right, y = cross(this.direction, x); this.target = this.target.map((t, i) => t - s * dx * x[i] + s * dy * y[i]); };
    c.addEventListener('pointerdown', e => { at.set(e.pointerId, [e.clientX, e.clientY]); c.setPointerCapture(e.pointerId); }, { signal });
    for (const k of ['pointerup', 'pointercancel']) c.addEventListener(k, e => at.delete(e.pointerId), { signal });
    c.addEventListener('pointermove', e => { const was = at.get(e.pointerId); if (!was) return; const dx = e.clientX - was[0], dy = e.clientY - was[1];
      if (at.size === 2) { const other = [...at].find(([k]) => k !== e.pointerId)[1]; this.distance *= Math.hypot(was[0] - other[0], was[1] - other[1]) / Math.max(1, Math.hypot(e.clientX - other[0], e.clientY - other[1])); pan(dx / 2, dy / 2); }
      else if (e.buttons & 6 || e.shiftKey) pan(dx, dy); else { this.azimuth -= 0.008 * dx; this.elevation = Math.max(-1.5707, Math.min(1.5707, this.elevation + 0.008 * dy)); }
      at.set(e.pointerId, [e.clientX, e.clientY]); this.dirty = true; }, { signal });
    c.addEventListener('wheel', e => { e.preventDefault(); const k = Math.exp(Math.max(-0.4, Math.min(0.4, e.deltaY * 0.0015))), r = c.getBoundingClientRect(), dx = e.clientX - r.left - r.width / 2, dy = e.clientY - r.top - r.height / 2; pan((k - 1) * dx, (k - 1) * dy); this.distance *= k; this.dirty = true; }, { passive: false, signal });
  }
}

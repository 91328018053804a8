// Draws a world with WebGL2: one instanced call for rounded boxes (which circles, capsules, boxes and segments are), one for
// other polygons, one for lines. Edges are signed distances, so they are smooth at any zoom.

const COMMON = `#version 300 es
precision highp float;
uniform vec2 uScale;      // clip units a metre
uniform float uPixels;    // pixels a metre
uniform float uSelected;  // index of a body, or -1
uniform int uTint;        // 0 own colours, 1 depth, 2 islands
uniform vec3 uPalette[8];
uniform vec3 uFixed, uKinematic, uSensor, uBack, uAccent;
uniform float uDim;
`;

const COLOUR = `
vec3 hue(float h) {
  return clamp(abs(fract(h + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}
vec3 depthColour(float d) {
  vec3 blue = vec3(0.25, 0.62, 0.95), green = vec3(0.27, 0.80, 0.48), yellow = vec3(0.96, 0.84, 0.30);
  vec3 orange = vec3(1.0, 0.6, 0.2), red = vec3(0.98, 0.24, 0.22), pink = vec3(1.0, 0.16, 0.75);
  if (d < 0.005) return mix(blue, green, d / 0.005);
  if (d < 0.01) return mix(green, yellow, (d - 0.005) / 0.005);
  if (d < 0.02) return mix(yellow, orange, (d - 0.01) / 0.01);
  if (d < 0.05) return mix(orange, red, (d - 0.02) / 0.03);
  return mix(red, pink, min(1.0, (d - 0.05) / 0.05));
}
vec4 colourOf(float style, float body, float tint) {
  int s = int(style + 0.5);
  int kind = s & 3;
  bool awake = (s & 4) != 0, sensor = (s & 8) != 0;
  vec3 colour = kind == 0 ? uFixed : kind == 1 ? uKinematic : uPalette[int(mod(body * 3.0 + floor(body / 8.0), 8.0))];
  if (uTint == 1 && kind != 0) colour = depthColour(max(tint, 0.0));
  if (uTint == 2 && kind == 2) colour = tint > 0.0 ? mix(vec3(0.62), hue(fract(tint * 0.61803)), 0.72) : uFixed;
  if (kind == 2 && !awake && uTint != 1) colour = mix(colour, uBack, uDim);
  return vec4(sensor ? uSensor : colour, sensor ? 0.22 : 1.0);
}
`;

const SHADE = `
uniform float uPixels;
uniform vec3 uBack, uAccent;
uniform float uSelected;
out vec4 outColour;
void shade(float d, vec4 colour, float body, float mark, float thin) {
  float px = d * uPixels;
  float cover = clamp(0.5 - px, 0.0, 1.0);
  bool chosen = abs(body - uSelected) < 0.5;
  float edge = chosen ? 3.0 : 1.4;
  // What is only a few pixels wide would be nothing but rim.
  float rim = clamp(px + edge + 0.5, 0.0, 1.0) * (chosen ? 1.0 : clamp((thin * uPixels - 1.5) / 5.0, 0.0, 1.0));
  vec3 dark = chosen ? uAccent : mix(colour.rgb, vec3(0.02, 0.03, 0.06), 0.42);
  vec3 rgb = mix(colour.rgb, dark, chosen ? rim : rim * 0.9);
  rgb = mix(rgb, dark, mark * 0.75);
  float alpha = cover * mix(colour.a, max(colour.a, 0.9), rim);
  if (alpha < 0.004) discard;
  outColour = vec4(rgb * alpha, alpha);
}
`;

const BOX_VERTEX = `${COMMON}${COLOUR}
layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 frame;
layout(location = 2) in vec4 size;   // half extents, radius, style
layout(location = 3) in vec2 what;   // body, tint
out vec2 vLocal; flat out vec4 vSize; flat out vec4 vColour; flat out float vBody;
void main() {
  float least = 1.2 / uPixels;
  float radius = (size.y == 0.0 && size.z == 0.0) ? least : size.z;
  vec2 reach = size.xy + radius + 1.5 / uPixels;
  vLocal = corner * reach;
  vSize = vec4(size.xy, radius, size.w);
  vColour = colourOf(size.w, what.x, what.y);
  vBody = what.x;
  vec2 turned = vec2(frame.z * vLocal.x - frame.w * vLocal.y, frame.w * vLocal.x + frame.z * vLocal.y);
  gl_Position = vec4((frame.xy + turned) * uScale, 0.0, 1.0);
}`;

const BOX_FRAGMENT = `#version 300 es
precision highp float;
${SHADE}
in vec2 vLocal; flat in vec4 vSize; flat in vec4 vColour; flat in float vBody;
void main() {
  vec2 q = abs(vLocal) - vSize.xy;
  float d = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - vSize.z;
  float mark = 0.0;
  if ((int(vSize.w + 0.5) & 16) != 0 && vSize.z * uPixels > 4.0) {
    float w = abs(vLocal.y) * uPixels;
    mark = clamp(1.4 - w, 0.0, 1.0) * step(0.0, vLocal.x);
  }
  shade(d, vColour, vBody, mark, min(vSize.x, vSize.y) + vSize.z);
}`;

const POLYGON_VERTEX = `${COMMON}${COLOUR}
layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 frame;
layout(location = 2) in vec4 size;   // radius, corners, style, body
layout(location = 3) in float tint;
layout(location = 4) in vec4 c0;
layout(location = 5) in vec4 c1;
layout(location = 6) in vec4 c2;
layout(location = 7) in vec4 c3;
out vec2 vLocal; flat out vec4 vSize; flat out vec4 vColour;
flat out float vThin; flat out vec4 v0; flat out vec4 v1; flat out vec4 v2; flat out vec4 v3;
void main() {
  vec2 low = min(min(min(c0.xy, c0.zw), min(c1.xy, c1.zw)), min(min(c2.xy, c2.zw), min(c3.xy, c3.zw)));
  vec2 high = max(max(max(c0.xy, c0.zw), max(c1.xy, c1.zw)), max(max(c2.xy, c2.zw), max(c3.xy, c3.zw)));
  float more = size.x + 1.5 / uPixels;
  vLocal = mix(low - more, high + more, corner * 0.5 + 0.5);
  vSize = size; vColour = colourOf(size.z, size.w, tint);
  vThin = 0.5 * min(high.x - low.x, high.y - low.y) + size.x;
  v0 = c0; v1 = c1; v2 = c2; v3 = c3;
  vec2 turned = vec2(frame.z * vLocal.x - frame.w * vLocal.y, frame.w * vLocal.x + frame.z * vLocal.y);
  gl_Position = vec4((frame.xy + turned) * uScale, 0.0, 1.0);
}`;

const POLYGON_FRAGMENT = `#version 300 es
precision highp float;
${SHADE}
in vec2 vLocal; flat in vec4 vSize; flat in vec4 vColour; flat in float vThin;
flat in vec4 v0; flat in vec4 v1; flat in vec4 v2; flat in vec4 v3;
void main() {
  vec2 c[8] = vec2[8](v0.xy, v0.zw, v1.xy, v1.zw, v2.xy, v2.zw, v3.xy, v3.zw);
  int n = int(vSize.y + 0.5);
  float d = dot(vLocal - c[0], vLocal - c[0]);
  bool inside = true;
  for (int i = 0; i < 8; i++) {
    if (i >= n) break;
    vec2 a = c[i], b = c[i + 1 < n ? i + 1 : 0];
    vec2 e = b - a, w = vLocal - a;
    vec2 r = w - e * clamp(dot(w, e) / dot(e, e), 0.0, 1.0);
    d = min(d, dot(r, r));
    inside = inside && e.x * w.y - e.y * w.x >= 0.0;
  }
  shade((inside ? -1.0 : 1.0) * sqrt(d) - vSize.x, vColour, vSize.w, 0.0, vThin);
}`;

const LINE_VERTEX = `${COMMON}
layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 ends;
layout(location = 2) in float width;
layout(location = 3) in vec4 colour;
out vec2 vLocal; flat out vec2 vSize; flat out vec4 vColour;
void main() {
  vec2 way = ends.zw - ends.xy;
  float len = length(way);
  vec2 along = len > 0.0 ? way / len : vec2(1.0, 0.0);
  float radius = 0.5 * width / uPixels;
  vec2 reach = vec2(0.5 * len, 0.0) + radius + 1.0 / uPixels;
  vLocal = corner * reach;
  vSize = vec2(0.5 * len, radius);
  vColour = colour;
  vec2 turned = vec2(along.x * vLocal.x - along.y * vLocal.y, along.y * vLocal.x + along.x * vLocal.y);
  gl_Position = vec4((0.5 * (ends.xy + ends.zw) + turned) * uScale, 0.0, 1.0);
}`;

const LINE_FRAGMENT = `#version 300 es
precision highp float;
uniform float uPixels;
in vec2 vLocal; flat in vec2 vSize; flat in vec4 vColour;
out vec4 outColour;
void main() {
  vec2 q = vec2(max(abs(vLocal.x) - vSize.x, 0.0), vLocal.y);
  float cover = clamp(0.5 - (length(q) - vSize.y) * uPixels, 0.0, 1.0) * vColour.a;
  outColour = vec4(vColour.rgb * cover, cover);
}`;

const GRID_VERTEX = `#version 300 es
layout(location = 0) in vec2 corner;
out vec2 vClip;
void main() { vClip = corner; gl_Position = vec4(corner, 0.0, 1.0); }`;

const GRID_FRAGMENT = `#version 300 es
precision highp float;
uniform vec2 uScale, uCamera;
uniform float uPixels, uCell;
uniform vec3 uBack, uGrid;
in vec2 vClip;
out vec4 outColour;
float lines(vec2 p, float cell) {
  vec2 near = abs(fract(p / cell + 0.5) - 0.5) * cell * uPixels;
  return clamp(1.0 - min(near.x, near.y), 0.0, 1.0);
}
void main() {
  vec2 p = vClip / uScale + uCamera;
  float strength = max(lines(p, uCell) * 0.45, lines(p, uCell * 5.0));
  float shadow = 1.0 - 0.022 * dot(vClip, vClip);
  outColour = vec4(mix(uBack, uGrid, strength) * shadow, 1.0);
}`;

const WATER_VERTEX = `${COMMON}
layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 surface;   // how far the camera is below it, the way out of it, phase
layout(location = 2) in vec4 area;      // left, bottom, right, top
out vec2 vPlace; flat out vec4 vSurface;
void main() {
  vec2 seen = 1.01 / uScale;
  vPlace = clamp(mix(area.xy, area.zw + vec2(0.0, 0.2), corner * 0.5 + 0.5), -seen, seen);
  vSurface = surface;
  gl_Position = vec4(vPlace * uScale, 0.0, 1.0);
}`;

const WATER_FRAGMENT = `#version 300 es
precision highp float;
uniform vec2 uScale;
uniform float uPixels, uFront;
uniform vec3 uWater, uDeep;
in vec2 vPlace; flat in vec4 vSurface;
out vec4 outColour;
void main() {
  vec2 up = vSurface.yz;
  float along = dot(vPlace, vec2(up.y, -up.x));
  float swell = clamp(0.05 * uPixels, 0.8, 3.0);
  float below = (vSurface.x - dot(vPlace, up)) * uPixels + swell * sin(1.9 * along + vSurface.w);
  float cover = clamp(below + 0.5, 0.0, 1.0);
  float depth = clamp(below * uScale.y / uPixels, 0.0, 1.0);
  float alpha = cover * mix(uFront > 0.0 ? 0.25 : 0.4, uFront > 0.0 ? 0.4 : 0.6, depth);
  vec3 colour = mix(uWater, uDeep, depth);
  float rim = uFront * clamp(1.5 - abs(below - 0.5), 0.0, 1.0);
  alpha = mix(alpha, 0.8, rim);
  outColour = vec4(mix(colour, mix(uWater, vec3(1.0), 0.55), rim) * alpha, alpha);
}`;

const LAYOUTS = {
  boxes: { floats: 10, parts: [4, 4, 2] },
  polygons: { floats: 25, parts: [4, 4, 1, 4, 4, 4, 4] },
  lines: { floats: 9, parts: [4, 1, 4] },
  waters: { floats: 8, parts: [4, 4] },
};
const NAMED = ["Fixed", "Kinematic", "Sensor", "Back", "Accent", "Grid", "Water", "Deep"];

export class Renderer {
  constructor(canvas) {
    this.canvas = canvas;
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, stencil: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("This browser has no WebGL2, which drawing needs.");
    this.gl = gl;
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.REPLACE);
    this.quad = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.quad);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), gl.STATIC_DRAW);
    this.passes = {
      grid: this.#pass(GRID_VERTEX, GRID_FRAGMENT),
      boxes: this.#pass(BOX_VERTEX, BOX_FRAGMENT, LAYOUTS.boxes),
      polygons: this.#pass(POLYGON_VERTEX, POLYGON_FRAGMENT, LAYOUTS.polygons),
      lines: this.#pass(LINE_VERTEX, LINE_FRAGMENT, LAYOUTS.lines),
      waters: this.#pass(WATER_VERTEX, WATER_FRAGMENT, LAYOUTS.waters),
    };
  }

  #shader(kind, source) {
    const { gl } = this;
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    return shader;
  }

  #pass(vertex, fragment, layout) {
    const { gl } = this;
    const program = gl.createProgram();
    gl.attachShader(program, this.#shader(gl.VERTEX_SHADER, vertex));
    gl.attachShader(program, this.#shader(gl.FRAGMENT_SHADER, fragment));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.quad);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
    let buffer;
    if (layout) {
      buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      let offset = 0;
      layout.parts.forEach((size, i) => {
        gl.enableVertexAttribArray(i + 1);
        gl.vertexAttribPointer(i + 1, size, gl.FLOAT, false, 4 * layout.floats, offset);
        gl.vertexAttribDivisor(i + 1, 1);
        offset += 4 * size;
      });
    }
    const places = new Map();
    const place = (name) => {
      if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
      return places.get(name);
    };
    return { program, array, buffer, layout, place };
  }

  /** Makes the canvas as large as it is shown. */
  fit() {
    const { canvas } = this;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    this.ratio = ratio;
  }

  /** Rows are views of the module's memory; camera: x, y, scale in pixels of the page a metre. */
  draw(rows, camera, look) {
    const { gl, canvas, passes } = this;
    const pixels = camera.scale * (look.ratio ?? this.ratio ?? 1);
    gl.viewport(0, 0, canvas.width, canvas.height);
    for (const pass of Object.values(passes)) this.#begin(pass, pixels, look);
    this.#grid(camera);
    const wet = rows.waters.length > 0;
    if (wet) this.#rows("waters", rows.waters, { uFront: 0 });
    const { boxes, polygons } = rows.still;
    // Water stands before what moves, but not before what stands still.
    if (wet) {
      gl.enable(gl.STENCIL_TEST);
      gl.clear(gl.STENCIL_BUFFER_BIT);
      gl.stencilFunc(gl.ALWAYS, 1, 1);
    }
    this.#rows("boxes", rows.boxes.subarray(0, boxes));
    this.#rows("polygons", rows.polygons.subarray(0, polygons));
    if (wet) gl.disable(gl.STENCIL_TEST);
    this.#rows("boxes", rows.boxes.subarray(boxes));
    this.#rows("polygons", rows.polygons.subarray(polygons));
    if (wet) {
      gl.enable(gl.STENCIL_TEST);
      gl.stencilFunc(gl.EQUAL, 0, 1);
      this.#rows("waters", rows.waters, { uFront: 1 });
      gl.disable(gl.STENCIL_TEST);
    }
    this.#rows("lines", rows.lines);
  }

  /** What all rows of a picture share. */
  #begin(pass, pixels, look) {
    const { gl, canvas } = this;
    gl.useProgram(pass.program);
    gl.uniform2f(pass.place("uScale"), (2 * pixels) / canvas.width, (2 * pixels) / canvas.height);
    gl.uniform1f(pass.place("uPixels"), pixels);
    gl.uniform1f(pass.place("uSelected"), look.selected ?? -1);
    gl.uniform1i(pass.place("uTint"), look.tint ?? 0);
    gl.uniform1f(pass.place("uDim"), look.dim);
    gl.uniform3fv(pass.place("uPalette"), look.palette);
    for (const name of NAMED) gl.uniform3fv(pass.place(`u${name}`), look[name.toLowerCase()]);
  }

  #grid(camera) {
    const { gl } = this;
    const { grid } = this.passes;
    const cell = gridCell(camera.scale);
    gl.useProgram(grid.program);
    // Only what is left of the camera's place beyond whole cells matters, so that it is exact far away.
    gl.uniform2f(grid.place("uCamera"), camera.x % (5 * cell), camera.y % (5 * cell));
    gl.uniform1f(grid.place("uCell"), cell);
    gl.bindVertexArray(grid.array);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }

  #rows(name, list, uniforms = {}) {
    if (!list.length) return;
    const { gl } = this;
    const pass = this.passes[name];
    gl.useProgram(pass.program);
    for (const [key, value] of Object.entries(uniforms)) gl.uniform1f(pass.place(key), value);
    gl.bindVertexArray(pass.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, pass.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, list, gl.STREAM_DRAW);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, list.length / pass.layout.floats);
  }
}

/** Metres between grid lines: 1, 2 or 5 times a power of ten, at least 22 pixels. */
export function gridCell(scale) {
  const least = 22 / scale;
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((part) => part * power).find((cell) => cell >= least) ?? 10 * power;
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

const BYTES_PER_POINT = 16; // src/io/report/map_points.h tells which.
const MODES = { photo: 0, segments: 1, classes: 2, ids: 3 };

const POINT_SHADER = `#version 300 es
layout(location = 0) in vec3 place;
layout(location = 1) in uint segment;
layout(location = 2) in uvec4 photo;
layout(location = 3) in vec2 folded;
layout(location = 4) in uint object;
uniform mat4 world_to_clip;
uniform vec3 low;
uniform vec3 eye;
uniform float step_size;
uniform float point_size;
uniform float max_size;
uniform int mode;
uniform uint selected;
uniform sampler2D class_colors;
flat out vec3 color;

vec3 normal() {
  vec3 n = vec3(folded, 1.0 - abs(folded.x) - abs(folded.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return normalize(n);
}

void main() {
  vec3 p = low + step_size * place;
  gl_Position = world_to_clip * vec4(p, 1.0);
  gl_PointSize = clamp(point_size / gl_Position.w, 1.0, max_size);
  vec3 rgb = vec3(photo.rgb) / 255.0;
  if (mode == 3) {
    color = vec3(float(object & 255u), float(object >> 8), 0.0) / 255.0;
    return;
  }
  float light = 0.58 + 0.42 * abs(dot(normal(), normalize(eye - p)));
  float luminance = dot(rgb, vec3(0.299, 0.587, 0.114));
  if (mode == 0) {
    color = rgb;
  } else if (mode == 1) {
    color = light * vec3(float(segment >> 11) / 31.0, float((segment >> 5) & 63u) / 63.0,
                         float(segment & 31u) / 31.0);
  } else if (photo.a == 0u) {
    color = vec3(0.2 + 0.45 * luminance);
  } else {
    color = light * (0.85 + 0.2 * luminance) * texelFetch(class_colors, ivec2(photo.a, 0), 0).rgb;
  }
  if (selected != 0u && object != selected) color = mix(color, vec3(luminance * 0.5 + 0.2), 0.45);
}`;

const LINE_SHADER = `#version 300 es
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 rgb;
uniform mat4 world_to_clip;
flat out vec3 color;
void main() {
  gl_Position = world_to_clip * vec4(place, 1.0);
  color = rgb;
}`;

// Round.
const POINT_COLOR_SHADER = `#version 300 es
precision mediump float;
flat in vec3 color;
out vec4 pixel;
void main() {
  vec2 offset = gl_PointCoord - 0.5;
  if (dot(offset, offset) > 0.25) discard;
  pixel = vec4(color, 1.0);
}`;

const COLOR_SHADER = `#version 300 es
precision mediump float;
flat in vec3 color;
uniform float opacity;
out vec4 pixel;
void main() { pixel = vec4(color, opacity); }`;

function decodeBase64(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

// "#rrggbb" or "rgb(r, g, b)" -> three numbers from 0 to 1.
function parseColor(text) {
  const hex = /^#(..)(..)(..)$/.exec(text.trim());
  if (hex) return hex.slice(1).map((part) => parseInt(part, 16) / 255);
  return (text.match(/[\d.]+/g) || [0, 0, 0]).slice(0, 3).map((part) => part / 255);
}

function buildProgram(gl, vertexSource, fragmentSource) {
  const program = gl.createProgram();
  const sources = [[gl.VERTEX_SHADER, vertexSource], [gl.FRAGMENT_SHADER, fragmentSource]];
  for (const [kind, source] of sources) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(gl.getProgramInfoLog(program));
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
    const { name } = gl.getActiveUniform(program, i);
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms };
}

// Draws the points and lines of a scene. What it draws is in its public fields.
class Renderer {
  constructor(gl, scene, bytes) {
    this.gl = gl;
    this.scene = scene;
    this.mode = "photo";
    this.selected = 0; // Place of an object from 1, 0 for none.
    this.background = [0.9, 0.9, 0.9];
    this.hidden = new Set(); // Names of sets of lines.
    this.points = buildProgram(gl, POINT_SHADER, POINT_COLOR_SHADER);
    this.lines = buildProgram(gl, LINE_SHADER, COLOR_SHADER);
    this.pointArray = this.uploadPoints(bytes);
    this.uploadClassColors();
    this.lineSets = new Map();
  }

  uploadPoints(bytes) {
    const gl = this.gl;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, bytes, gl.STATIC_DRAW);
    gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, false, BYTES_PER_POINT, 0);
    gl.vertexAttribIPointer(1, 1, gl.UNSIGNED_SHORT, BYTES_PER_POINT, 6);
    gl.vertexAttribIPointer(2, 4, gl.UNSIGNED_BYTE, BYTES_PER_POINT, 8);
    gl.vertexAttribPointer(3, 2, gl.BYTE, true, BYTES_PER_POINT, 12);
    gl.vertexAttribIPointer(4, 1, gl.UNSIGNED_SHORT, BYTES_PER_POINT, 14);
    for (let i = 0; i < 5; ++i) gl.enableVertexAttribArray(i);
    return array;
  }

  uploadClassColors() {
    const gl = this.gl;
    const colors = new Uint8Array(256 * 4).fill(255);
    this.scene.classes.slice(0, 255).forEach((entry, i) => {
      colors.set(parseColor(entry.color).map((c) => Math.round(255 * c)), 4 * (i + 1));
    });
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, colors);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  }

  // Pairs of end points with the colour of their line, replacing those of that name.
  setLines(name, segments) {
    const gl = this.gl;
    const old = this.lineSets.get(name);
    if (old) {
      gl.deleteBuffer(old.buffer);
      gl.deleteVertexArray(old.array);
    }
    const numbers = segments.flatMap(([a, b, color]) => [...a, ...color, ...b, ...color]);
    const set = { array: gl.createVertexArray(), buffer: gl.createBuffer(),
                  count: 2 * segments.length };
    gl.bindVertexArray(set.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, set.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 24, 0);
    gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 24, 12);
    gl.enableVertexAttribArray(0);
    gl.enableVertexAttribArray(1);
    this.lineSets.set(name, set);
  }

  // Of the points only a part, larger, to be quick.
  draw(camera, share = 1) {
    const gl = this.gl;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(...this.background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    const matrix = camera.matrix();
    this.drawPoints(camera, matrix, MODES[this.mode], share);
    this.drawLines(matrix);
  }

  drawPoints(camera, matrix, mode, share) {
    const { gl, scene } = this;
    const { program, uniforms } = this.points;
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniforms.world_to_clip, false, matrix);
    gl.uniform3fv(uniforms.low, scene.low);
    gl.uniform3fv(uniforms.eye, camera.eye());
    gl.uniform1f(uniforms.step_size, scene.step);
    const pixelsPerTangent = gl.drawingBufferHeight / (2 * camera.tangent);
    const width = (1.6 * scene.spacing) / Math.sqrt(share);
    gl.uniform1f(uniforms.point_size, width * pixelsPerTangent);
    gl.uniform1f(uniforms.max_size, gl.drawingBufferHeight / 12);
    gl.uniform1i(uniforms.mode, mode);
    gl.uniform1ui(uniforms.selected, this.selected);
    gl.bindVertexArray(this.pointArray);
    gl.drawArrays(gl.POINTS, 0, Math.ceil(share * scene.points));
  }

  // What is behind the points shines through.
  drawLines(matrix) {
    const gl = this.gl;
    const { program, uniforms } = this.lines;
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniforms.world_to_clip, false, matrix);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    for (const isHidden of [true, false]) {
      gl.depthFunc(isHidden ? gl.GREATER : gl.LEQUAL);
      gl.depthMask(!isHidden);
      gl.uniform1f(uniforms.opacity, isHidden ? 0.3 : 1);
      for (const [name, set] of this.lineSets) {
        if (this.hidden.has(name)) continue;
        gl.bindVertexArray(set.array);
        gl.drawArrays(gl.LINES, 0, set.count);
      }
    }
    gl.depthFunc(gl.LEQUAL);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }

  // Place from 1 of the object at a pixel from the lower left, 0 for none.
  objectAt(camera, x, y) {
    const gl = this.gl;
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    const buffers = [[gl.COLOR_ATTACHMENT0, gl.RGBA8], [gl.DEPTH_ATTACHMENT, gl.DEPTH_COMPONENT16]]
      .map(([attachment, format]) => {
        const buffer = gl.createRenderbuffer();
        gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
        gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
        return buffer;
      });
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 1);
    gl.enable(gl.DEPTH_TEST);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.drawPoints(camera, camera.matrix(), MODES.ids, 1);
    const pixel = new Uint8Array(4);
    gl.readPixels(x, y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    buffers.forEach((buffer) => gl.deleteRenderbuffer(buffer));
    gl.deleteFramebuffer(frame);
    return pixel[0] + 256 * pixel[1];
  }
}

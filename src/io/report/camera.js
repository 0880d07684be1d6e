// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Vectors are arrays of three numbers.
const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const scale = (a, factor) => [a[0] * factor, a[1] * factor, a[2] * factor];
const subtract = (a, b) => add(a, scale(b, -1));
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const normalize = (a) => scale(a, 1 / (Math.hypot(...a) || 1));
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

// Of a view that looks at a target from all around. Angles in radians: yaw 0 looks forward, pitch
// above 0 looks down.
class OrbitCamera {
  constructor(scene) {
    this.scene = scene;
    this.tangent = Math.tan(0.42); // Of half the vertical field of view.
    this.aspect = 1;
    this.home = { target: [0, 0, 0], yaw: 0, pitch: 0.6, distance: 3 };
    this.state = this.home;
    this.radius = 1; // Of what there is to see, metres.
  }

  // Shows the middle nine tenths of these positions.
  fit(positions) {
    if (positions.length === 0) return;
    const { right, forward, up } = this.scene;
    let target = [0, 0, 0];
    const sizes = [right, forward, up].map((axis) => {
      const values = positions.map((p) => dot(p, axis)).sort((a, b) => a - b);
      const low = values[Math.floor(0.05 * (values.length - 1))];
      const high = values[Math.ceil(0.95 * (values.length - 1))];
      target = add(target, scale(axis, 0.5 * (low + high)));
      return high - low;
    });
    this.radius = Math.max(0.5 * Math.hypot(...sizes), 0.1);
    const narrow = this.tangent * Math.min(1, this.aspect);
    const margin = this.aspect < 1 ? 1.05 : 0.9;
    const distance = (margin * this.radius) / Math.sin(Math.atan(narrow));
    this.home = { target, yaw: 0.35, pitch: 0.6, distance };
    this.state = this.home;
  }

  // From the target to the eye.
  direction(state = this.state) {
    const { right, forward, up } = this.scene;
    const level = add(scale(right, Math.sin(state.yaw)), scale(forward, Math.cos(state.yaw)));
    return add(scale(level, -Math.cos(state.pitch)), scale(up, Math.sin(state.pitch)));
  }

  eye() {
    return add(this.state.target, scale(this.direction(), this.state.distance));
  }

  // The camera's axes in the world: to the right, up, backwards.
  axes() {
    const back = this.direction();
    const right = normalize(cross(this.scene.up, back));
    return [right, cross(back, right), back];
  }

  // World to clip space, column by column.
  matrix() {
    const [x, y, z] = this.axes();
    const eye = this.eye();
    const near = Math.max(0.005, 0.02 * this.state.distance);
    const far = this.state.distance + 8 * this.radius + 10;
    const fy = 1 / this.tangent;
    const fx = fy / this.aspect;
    const a = (far + near) / (near - far);
    const b = (2 * far * near) / (near - far);
    const columns = [0, 1, 2].map((i) => [fx * x[i], fy * y[i], a * z[i], -z[i]]);
    const offset = [x, y, z].map((axis) => -dot(axis, eye));
    return new Float32Array(
      [...columns, [fx * offset[0], fy * offset[1], a * offset[2] + b, -offset[2]]].flat());
  }

  turn(yaw, pitch) {
    const limit = 1.55;
    this.state = {
      ...this.state,
      yaw: this.state.yaw + yaw,
      pitch: clamp(this.state.pitch + pitch, -limit, limit),
    };
  }

  // By parts of the view's height.
  move(right, up) {
    const [x, y] = this.axes();
    const metres = 2 * this.tangent * this.state.distance;
    const shift = add(scale(x, -right * metres), scale(y, -up * metres));
    this.state = { ...this.state, target: add(this.state.target, shift) };
  }

  zoom(factor) {
    const distance = clamp(this.state.distance * factor, 0.05, 20 * this.radius + 10);
    this.state = { ...this.state, distance };
  }

  // States to fly to.
  lookingAt(target, eye, distance) {
    const { right, forward, up } = this.scene;
    const offset = normalize(subtract(eye, target));
    const yaw = Math.atan2(-dot(offset, right), -dot(offset, forward));
    return { target, yaw, pitch: Math.asin(clamp(dot(offset, up), -0.99, 0.99)), distance };
  }

  seeing(object) {
    const size = Math.hypot(...object.half);
    const eye = object.eye || this.eye();
    const state = this.lookingAt(object.center, eye, Math.max(4.2 * size, 0.3));
    return { ...state, pitch: clamp(state.pitch, 0.25, 1.2) };
  }

  at(keyframe) {
    const forward = [2, 5, 8].map((i) => keyframe.axes[i]);
    return this.lookingAt(add(keyframe.position, forward), keyframe.position, 1);
  }

  static between(a, b, fraction) {
    const turn = Math.atan2(Math.sin(b.yaw - a.yaw), Math.cos(b.yaw - a.yaw)); // The short way.
    return {
      target: add(scale(a.target, 1 - fraction), scale(b.target, fraction)),
      yaw: a.yaw + fraction * turn,
      pitch: a.pitch + fraction * (b.pitch - a.pitch),
      distance: a.distance * (b.distance / a.distance) ** fraction,
    };
  }
}

// Mouse, touch and keys on a canvas. Calls changed() after each change, and clicked(x, y) with
// pixels of the page's.
function steer(canvas, camera, changed, clicked) {
  const pointers = new Map();
  let wasDragged = false;
  const center = () => {
    const all = [...pointers.values()];
    return all.reduce((sum, p) => [sum[0] + p.x / all.length, sum[1] + p.y / all.length], [0, 0]);
  };
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  };

  canvas.addEventListener("pointerdown", (event) => {
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    if (pointers.size === 0) wasDragged = false;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", (event) => {
    const pointer = pointers.get(event.pointerId);
    if (!pointer) return;
    const [before, spreadBefore] = [center(), spread()];
    if (Math.hypot(event.clientX - pointer.x, event.clientY - pointer.y) < 3 && !wasDragged) return;
    wasDragged = true;
    Object.assign(pointer, { x: event.clientX, y: event.clientY });
    const [dx, dy] = center().map((value, i) => (value - before[i]) / canvas.clientHeight);
    const moves = pointers.size > 1 || event.buttons & 2 || event.shiftKey || event.ctrlKey;
    if (moves) camera.move(dx, -dy);
    else camera.turn(-4 * dx, 4 * dy);
    if (spreadBefore > 0 && spread() > 0) camera.zoom(spreadBefore / spread());
    changed();
  });
  const release = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (event.type === "pointerup" && event.button === 0 && !wasDragged)
      clicked(event.clientX, event.clientY);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    // Without a click before, the page scrolls.
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    camera.zoom(Math.exp(clamp(event.deltaY, -120, 120) * 0.0022));
    changed();
  }, { passive: false });
  const keys = {
    ArrowLeft: () => camera.turn(0.08, 0),
    ArrowRight: () => camera.turn(-0.08, 0),
    ArrowUp: () => camera.turn(0, 0.06),
    ArrowDown: () => camera.turn(0, -0.06),
    "+": () => camera.zoom(0.88),
    "=": () => camera.zoom(0.88),
    "-": () => camera.zoom(1.14),
  };
  canvas.addEventListener("keydown", (event) => {
    const action = keys[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
    changed();
  });
}

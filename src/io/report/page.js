// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

const byId = (id) => document.getElementById(id);
const cssColor = (name) =>
  parseColor(getComputedStyle(document.documentElement).getPropertyValue(name));

// The twelve edges of an object's box.
function boxEdges(object, color) {
  const axis = (i) => [0, 3, 6].map((row) => object.half[i] * object.axes[row + i]);
  const corner = (bits) => [0, 1, 2].reduce(
    (point, i) => add(point, scale(axis(i), bits >> i & 1 ? 1 : -1)), object.center);
  const edges = [];
  for (let bits = 0; bits < 8; ++bits) {
    for (const bit of [1, 2, 4]) {
      if (!(bits & bit)) edges.push([corner(bits), corner(bits | bit), color]);
    }
  }
  return edges;
}

// Of an object's box above its centre.
const heightOf = (object, up) => object.half.reduce((sum, half, i) =>
  sum + half * Math.abs(dot([0, 3, 6].map((row) => object.axes[row + i]), up)), 0);

// What the camera saw, as a pyramid.
function frustumEdges(keyframe, scene, color) {
  const depth = 0.08;
  const tip = keyframe.position;
  const place = (x, y) => [0, 3, 6].map((row, i) => tip[i] + depth * (
    x * scene.aspect * scene.tangent * keyframe.axes[row] +
    y * scene.tangent * keyframe.axes[row + 1] + keyframe.axes[row + 2]));
  const corners = [place(-1, -1), place(1, -1), place(1, 1), place(-1, 1)];
  return corners.flatMap((corner, i) =>
    [[tip, corner, color], [corner, corners[(i + 1) % 4], color]]);
}

const pathEdges = (path, color) =>
  path.flatMap((line) => line.slice(1).map((point, i) => [line[i], point, color]));

// The view and all that is on the page for it.
class View {
  constructor(scene, bytes) {
    this.scene = scene;
    this.bytes = bytes;
    this.canvas = byId("canvas");
    this.camera = new OrbitCamera(scene);
    this.names = [];
    this.share = 1; // Of the points, while something moves.
    this.frame = 0; // Request of the next drawing, or 0.
    this.start();
    this.resize();
    this.camera.fit(this.somePositions());
    this.makeNames();
    this.makeLegend();
    this.connect();
    this.follow();
  }

  // Throws if there is no WebGL 2.
  start() {
    const options = { antialias: true, preserveDrawingBuffer: true };
    const gl = this.canvas.getContext("webgl2", options);
    if (!gl) throw new Error("no WebGL 2");
    this.renderer = new Renderer(gl, this.scene, this.bytes);
    this.recolor();
  }

  recolor() {
    const { scene, renderer } = this;
    renderer.background = cssColor("--view");
    const path = cssColor("--estimate");
    renderer.setLines("path", [...pathEdges(scene.path, path),
      ...scene.keyframes.flatMap((keyframe) => frustumEdges(keyframe, scene, path))]);
    renderer.setLines("objects", scene.objects.flatMap(
      (object) => boxEdges(object, parseColor(this.colorOf(object)))));
  }

  colorOf(object) {
    return object.class ? this.scene.classes[object.class - 1].color : "#969696";
  }

  // The order of the points is such that the first ones are everywhere.
  somePositions() {
    const count = Math.min(this.scene.points, 5000);
    const view = new DataView(this.bytes.buffer);
    const { low, step } = this.scene;
    return Array.from({ length: count }, (_, i) => low.map(
      (value, axis) => value + step * view.getUint16(BYTES_PER_POINT * i + 2 * axis, true)));
  }

  makeNames() {
    this.names = this.scene.objects.map((object) => {
      const name = document.createElement("span");
      name.textContent = object.class ? this.scene.classes[object.class - 1].name : "?";
      name.style.borderLeftColor = this.colorOf(object);
      byId("names").append(name);
      return name;
    });
  }

  makeLegend() {
    const counts = new Uint32Array(256);
    for (let i = 11; i < this.bytes.length; i += BYTES_PER_POINT) ++counts[this.bytes[i]];
    this.scene.classes.forEach((entry, i) => {
      if (i >= 255 || !counts[i + 1]) return;
      const item = document.createElement("span");
      const chip = document.createElement("span");
      chip.className = "chip";
      chip.style.background = entry.color;
      item.append(chip, entry.name);
      byId("legend").append(item);
    });
  }

  connect() {
    steer(this.canvas, this.camera, () => this.touch(), (x, y) => this.pick(x, y));
    for (const input of document.querySelectorAll("input[name=mode]"))
      input.addEventListener("change", () => this.follow());
    for (const id of ["show-objects", "show-path"])
      byId(id).addEventListener("change", () => this.follow());
    byId("reset").addEventListener("click", () => {
      this.select(0);
      this.fly(this.camera.home);
    });
    for (const row of document.querySelectorAll("[data-object]"))
      row.addEventListener("click", () => this.show(Number(row.dataset.object) + 1));
    for (const item of document.querySelectorAll("[data-keyframe]")) {
      item.addEventListener("click", () => {
        this.reveal();
        this.fly(this.camera.at(this.scene.keyframes[item.dataset.keyframe]));
      });
    }
    new ResizeObserver(() => {
      this.resize();
      this.draw();
    }).observe(this.canvas);
    for (const query of ["(prefers-color-scheme: dark)", "print"]) {
      matchMedia(query).addEventListener("change", () => {
        this.recolor();
        this.draw();
      });
    }
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.start();
      this.follow();
    });
  }

  // Takes over what the controls say.
  follow() {
    this.renderer.mode = document.querySelector("input[name=mode]:checked").value;
    const { hidden } = this.renderer;
    for (const name of ["objects", "path"])
      byId("show-" + name).checked ? hidden.delete(name) : hidden.add(name);
    this.canvas.dataset.mode = this.renderer.mode;
    this.draw();
  }

  resize() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    this.canvas.width = Math.max(1, Math.round(ratio * width));
    this.canvas.height = Math.max(1, Math.round(ratio * height));
    this.camera.aspect = this.canvas.width / this.canvas.height;
  }

  draw(share = 1) {
    this.renderer.draw(this.camera, share);
    this.placeNames();
    this.canvas.dataset.eye = this.camera.eye().map((x) => x.toFixed(3)).join(" ");
  }

  placeNames() {
    const m = this.camera.matrix();
    const isHidden = this.renderer.hidden.has("objects");
    this.scene.objects.forEach((object, i) => {
      const top = add(object.center, scale(this.scene.up, heightOf(object, this.scene.up)));
      const clip = (row) => m[row] * top[0] + m[4 + row] * top[1] + m[8 + row] * top[2] + m[12 + row];
      const w = clip(3);
      const style = this.names[i].style;
      this.names[i].hidden = isHidden || w <= 0;
      const x = (0.5 + 0.5 * clip(0) / w) * this.canvas.clientWidth;
      const y = (0.5 - 0.5 * clip(1) / w) * this.canvas.clientHeight;
      style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -110%)`;
    });
  }

  // Something moved: draws soon, as many points as it can quickly, and all of them at rest.
  touch() {
    this.endFlight();
    this.request();
    this.settle();
  }

  settle() {
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.draw(), 160);
  }

  request() {
    if (this.frame) return;
    this.frame = requestAnimationFrame((now) => {
      this.frame = 0;
      this.adapt(now);
      if (this.flight) this.advance(now);
      this.draw(this.share);
      if (this.flight) this.request();
    });
  }

  // Aims at 25 to 50 pictures a second.
  adapt(now) {
    const elapsed = now - (this.before || 0);
    this.before = now;
    if (elapsed > 400) return; // It was at rest.
    if (elapsed > 40) this.share = Math.max(0.05, 0.75 * this.share);
    else if (elapsed < 20) this.share = Math.min(1, 1.1 * this.share);
  }

  fly(state) {
    const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.flight = { from: this.camera.state, to: state, seconds: isStill ? 0 : 0.8 };
    this.canvas.dataset.flies = "yes";
    this.request();
  }

  endFlight() {
    this.flight = null;
    this.canvas.dataset.flies = "no";
  }

  advance(now) {
    const flight = this.flight;
    flight.start ??= now;
    const time = flight.seconds ? Math.min(1, (now - flight.start) / (1000 * flight.seconds)) : 1;
    const eased = time * time * (3 - 2 * time);
    this.camera.state = time < 1 ? OrbitCamera.between(flight.from, flight.to, eased) : flight.to;
    if (time < 1) return;
    this.endFlight();
    this.settle();
  }

  // Place of an object from 1, 0 for none.
  select(place) {
    this.renderer.selected = place;
    this.names.forEach((name, i) => name.classList.toggle("selected", i + 1 === place));
    for (const row of document.querySelectorAll("[data-object]"))
      row.classList.toggle("selected", Number(row.dataset.object) + 1 === place);
  }

  show(place) {
    this.select(place);
    this.reveal();
    this.fly(this.camera.seeing(this.scene.objects[place - 1]));
  }

  reveal() {
    byId("map").scrollIntoView({ block: "start" });
  }

  pick(x, y) {
    const rectangle = this.canvas.getBoundingClientRect();
    const ratio = this.canvas.width / rectangle.width;
    const place = this.renderer.objectAt(
      this.camera, Math.floor(ratio * (x - rectangle.left)),
      Math.floor(ratio * (rectangle.bottom - y)));
    this.select(place);
    if (place) this.fly(this.camera.seeing(this.scene.objects[place - 1]));
    else this.draw();
  }
}

function main() {
  const scene = JSON.parse(byId("scene").textContent);
  if (scene.points === 0) {
    byId("message").textContent = "The map is empty: there are no points to show.";
    return;
  }
  try {
    const view = new View(scene, decodeBase64(byId("points").textContent));
    byId("message").hidden = true;
    byId("controls").hidden = false;
    view.draw();
  } catch (error) {
    byId("message").textContent =
      `The interactive view is not there (${error.message}). All else on this page works.`;
  }
}

main();

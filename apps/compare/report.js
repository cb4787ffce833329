"use strict";
(() => {
  const report = JSON.parse(document.getElementById("data").textContent);
  const byId = (id) => document.getElementById(id);
  const view = byId("view"), pen = view.getContext("2d");
  const state = { layer: 0, mode: "slider", zoom: 1, x: 0, y: 0, split: 0.5, exposure: 0, flickerSide: "a", flickerMs: 500 };
  let current = null;  // what has been decoded of the layer that is shown

  // --- pixels ---------------------------------------------------------------------------------------------------------

  function bytesOf(id) {
    const text = atob(byId(id).textContent.trim()), bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes.buffer;
  }

  function floatOfHalf(half) {
    const sign = half & 0x8000 ? -1 : 1, exponent = (half >> 10) & 31, fraction = half & 1023;
    if (exponent === 0) return sign * fraction * 2 ** -24;
    if (exponent === 31) return fraction ? NaN : sign * Infinity;
    return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
  }
  const halfValues = new Float32Array(65536);
  for (let half = 0; half < 65536; ++half) halfValues[half] = floatOfHalf(half);

  function encode(value, layer) {  // a stored value as 0 to 255
    if (layer.kind === "data") value = (value - layer.low) / (layer.high - layer.low || 1);
    else if (layer.kind === "linear") {
      value *= 2 ** state.exposure;
      value = value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055;
    }
    return value > 0 ? Math.min(255, Math.round(value * 255)) : 0;  // NaN too is black
  }

  function canvasOf(width, height) {
    const canvas = document.createElement("canvas");
    canvas.width = width, canvas.height = height;
    return canvas;
  }

  function canvasOfPicture(id, layer) {
    const canvas = canvasOf(layer.width, layer.height);
    canvas.getContext("2d", { willReadFrequently: true }).drawImage(byId(id), 0, 0);
    return canvas;
  }

  // An image with values beyond its picture: those of every channel, and a canvas that follows the exposure.
  class Values {
    constructor(id, layer) {
      this.layer = layer, this.channels = layer.channels.length;
      this.halves = layer.format === "half" ? new Uint16Array(bytesOf(id)) : null;
      this.floats = this.halves ? null : new Float32Array(bytesOf(id));
      this.canvas = canvasOf(layer.width, layer.height);
    }
    at(index) { return this.halves ? halfValues[this.halves[index]] : this.floats[index]; }
    pixel(x, y) {
      const first = (y * this.layer.width + x) * this.channels;
      return Array.from({ length: this.channels }, (_, c) => this.at(first + c));
    }
    paint() {
      const pen = this.canvas.getContext("2d"), picture = pen.createImageData(this.layer.width, this.layer.height);
      const out = picture.data, count = this.channels;
      let shade = (index) => encode(this.floats[index], this.layer);
      if (this.halves) {
        const table = new Uint8Array(65536);
        for (let half = 0; half < 65536; ++half) table[half] = encode(halfValues[half], this.layer);
        shade = (index) => table[this.halves[index]];
      }
      for (let i = 0, from = 0; i < out.length; i += 4, from += count) {
        for (let c = 0; c < 3; ++c) out[i + c] = shade(from + (c < count ? c : count < 3 ? 0 : 2));
        out[i + 3] = 255;
      }
      pen.putImageData(picture, 0, 0);
    }
  }

  // A picture of 8 bits is its own values.
  class Picture {
    constructor(id, layer) { this.canvas = canvasOfPicture(id, layer); }
    pixel(x, y) { return Array.from(this.canvas.getContext("2d").getImageData(x, y, 1, 1).data.slice(0, 3)); }
    paint() {}
  }

  const shades = new Map(report.colors.map((color, i) => [color.join(), i]));

  function showLayer(index) {
    const layer = report.layers[index], Kind = layer.format === "picture" ? Picture : Values;
    const prefix = layer.format === "picture" ? "picture-" : "values-";
    const sized = !current || current.layer.width !== layer.width || current.layer.height !== layer.height;
    state.layer = index;
    current = { layer, a: new Kind(prefix + "a" + index, layer), b: new Kind(prefix + "b" + index, layer),
                map: canvasOfPicture("picture-map" + index, layer) };
    byId("layer").value = index;
    byId("exposure-group").hidden = layer.kind !== "linear";
    document.querySelectorAll(".layer").forEach((section, i) => { section.hidden = i !== index; });
    paint();
    if (sized) fit(); else draw();
  }

  function paint() { current.a.paint(), current.b.paint(); }

  // --- drawing --------------------------------------------------------------------------------------------------------

  // state.x and state.y are the image's upper left corner on the stage, in its pixels.
  function draw() {
    const { layer, a, b, map } = current, width = view.width, height = view.height;
    pen.fillStyle = "#222";
    pen.fillRect(0, 0, width, height);
    pen.imageSmoothingEnabled = state.zoom < 1;
    const put = (canvas) => pen.drawImage(canvas, state.x, state.y, layer.width * state.zoom, layer.height * state.zoom);
    const shown = state.mode === "flicker" ? state.flickerSide : state.mode;
    if (shown === "map") put(map);
    else if (shown !== "slider") put(shown === "a" ? a.canvas : b.canvas);
    else {
      const line = splitX();
      for (const [canvas, left, right] of [[a.canvas, 0, line], [b.canvas, line, width]]) {
        pen.save(), pen.beginPath(), pen.rect(left, 0, right - left, height), pen.clip();
        put(canvas);
        pen.restore();
      }
      pen.fillStyle = "#fff";
      pen.fillRect(line - 1, 0, 2, height);
    }
    byId("shown").textContent = { a: "A", b: "B", map: layer.mapName, slider: "A | B" }[shown];
    byId("zoom").textContent = (state.zoom * 100).toPrecision(3) * 1 + " %";
    byId("exposure-value").textContent = (state.exposure > 0 ? "+" : "") + state.exposure;
    byId("exposure").value = state.exposure;
    document.querySelectorAll("#modes button").forEach((button) => {
      button.classList.toggle("on", button.dataset.mode === state.mode);
    });
  }

  // The line of the slider lies at this share of the image's width, wherever the image is.
  function splitX() { return Math.round(state.x + state.split * current.layer.width * state.zoom); }

  function resize() {
    view.width = view.clientWidth, view.height = view.clientHeight;
    draw();
  }

  function fit() {
    view.width = view.clientWidth, view.height = view.clientHeight;
    const { width, height } = current.layer;
    const zoom = Math.min(view.width / width, view.height / height);
    state.zoom = zoom > 1 ? Math.min(Math.floor(zoom), 16) : zoom;
    center();
  }

  function center() {
    state.x = Math.round((view.width - current.layer.width * state.zoom) / 2);
    state.y = Math.round((view.height - current.layer.height * state.zoom) / 2);
    draw();
  }

  // The image's point under (x, y) of the stage stays there.
  function zoomTo(zoom, x = view.width / 2, y = view.height / 2) {
    zoom = Math.min(128, Math.max(1 / 32, zoom));
    state.x = x - (x - state.x) * zoom / state.zoom, state.y = y - (y - state.y) * zoom / state.zoom;
    state.zoom = zoom;
    draw();
  }

  function setMode(mode) { state.mode = mode, state.flickerSide = "a", draw(); }

  function setExposure(stops) {
    if (current.layer.kind !== "linear") return;
    state.exposure = Math.min(12, Math.max(-12, stops));
    paint(), draw();
  }

  function setSplit(split) { state.split = Math.min(1, Math.max(0, split)), draw(); }

  setInterval(() => {
    if (state.mode !== "flicker") return;
    state.flickerSide = state.flickerSide === "a" ? "b" : "a";
    draw();
  }, state.flickerMs);

  // --- the pixel under the pointer ------------------------------------------------------------------------------------

  function pixelAt(x, y) {
    const column = Math.floor((x - state.x) / state.zoom), row = Math.floor((y - state.y) / state.zoom);
    const { width, height } = current.layer;
    return column >= 0 && row >= 0 && column < width && row < height ? { x: column, y: row } : null;
  }

  function describe({ x, y }) {
    const { layer, a, b, map } = current;
    const number = (value) => layer.format === "picture" ? String(value).padStart(3) : value.toPrecision(4).padStart(10);
    const values = (image) => image.pixel(x, y).map(number).join(" ");
    const color = map.getContext("2d").getImageData(x, y, 1, 1).data.slice(0, 3).join();
    const shade = shades.has(color) ? (shades.get(color) / 255 * layer.mapLargest).toPrecision(3) : "?";
    return `${x},${y}  A ${values(a)}   B ${values(b)}   ${layer.mapName} ${shade}`;
  }

  function point(event) {
    const place = pixelAt(event.offsetX, event.offsetY);
    byId("pixel").textContent = place ? describe(place) : "\u00a0";
  }

  // --- pointer and keys -----------------------------------------------------------------------------------------------

  let drag = null;
  view.addEventListener("pointerdown", (event) => {
    drag = { x: event.offsetX, y: event.offsetY };
    view.setPointerCapture(event.pointerId);
    view.focus();
    if (state.mode === "slider") setSplit((event.offsetX - state.x) / (current.layer.width * state.zoom));
  });
  view.addEventListener("pointermove", (event) => {
    point(event);
    if (!drag) return;
    if (state.mode === "slider") return setSplit((event.offsetX - state.x) / (current.layer.width * state.zoom));
    state.x += event.offsetX - drag.x, state.y += event.offsetY - drag.y;
    drag = { x: event.offsetX, y: event.offsetY };
    draw();
  });
  for (const end of ["pointerup", "pointercancel"]) view.addEventListener(end, () => { drag = null; });
  view.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoomTo(state.zoom * (event.deltaY < 0 ? 1.25 : 0.8), event.offsetX, event.offsetY);
    point(event);
  }, { passive: false });

  function move(dx, dy) { state.x += dx, state.y += dy, draw(); }
  const step = 40;
  const keys = {
    "1": () => setMode("a"), "2": () => setMode("b"), "3": () => setMode("map"),
    s: () => setMode("slider"), f: () => setMode("flicker"),
    "+": () => zoomTo(state.zoom * 2), "=": () => zoomTo(state.zoom * 2), "-": () => zoomTo(state.zoom / 2),
    "0": fit, "9": () => { state.zoom = 1, center(); },
    "[": () => setExposure(state.exposure - 0.5), "]": () => setExposure(state.exposure + 0.5),
    "\\": () => setExposure(0),
    l: () => showLayer((state.layer + 1) % report.layers.length),
    "?": () => { byId("keys").hidden = !byId("keys").hidden; },
    ArrowLeft: () => state.mode === "slider" ? setSplit(state.split - 0.02) : move(step, 0),
    ArrowRight: () => state.mode === "slider" ? setSplit(state.split + 0.02) : move(-step, 0),
    ArrowUp: () => move(0, step), ArrowDown: () => move(0, -step),
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("select, input")) return;
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });

  document.querySelectorAll("#modes button").forEach((button) => {
    button.addEventListener("click", () => setMode(button.dataset.mode));
  });
  byId("zoom-in").addEventListener("click", keys["+"]);
  byId("zoom-out").addEventListener("click", keys["-"]);
  byId("zoom-fit").addEventListener("click", fit);
  byId("zoom-one").addEventListener("click", keys["9"]);
  byId("help").addEventListener("click", keys["?"]);
  byId("exposure").addEventListener("input", (event) => setExposure(Number(event.target.value)));
  byId("layer").addEventListener("change", (event) => showLayer(Number(event.target.value)));
  window.addEventListener("resize", resize);

  // --- start ----------------------------------------------------------------------------------------------------------

  report.layers.forEach((layer, i) => byId("layer").append(new Option(layer.name, i)));
  byId("layer").hidden = report.layers.length < 2;
  window.addEventListener("load", () => {  // the pictures are decoded by then
    document.body.className = "live";
    byId("viewer").hidden = false;
    showLayer(0);
    view.focus();
    document.body.dataset.ready = "yes";  // for tests
  });
})();

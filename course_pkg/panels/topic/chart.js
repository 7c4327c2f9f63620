/* A line chart of one number over time. This code draws the chart without a library, because a notebook
   sends the code with every widget, and uPlot, the smallest library that was considered, has 50 kB. uPlot
   draws on a canvas, which is not sharp in print and does not follow the theme. */
import { axis, place, reading } from "../axes.js";
import { h, say } from "../kit.js";

/** @typedef {[number, number]} Point */
/** @typedef {import("../axes.js").Axis} Axis */
/** @typedef {{y: string, points: Point[], count: number, window: [number, number]}} Drawing */

const SPACE = "http://www.w3.org/2000/svg";
const X = "time since the subscription began (s)";
const HEIGHT = 264; // px
const TOP = 28; // The name of the vertical axis has this many px.
const BOTTOM = 44; // The ticks and the name of the horizontal axis have this many px.
const LETTER = 6.8; // A digit of 12 px is about this many px wide.
const APART = 8; // If the average distance between points is at least this many px, the line has markers.
const R = 4; // The radius of a marker is this many px.

export class Chart {
  constructor() {
    this.width = 640;
    /** @type {number | null} the index of the point whose values are shown */
    this.at = null;
    this.canvas = h("div", { class: "ros-chart-canvas", role: "group", tabindex: "0", "data-lm-suppress-shortcuts": "true",
      "aria-label": "Plot: the arrow keys read its points",
      onpointermove: (/** @type {PointerEvent} */ event) => this.#point(event), onpointerleave: () => this.#read(null),
      onblur: () => this.#read(null), onkeydown: (/** @type {KeyboardEvent} */ event) => this.#key(event) });
    this.readout = h("p", { class: "ros-chart-readout ros-muted", role: "status", "aria-live": "polite" });
    this.el = h("div", { class: "ros-chart" }, this.canvas, this.readout);
    this.end = whenWide(this.canvas, (width) => { this.width = width; this.#draw(); });
  }

  /** @param {Drawing} data */
  show(data) {
    this.#follow(data.points);
    this.data = data;
    this.#draw();
  }

  /** Keeps the chosen time when the points change. @param {Point[]} points */
  #follow(points) {
    const before = this.at === null ? undefined : this.data?.points[this.at];
    if (!before) return;
    const far = points.map(([x]) => Math.abs(x - before[0]));
    this.at = far.length ? far.indexOf(Math.min(...far)) : null;
  }

  #draw() {
    if (!this.data) return;
    const { points, count, y, window } = this.data;
    if (!points.length) return this.#drawEmpty();
    const up = axis(...extent(points.map((point) => point[1])), 5);
    const left = Math.ceil(Math.max(...up.ticks.map(({ text }) => text.length)) * LETTER) + 16;
    const box = { left, right: this.width - 16, top: TOP, bottom: HEIGHT - BOTTOM };
    const across = marksThatFit(window, box.right - box.left);
    this.axes = { across, up };
    this.toPage = (/** @type {Point} */ [one, other]) => /** @type {Point} */ ([
      near(box.left + place(across, one) * (box.right - box.left)), near(box.bottom - place(up, other) * (box.bottom - box.top))]);
    this.mark = s("g", { class: "ros-chart-mark" });
    this.canvas.replaceChildren(s("svg", { viewBox: `0 0 ${this.width} ${HEIGHT}`, width: this.width, height: HEIGHT, role: "img",
      "aria-label": `a line of ${count} points, ${y || "y"} against ${X}` }, ...grid(this.axes, box, this.toPage, y), ...this.#drawLine(points), this.mark));
    this.#drawMark();
  }

  /** @param {Point[]} points */
  #drawLine(points) {
    const places = points.map((point) => this.toPage(point));
    const line = s("polyline", { class: "ros-chart-line", points: places.map((each) => each.join(",")).join(" ") });
    const room = Math.abs(places[places.length - 1][0] - places[0][0]);
    if (places.length > 1 && room < APART * (places.length - 1)) return [line];
    // One path with all markers is drawn faster than one element for each marker.
    const dots = places.map(([x, y]) => `M${near(x - R)} ${y}A${R} ${R} 0 1 1 ${near(x + R)} ${y}A${R} ${R} 0 1 1 ${near(x - R)} ${y}Z`);
    return [line, s("path", { class: "ros-chart-marker", d: dots.join("") })];
  }

  #drawEmpty() {
    this.mark = null;
    this.canvas.replaceChildren(h("p", { class: "ros-chart-empty", text: "Nothing to draw yet." }));
    this.#read(null);
  }

  /** @param {PointerEvent} event */
  #point(event) {
    const frame = this.canvas.firstElementChild?.getBoundingClientRect();
    if (!this.mark || !frame?.width) return;
    const scale = this.width / frame.width;
    this.#read(this.#nearest((event.clientX - frame.left) * scale, (event.clientY - frame.top) * scale));
  }

  /** Returns the nearest point; the horizontal distance counts more than the vertical distance.
   * @param {number} x @param {number} y */
  #nearest(x, y) {
    const far = this.data.points.map((/** @type {Point} */ point) => {
      const [left, top] = this.toPage(point);
      return Math.abs(left - x) + 0.2 * Math.abs(top - y);
    });
    return far.indexOf(Math.min(...far));
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const last = (this.data?.points.length ?? 0) - 1;
    const turn = { ArrowLeft: -1, ArrowRight: 1, PageUp: -10, PageDown: 10, Home: -Infinity, End: Infinity }[event.key];
    if (last < 0 || (turn === undefined && event.key !== "Escape")) return;
    event.preventDefault();
    if (turn === undefined) return this.#read(null);
    const at = this.at ?? (turn < 0 ? Infinity : -Math.min(1, turn));
    this.#read(Math.min(last, Math.max(0, at + turn)));
  }

  /** @param {number | null} at */
  #read(at) {
    this.at = at;
    this.#drawMark();
  }

  #drawMark() {
    const { points = [], y = "" } = this.data ?? {};
    const point = this.at === null ? undefined : points[this.at];
    this.mark?.replaceChildren(...(point ? this.#ring(point) : []));
    say(this.readout, point ? `${quantity(X, reading(this.axes.across, point[0]))}, ${quantity(y || "y", reading(this.axes.up, point[1]))}`
      : points.length ? "Point at the plot, or use the arrow keys, to read its values." : "");
    this.readout.hidden = !points.length;
  }

  /** @param {Point} point */
  #ring(point) {
    const [left, top] = this.toPage(point);
    return [s("line", { x1: left, x2: left, y1: TOP, y2: HEIGHT - BOTTOM }), s("circle", { cx: left, cy: top, r: 7 })];
  }
}

/** Makes an SVG element; `text` sets its text.
 * @param {string} tag @param {Record<string, any>} [props] @param {...Node} children */
function s(tag, props = {}, ...children) {
  const element = /** @type {SVGElement} */ (document.createElementNS(SPACE, tag));
  for (const [key, value] of Object.entries(props)) {
    if (key === "text") element.textContent = value;
    else element.setAttribute(key, String(value));
  }
  element.append(...children);
  return element;
}

/** Returns "delay 3 ms" for "delay (ms)" and "3". @param {string} name @param {string} value */
function quantity(name, value) {
  const [, what, unit] = name.match(/^(.*?)\s*\(([^()]*)\)\s*$/) ?? ["", name, ""];
  return `${what} ${value}${unit ? ` ${unit}` : ""}`;
}

/** @param {number[]} values @returns {[number, number]} */
function extent(values) {
  return values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
}

/** Returns the horizontal axis with as many ticks as there is room for.
 * @param {[number, number]} ends @param {number} width */
function marksThatFit([low, high], width) {
  for (const most of [10, 8, 6, 5, 4, 3, 2]) {
    const made = axis(low, high, most, true);
    const longest = Math.max(0, ...made.ticks.map(({ text }) => text.length));
    if (made.ticks.length * (longest + 3) * LETTER <= width) return made;
  }
  return axis(low, high, 1, true);
}

/** Returns the grid lines, ticks and names of both axes. @param {{across: Axis, up: Axis}} axes
 * @param {{left: number, right: number, top: number, bottom: number}} box @param {Function} toPage @param {string} y */
function grid({ across, up }, box, toPage, y) {
  const levels = up.ticks.flatMap(({ value, text }) => {
    const top = toPage([across.low, value])[1];
    return [s("line", { class: "ros-chart-grid", x1: box.left, x2: box.right, y1: top, y2: top }),
      s("text", { x: box.left - 8, y: top, "text-anchor": "end", "dominant-baseline": "central", text })];
  });
  const stations = across.ticks.flatMap(({ value, text }) => {
    const left = toPage([value, up.low])[0];
    const inside = Math.min(left, box.right + 16 - (text.length * LETTER) / 2);
    return [s("line", { class: "ros-chart-axis", x1: left, x2: left, y1: box.bottom, y2: box.bottom + 4 }),
      s("text", { x: inside, y: box.bottom + 17, "text-anchor": "middle", text })];
  });
  return [...levels, ...stations, s("line", { class: "ros-chart-axis", x1: box.left, x2: box.right, y1: box.bottom, y2: box.bottom }),
    s("text", { class: "ros-chart-name", x: 0, y: 13, text: y }),
    s("text", { class: "ros-chart-name", x: box.right, y: HEIGHT - 7, "text-anchor": "end", text: X })];
}

/** Rounds a position to a tenth of a pixel. @param {number} value */
function near(value) {
  return Math.round(value * 10) / 10;
}

/** Calls `draw(width)` now and after each change of the element's width. Returns a function that stops these
 * calls.
 * @param {Element} element @param {(width: number) => void} draw */
function whenWide(element, draw) {
  let before = 0;
  const observer = new ResizeObserver(() => {
    const width = Math.floor(element.clientWidth);
    if (width && width !== before) draw(before = width);
  });
  observer.observe(element);
  return () => observer.disconnect();
}

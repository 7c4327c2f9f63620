/* A chart of lines or dots: one's own small drawing, since the front end travels with every widget of a notebook and a
   chart library would go along each time (the smallest that was weighed, uPlot, has 50 kB and draws on a canvas, which
   neither prints sharply nor follows the theme). */
import { h, say } from "../kit.js";
import { axis, place, reading } from "./axes.js";
import { look, markers, near, s, whenWide } from "./svg.js";

/** @typedef {{label: string, points: [number, number][], breaks?: number[], count?: number,
 *   given?: number}} Series */
/** @typedef {{title?: string, x: string, y: string, kind: string, log: boolean, series: Series[], empty?: string,
 *   window?: [number, number]}} Drawing */

const HEIGHT = 264; // px
const TOP = 28; // room for the name of the upward axis
const BOTTOM = 44; // and below for marks and the name of the other
const LETTER = 6.8; // px, about the width of a digit of 12 px
const APART = 8; // px between points on average, from which a line has markers
const CROWD = 300; // dots beyond which their edges would hide one another

export class Chart {
  constructor() {
    this.width = 640;
    /** @type {{series: number, index: number} | null} */
    this.at = null;
    this.legend = h("ul", { class: "ros-chart-legend", "aria-label": "Series" });
    this.canvas = h("div", { class: "ros-chart-canvas", role: "group", tabindex: "0", "data-lm-suppress-shortcuts": "true",
      "aria-label": "Plot: the arrow keys read its points",
      onpointermove: (/** @type {PointerEvent} */ event) => this.#point(event), onpointerleave: () => this.#read(null),
      onblur: () => this.#read(null), onkeydown: (/** @type {KeyboardEvent} */ event) => this.#key(event) });
    this.readout = h("p", { class: "ros-chart-readout ros-muted", role: "status", "aria-live": "polite" });
    this.el = h("div", { class: "ros-chart" }, this.legend, this.canvas, this.readout);
    this.end = whenWide(this.canvas, (width) => { this.width = width; this.#draw(); });
  }

  /** @param {Drawing} data */
  show(data) {
    this.#follow(data.series);
    this.data = data;
    this.#drawLegend();
    this.#draw();
  }

  /** Stay at the same moment when other points come in. @param {Series[]} series */
  #follow(series) {
    const before = this.at && this.data?.series[this.at.series]?.points[this.at.index];
    if (!this.at || !before) return;
    const xs = (series[this.at.series]?.points ?? []).map(([x]) => Math.abs(x - before[0]));
    this.at = xs.length ? { ...this.at, index: xs.indexOf(Math.min(...xs)) } : null;
  }

  #drawLegend() {
    const { series, kind } = /** @type {Drawing} */ (this.data);
    const names = series.map(({ label, points }) => [label, points.length === 0]);
    const key = JSON.stringify([names, kind]);
    if (key === this.named) return; // a live plot must not flicker
    this.named = key;
    this.legend.replaceChildren(...series.map(({ label, points, given }, index) => h("li", {}, sample(index, kind),
      h("span", { text: points.length ? label : `${label}: ${given ? "nothing that can be drawn" : "nothing was measured"}` }))));
    this.legend.hidden = series.every(({ label, points }) => !label || !points.length);
  }

  #draw() {
    if (!this.data) return;
    const { series, x, y, kind, log, window } = this.data;
    const all = series.flatMap(({ points }) => points);
    this.canvas.hidden = false;
    if (!all.length) return this.#drawEmpty();
    const [xs, ys] = [0, 1].map((part) => extent(all.map((point) => point[part])));
    const up = axis(ys[0], ys[1], 5, { log });
    const left = Math.ceil(Math.max(...up.ticks.map(({ text }) => text.length)) * LETTER) + 16;
    const box = { left, right: this.width - 16, top: TOP, bottom: HEIGHT - BOTTOM };
    const across = marksThatFit(window ?? xs, box.right - box.left);
    this.axes = { across, up };
    this.toPage = (/** @type {[number, number]} */ [one, other]) => /** @type {[number, number]} */ ([
      near(box.left + place(across, one) * (box.right - box.left)), near(box.bottom - place(up, other) * (box.bottom - box.top))]);
    this.mark = s("g", { class: "ros-chart-mark" });
    this.canvas.replaceChildren(s("svg", { viewBox: `0 0 ${this.width} ${HEIGHT}`, width: this.width, height: HEIGHT, role: "img", "aria-label": this.#words() },
      ...grid(this.axes, box, this.toPage, x, y), ...series.flatMap((each, index) => this.#drawSeries(each, index, kind)), this.mark));
    this.#drawMark();
  }

  /** @param {Series} series @param {number} index @param {string} kind */
  #drawSeries({ points, breaks }, index, kind) {
    const { dash, name } = look(index);
    const places = points.map((point) => this.toPage(point));
    if (kind === "dots") return [markers(places, index, places.length > CROWD)];
    const ends = [0, ...(breaks ?? []), places.length];
    const strokes = ends.slice(1).map((end, at) => s("polyline", { class: `${name} ros-series-line`, "stroke-dasharray": dash,
      points: places.slice(ends[at], end).map((each) => each.join(",")).join(" ") }));
    const room = places.length ? Math.abs(places[places.length - 1][0] - places[0][0]) : 0;
    return room >= APART * (places.length - 1) ? [...strokes, markers(places, index)] : [...strokes, markers(alone(places, ends), index)];
  }

  #drawEmpty() {
    this.mark = null;
    this.canvas.replaceChildren(h("p", { class: "ros-chart-empty", text: this.data.empty ?? "Nothing was measured." }));
    this.#read(null);
  }

  #words() {
    const { title, kind, x, y, series } = /** @type {Drawing} */ (this.data);
    const of = series.map(({ label, points, count }) => `${label || "one series"} with ${count ?? points.length} points`).join(", ");
    return `${title ? `${title}: ` : ""}${kind === "dots" ? "dots" : "lines"}, ${y || "y"} against ${x || "x"}; ${of}`;
  }

  /** @param {PointerEvent} event */
  #point(event) {
    const frame = this.canvas.firstElementChild?.getBoundingClientRect();
    if (!this.mark || !frame?.width) return;
    const scale = this.width / frame.width;
    this.#read(this.#nearest((event.clientX - frame.left) * scale, (event.clientY - frame.top) * scale));
  }

  /** The point next to a place; for lines what lies above or below counts as next. @param {number} x @param {number} y */
  #nearest(x, y) {
    const weight = this.data.kind === "line" ? 0.2 : 1;
    let best = { series: 0, index: 0, far: Infinity };
    this.data.series.forEach(({ points }, series) => points.forEach((point, index) => {
      const [left, top] = this.toPage(point);
      const far = Math.abs(left - x) + weight * Math.abs(top - y);
      if (far < best.far) best = { series, index, far };
    }));
    return best;
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const series = this.data?.series ?? [];
    const filled = series.map((_, index) => index).filter((index) => series[index].points.length);
    const turn = { ArrowLeft: -1, ArrowRight: 1, PageUp: -10, PageDown: 10, Home: -Infinity, End: Infinity }[event.key];
    const other = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (!filled.length || (turn === undefined && other === undefined && event.key !== "Escape")) return;
    event.preventDefault();
    if (event.key === "Escape") return this.#read(null);
    const at = this.at ?? { series: filled[0], index: turn && turn < 0 ? Infinity : -Math.min(1, turn ?? 0) };
    const next = filled.at((filled.indexOf(at.series) + (other ?? 0)) % filled.length) ?? filled[0];
    const index = Math.min(series[next].points.length - 1, Math.max(0, at.index + (turn ?? 0)));
    this.#read({ series: next, index });
  }

  /** @param {{series: number, index: number} | null} at */
  #read(at) {
    this.at = at;
    this.#drawMark();
  }

  #drawMark() {
    const { series = [], x = "", y = "" } = this.data ?? {};
    const point = this.at && series[this.at.series]?.points[this.at.index];
    this.mark?.replaceChildren(...(point ? this.#ring(point) : []));
    const some = series.some(({ points }) => points.length);
    const { label } = this.at ? series[this.at.series] : { label: "" };
    say(this.readout, point ? `${label ? `${label}: ` : ""}${quantity(x || "x", reading(this.axes.across, point[0]))}, ${quantity(y || "y", reading(this.axes.up, point[1]))}`
      : some ? "Point at the plot, or use the arrow keys, to read its values." : "");
    this.readout.hidden = !some;
  }

  /** @param {[number, number]} point */
  #ring(point) {
    const [left, top] = this.toPage(point);
    return [s("line", { x1: left, x2: left, y1: TOP, y2: HEIGHT - BOTTOM }), s("circle", { cx: left, cy: top, r: 7 })];
  }
}

/** The points between two gaps, which no stroke shows. @param {[number, number][]} places @param {number[]} ends */
function alone(places, ends) {
  return ends.slice(1).flatMap((end, at) => (end - ends[at] === 1 ? [places[ends[at]]] : []));
}

/** "delay (ms)" and "3" as "delay 3 ms". @param {string} name @param {string} value */
export function quantity(name, value) {
  const [, what, unit] = name.match(/^(.*?)\s*\(([^()]*)\)\s*$/) ?? ["", name, ""];
  return `${what} ${value}${unit ? ` ${unit}` : ""}`;
}

/** @param {number[]} values @returns {[number, number]} */
function extent(values) {
  return values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
}

/** The sideways axis with as many marks as have room. @param {[number, number]} ends @param {number} width */
function marksThatFit([low, high], width) {
  for (const most of [10, 8, 6, 5, 4, 3, 2]) {
    const made = axis(low, high, most, { snug: true });
    const longest = Math.max(0, ...made.ticks.map(({ text }) => text.length));
    if (made.ticks.length * (longest + 3) * LETTER <= width) return made;
  }
  return axis(low, high, 1, { snug: true });
}

/** Lines, marks and names. @param {{across: import("./axes.js").Axis, up: import("./axes.js").Axis}} axes
 * @param {{left: number, right: number, top: number, bottom: number}} box @param {Function} toPage @param {string} x @param {string} y */
function grid({ across, up }, box, toPage, x, y) {
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
    s("text", { class: "ros-chart-name", x: 0, y: 13, text: `${y}${up.log && y ? ", logarithmic" : ""}` }),
    s("text", { class: "ros-chart-name", x: box.right, y: HEIGHT - 7, "text-anchor": "end", text: x })];
}

/** @param {number} index of the series @param {string} kind */
function sample(index, kind) {
  const { dash, name } = look(index);
  const line = kind === "dots" ? [] : [s("line", { class: `${name} ros-series-line`, x1: 0, x2: 32, y1: 8, y2: 8, "stroke-dasharray": dash })];
  return s("svg", { width: 32, height: 16, "aria-hidden": "true" }, ...line, markers([[16, 8]], index));
}

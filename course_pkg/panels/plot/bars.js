/* Bars that lie: a name has room beside its bar, or above it, and the value stands at its end. */
import { h } from "../kit.js";
import { axis, numeral, place } from "./axes.js";
import { near, s, whenWide } from "./svg.js";

const BAR = 20; // px
const GAP = 12;
const NAME = 18; // px, a line above the bar where names are long
const AXIS = 44; // px below, for marks and the name
const WIDE = 7; // px, about the width of a letter of 12 px
const VALUE = 72; // px for a value at the end of its bar

export class Bars {
  constructor() {
    this.canvas = h("div", { class: "ros-chart-canvas" });
    this.el = h("div", { class: "ros-chart" }, this.canvas);
    this.end = whenWide(this.canvas, (width) => this.#draw(width));
  }

  /** @param {any} data */
  show(data) {
    this.data = data;
    this.#draw(640);
  }

  /** @param {number} width */
  #draw(width) {
    const { bars, title, y } = this.data;
    if (!bars.length) return this.canvas.replaceChildren(h("p", { class: "ros-chart-empty", text: "Nothing was measured." }));
    const frame = this.#frame(width);
    const drawn = bars.flatMap((/** @type {any} */ bar, /** @type {number} */ index) => this.#bar(bar, index, frame));
    const words = bars.map((/** @type {any} */ { label, value }) => `${label} ${numeral(value, 6)}`).join(", ");
    this.canvas.replaceChildren(s("svg", { viewBox: `0 0 ${width} ${frame.bottom + AXIS}`, width, height: frame.bottom + AXIS, role: "img",
      "aria-label": `${title ? `${title}: ` : ""}bars, ${y || "value"}; ${words}` }, ...this.#marks(frame), ...drawn));
  }

  /** Where things stand. @param {number} width */
  #frame(width) {
    const { bars, log } = this.data;
    const values = bars.map((/** @type {any} */ bar) => bar.value);
    const longest = Math.max(...bars.map((/** @type {any} */ bar) => bar.label.length)) * WIDE + 12;
    const above = longest > 0.35 * width;
    const some = (/** @type {boolean} */ is) => (is ? VALUE : 8);
    const left = (above ? 0 : longest) + (values.some((/** @type {number} */ value) => value < 0) ? VALUE : 0);
    const right = width - some(values.some((/** @type {number} */ value) => value >= 0));
    const across = axis(Math.min(...values), Math.max(...values), Math.max(2, Math.min(6, (right - left) / 70)), { log, zero: true });
    const pitch = BAR + GAP + (above ? NAME : 0);
    const toPage = (/** @type {number} */ value) => near(left + place(across, value) * (right - left));
    return { left, right, above, across, pitch, toPage, longest, bottom: bars.length * pitch, zero: log ? left : toPage(0) };
  }

  /** @param {any} bar @param {number} index @param {any} frame */
  #bar({ label, value }, index, { above, pitch, toPage, longest, zero }) {
    const top = index * pitch + GAP / 2 + (above ? NAME : 0);
    const middle = top + BAR / 2;
    const end = toPage(value);
    const name = above ? { x: 0, y: top - 5 } : { x: longest - 12, y: middle, "text-anchor": "end", "dominant-baseline": "central" };
    const beyond = value < 0 ? { x: end - 8, "text-anchor": "end" } : { x: end + 8 };
    return [s("text", { ...name, class: "ros-chart-label", text: label }), ...this.#body(top, zero, end),
      s("text", { ...beyond, y: middle, "dominant-baseline": "central", class: "ros-chart-value", text: numeral(value) })];
  }

  /** A bar; on a logarithmic axis, which has no 0 for a bar to begin at, a dot. @param {number} top @param {number} zero @param {number} end */
  #body(top, zero, end) {
    const middle = top + BAR / 2;
    if (this.data.log) return [s("line", { class: "ros-chart-stem", x1: zero, x2: end, y1: middle, y2: middle }), s("circle", { class: "ros-chart-bar", cx: end, cy: middle, r: 5 })];
    return [s("rect", { class: "ros-chart-bar", x: Math.min(zero, end), y: top, width: Math.max(1, Math.abs(end - zero)), height: BAR })];
  }

  /** @param {any} frame */
  #marks({ across, bottom, toPage, right, zero }) {
    const { y, log } = this.data;
    const marks = across.ticks.flatMap((/** @type {any} */ { value, text }) => {
      const x = toPage(value);
      return [s("line", { class: "ros-chart-grid", x1: x, x2: x, y1: 0, y2: bottom }), s("text", { x, y: bottom + 17, "text-anchor": "middle", text })];
    });
    return [...marks, s("line", { class: "ros-chart-axis", x1: zero, x2: zero, y1: 0, y2: bottom }),
      s("text", { class: "ros-chart-name", x: right, y: bottom + 37, "text-anchor": "end", text: `${y}${log && y ? ", logarithmic" : ""}` })];
  }
}

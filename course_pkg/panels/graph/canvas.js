/* The drawing on the page: its size, what is chosen, the words under topics, and the lines of calls. */
import { freshId, h, say, setAttribute } from "../kit.js";

const SMALLEST = 0.65; // of the drawing by itself: below that, names cannot be read
const STEP = 1.25;
const FADE = 30; // s that a call is to be seen
const SVG = "http://www.w3.org/2000/svg";

export class Canvas {
  /** @param {(key: string, folded: boolean | null) => void} picked hears what was clicked */
  constructor(picked) {
    this.picked = picked;
    this.zoom = 0; // 0: by itself
    this.chosen = "";
    this.id = freshId("ros-canvas");
    this.el = h("div", { class: "ros-canvas", id: this.id, onclick: (/** @type {Event} */ event) => this.#pick(event.target),
      onkeydown: (/** @type {KeyboardEvent} */ event) => this.#key(event) });
    this.tools = h("div", { class: "ros-tools", role: "group", "aria-label": "Size of the drawing", hidden: true },
      this.#tool("−", "Smaller", () => this.#resize(this.scale / STEP)), this.#tool("+", "Larger", () => this.#resize(this.scale * STEP)),
      this.#tool("Fit", "Show the whole drawing", () => this.#resize(this.#whole())));
    new ResizeObserver(() => this.#fit()).observe(this.el);
  }

  /** @param {string} drawing an SVG, built in Python by an XML library, which escapes every name that comes from the graph */
  draw(drawing) {
    const focused = this.el.contains(document.activeElement) ? document.activeElement?.getAttribute("data-key") : null;
    this.el.innerHTML = drawing;
    for (const shape of this.#shapes()) shape.setAttribute("data-lm-suppress-shortcuts", "true");
    setAttribute(this.el, "hidden", !drawing);
    if (focused) /** @type {SVGElement | undefined} */ (this.#shape(focused))?.focus({ preventScroll: true });
    this.#fit();
    this.choose(this.chosen);
  }

  /** Show what is chosen, and the lines that touch it. @param {string} key */
  choose(key) {
    this.chosen = this.#shape(key) ? key : "";
    for (const shape of this.#shapes()) {
      const chosen = shape.getAttribute("data-key") === this.chosen;
      shape.classList.toggle("ros-chosen", chosen);
      shape.setAttribute("aria-pressed", String(chosen));
    }
    let some = false;
    for (const edge of this.el.querySelectorAll(".ros-edge")) {
      const touches = this.chosen !== "" && [edge.getAttribute("data-tail"), edge.getAttribute("data-head")].includes(this.chosen);
      edge.classList.toggle("ros-chosen", touches);
      some ||= touches;
    }
    this.el.firstElementChild?.classList.toggle("ros-some-chosen", some);
  }

  /** @param {import("./words.js").Activity} activity */
  happen(activity) {
    for (const shape of this.el.querySelectorAll(".ros-topic")) {
      const note = shape.querySelector(".ros-note");
      if (note) say(note, activity.notes?.[shape.getAttribute("data-key") ?? ""] ?? "");
    }
    this.#drawCalls(activity.calls ?? []);
  }

  /** Lines from callers to services, which fade; Graphviz has no part in them, so nothing else moves.
   * @param {{tail: string, head: string, last: number, running: number}[]} calls */
  #drawCalls(calls) {
    const layer = this.el.querySelector(".ros-calls");
    layer?.replaceChildren(...calls.flatMap(({ tail, head, last, running }) => {
      const age = running ? 0 : Math.max(0, Date.now() / 1000 - last);
      const [from, to] = [this.#shape(tail), this.#shape(head)].map((shape) => shape && middle(shape));
      return from && to && age < FADE ? [callLine(from, to, age, running > 0)] : [];
    }));
  }

  /** @param {EventTarget | null} target */
  #pick(target) {
    const shape = /** @type {Element} */ (target).closest("[data-key]");
    const expanded = shape?.getAttribute("aria-expanded");
    this.picked(shape?.getAttribute("data-key") ?? "", expanded ? expanded === "false" : null);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    this.#pick(event.target);
  }

  /** @param {number} scale */
  #resize(scale) {
    this.zoom = Math.min(2, Math.max(0.2, scale));
    this.#fit();
  }

  #whole() {
    const { width, height } = this.#natural();
    return Math.min(1, this.#room() / width, (0.7 * window.innerHeight - 16) / height);
  }

  #room() {
    return Math.max(1, this.el.clientWidth - 16);
  }

  #natural() {
    const box = /** @type {SVGSVGElement | null} */ (this.el.firstElementChild)?.viewBox.baseVal;
    return { width: box?.width || 1, height: box?.height || 1 };
  }

  /** Give the drawing its size: as large as it is, or smaller to fit beside, as long as it can be read. */
  #fit() {
    const svg = /** @type {SVGSVGElement | null} */ (this.el.firstElementChild);
    const { width, height } = this.#natural();
    const narrow = this.#room() / width;
    this.scale = this.zoom || Math.min(1, Math.max(SMALLEST, narrow));
    if (svg) Object.assign(svg.style, { width: `${this.scale * width}px`, height: `${this.scale * height}px` });
    setAttribute(this.tools, "hidden", !svg || (!this.zoom && narrow >= 1 && this.#whole() >= 1));
  }

  /** @param {string} text @param {string} label @param {() => void} act */
  #tool(text, label, act) {
    return h("button", { type: "button", class: "ros-quiet", "aria-label": label, title: label, "aria-controls": this.id, text, onclick: act });
  }

  #shapes() {
    return this.el.querySelectorAll("[data-key]");
  }

  /** @param {string} key @returns {Element | undefined} */
  #shape(key) {
    return [...this.#shapes()].find((shape) => shape.getAttribute("data-key") === key);
  }
}

/** @typedef {{x: number, y: number, wide: number, high: number}} Place */

/** The middle and half the size of a shape. @param {Element} shape @returns {Place} */
function middle(shape) {
  const outline = /** @type {SVGGraphicsElement} */ (shape.querySelector("ellipse, rect:last-of-type, polygon"));
  const { x, y, width, height } = outline.getBBox();
  return { x: x + width / 2, y: y + height / 2, wide: width / 2, high: height / 2 };
}

/** @param {Place} from @param {Place} to @param {number} age in s @param {boolean} waits */
function callLine(from, to, age, waits) {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const length = Math.hypot(dx, dy) || 1;
  const bend = Math.min(48, 0.2 * length) / length; // beside the straight way, where other lines may run
  const top = { x: (from.x + to.x) / 2 - bend * dy, y: (from.y + to.y) / 2 + bend * dx };
  const [start, end] = [border(from, top), border(to, top)];
  const angle = Math.atan2(end.y - top.y, end.x - top.x) + Math.PI;
  const sides = [angle - 0.45, angle + 0.45].map((side) => `${end.x + 9 * Math.cos(side)},${end.y + 9 * Math.sin(side)}`);
  const line = document.createElementNS(SVG, "g");
  line.setAttribute("class", waits ? "ros-asked ros-waits" : "ros-asked");
  if (!waits) line.style.animationDelay = `${-age}s`;
  for (const [tag, name, value] of [["path", "d", `M${start.x},${start.y} Q${top.x},${top.y} ${end.x},${end.y}`],
    ["polygon", "points", `${end.x},${end.y} ${sides.join(" ")}`]]) {
    line.append(document.createElementNS(SVG, tag));
    line.lastElementChild?.setAttribute(name, value);
  }
  return line;
}

/** Where the way from the middle of a shape to a point leaves it. @param {Place} place @param {{x: number, y: number}} point */
function border(place, point) {
  const [dx, dy] = [point.x - place.x, point.y - place.y];
  const part = Math.min(1, 1 / Math.max(Math.abs(dx) / place.wide, Math.abs(dy) / place.high, 1e-6));
  return { x: place.x + part * dx, y: place.y + part * dy };
}

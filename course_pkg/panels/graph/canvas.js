/* The drawing on the page: its size, the chosen shape, the notes below topics, and the lines of calls. */
import { freshId, h, say, setAttribute } from "../kit.js";
import { callLine, place } from "./calls.js";

const SMALLEST = 0.65; // The automatic scale is not smaller than this value, because smaller names cannot be read.
const STEP = 1.25;
const FADE = 30; // The drawing shows a finished call for this many s.

export class Canvas {
  /** @param {(key: string, folded: boolean | null) => void} picked is called after a click on a shape */
  constructor(picked) {
    this.picked = picked;
    this.zoom = 0; // 0 means that the scale is chosen automatically
    this.fresh = true; // false after the drawing was scrolled to its start
    this.chosen = "";
    /** @type {import("./sentences.js").Activity} */
    this.activity = {};
    this.clock = /** @type {number | null} */ (null);
    this.id = freshId("ros-canvas");
    this.el = h("div", { class: "ros-canvas", id: this.id, onclick: (/** @type {Event} */ event) => this.#pick(event.target),
      onkeydown: (/** @type {KeyboardEvent} */ event) => this.#key(event) });
    this.tools = h("div", { class: "ros-tools", role: "group", "aria-label": "Size of the drawing", hidden: true },
      this.#tool("−", "Smaller", () => this.#resize(this.scale / STEP)), this.#tool("+", "Larger", () => this.#resize(this.scale * STEP)),
      this.#tool("Fit", "Fit: show the whole drawing", () => this.#resize(this.#whole())));
    // Only a change of the width needs a reaction, because this code itself sets the height.
    let width = 0;
    new ResizeObserver(() => {
      if (width === (width = this.el.clientWidth)) return;
      this.#fit();
      this.#drawCalls(); // The drawing may have become visible.
    }).observe(this.el);
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
    if (drawing && this.fresh) requestAnimationFrame(() => this.#centre());
  }

  /** Marks the chosen shape and its lines. @param {string} key */
  choose(key) {
    this.chosen = key; // The shape may be missing now and return later.
    for (const shape of this.#shapes()) {
      const chosen = shape.getAttribute("data-key") === this.chosen;
      shape.classList.toggle("ros-chosen", chosen);
      if (!shape.hasAttribute("aria-expanded")) shape.setAttribute("aria-pressed", String(chosen));
    }
    let some = false;
    for (const edge of this.el.querySelectorAll(".ros-edge")) {
      const touches = this.chosen !== "" && [edge.getAttribute("data-tail"), edge.getAttribute("data-head")].includes(this.chosen);
      edge.classList.toggle("ros-chosen", touches);
      some ||= touches;
    }
    this.el.firstElementChild?.classList.toggle("ros-some-chosen", some);
  }

  /** @param {import("./sentences.js").Activity} activity
   * @param {number | null} [clock] the time of the activity in s since the epoch; without it, the activity is the
   * present one, and its lines fade */
  happen(activity, clock = null) {
    this.activity = activity;
    this.clock = clock;
    for (const shape of this.el.querySelectorAll(".ros-topic")) {
      const note = shape.querySelector(".ros-note");
      if (!note) continue;
      say(note, activity.notes?.[shape.getAttribute("data-key") ?? ""] ?? "");
      shape.setAttribute("aria-label", [shape.querySelector("title")?.textContent, note.textContent].join(" ").trim());
    }
    this.#drawCalls();
  }

  /** Draws fading lines from callers to services. The lines do not change the layout. */
  #drawCalls() {
    if (!this.el.clientWidth) return; // An invisible drawing has no size, so the ends of the lines are unknown.
    const now = this.clock ?? Date.now() / 1000;
    this.el.classList.toggle("ros-stopped", this.clock !== null);
    const shapes = [...this.el.querySelectorAll(".ros-shape")];
    const found = (/** @type {string} */ key) => shapes.find((shape) => shape.getAttribute("data-key") === key);
    const fresh = (this.activity.calls ?? []).map((each) => ({ ...each, age: each.running ? 0 : Math.max(0, now - each.last) }))
      .filter(({ tail, head, age }) => age < FADE && found(tail) && found(head));
    const places = new Map(fresh.length ? shapes.map((shape) => [shape.getAttribute("data-key"), place(shape)]) : []);
    this.el.querySelector(".ros-calls")?.replaceChildren(...fresh.map(({ tail, head, running, age }) => {
      const others = [...places].filter(([key]) => key !== tail && key !== head).map(([, each]) => each);
      return callLine(places.get(tail), places.get(head), others, age, running > 0);
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
    this.zoom = Math.min(2, Math.max(0.05, scale));
    this.#fit();
  }

  /** Scrolls to the start of the drawing. The start of a wide drawing is the middle of its left side, and
   * the start of a high drawing is the middle of its upper side. */
  #centre() {
    const [down, across] = [this.el.scrollHeight - this.el.clientHeight, this.el.scrollWidth - this.el.clientWidth];
    if (!this.el.clientWidth) return; // The drawing is not visible yet.
    this.fresh = false;
    if (this.#natural().width > this.#natural().height) this.el.scrollTop = down / 2;
    else this.el.scrollLeft = across / 2;
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

  /** Sets the size of the drawing: its natural size, or a smaller size that fits the width and can still
      be read. */
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

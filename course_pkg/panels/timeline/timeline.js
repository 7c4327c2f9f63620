/* The timeline: the drawing, the chosen event as text, sentences about waiting, and a table. The timeline needs no kernel. */
import { freshId, h, prose, say, setAttribute } from "../kit.js";
import { Drawing } from "./drawing.js";
import { Scene } from "./scene.js";
import { counted, duration, moment, parts, sentence, waiting } from "./sentences.js";

const FINEST = 50; // The width of the page stands for at least this many µs.
const HINT = "Drag to move. Zoom with Ctrl + wheel, or with + and −. The keys ← and → move the drawing, ↑ and ↓ select an event, and 0 shows everything.";

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const view = new TimelineView(model.get("recorded"));
  el.append(view.el);
  return () => view.end();
}

class TimelineView {
  /** @param {import("./scene.js").Recorded} recorded */
  constructor(recorded) {
    this.scene = new Scene(recorded);
    this.drawing = new Drawing(this.scene);
    this.chosen = -1;
    this.frame = 0;
    this.view = this.#whole();
    this.#build();
    this.#listen();
    this.#showDetails();
  }

  end() {
    this.observer?.disconnect();
    this.themes?.disconnect();
    this.paper?.removeEventListener("change", this.#drawNow);
    cancelAnimationFrame(this.frame);
  }

  #build() {
    const { recorded } = this.scene;
    const empty = !this.scene.count;
    this.canvas = this.drawing.body;
    for (const [name, value] of Object.entries({ tabindex: "0", role: "application", "aria-roledescription": "timeline", "data-lm-suppress-shortcuts": "true",
      "aria-label": `${counted(this.scene.count, "event")} of ${counted(recorded.lanes.length, "node")}. ${HINT}` })) this.canvas.setAttribute(name, value);
    this.window = h("div", { class: "ros-window" }, h("div", { class: "ros-top" }, this.drawing.axis), this.canvas, ...this.drawing.probes);
    this.details = h("div", { class: "ros-details", "aria-live": "polite" });
    this.thinned = h("p", { class: "ros-muted", hidden: true, text: "Events that are too close together are drawn as one band, which shows the number of events. Arrows that are too close together are not drawn. Zoom in to see each event." });
    this.body = h("tbody", {});
    this.table = /** @type {HTMLDetailsElement} */ (h("details", { class: "ros-list", ontoggle: () => this.#fillTable() }, h("summary", { text: "The same as a table" }),
      h("div", { class: "ros-scroll", tabindex: "0", role: "region", "aria-label": "Events" }, h("table", {}, h("thead", {}, h("tr", {},
        ...["Start (ms)", "Took (ms)", "Node", "What", "Service or topic", "Other node", "Belongs to", "Thread", "Note"].map((text) => h("th", { scope: "col", text })))), this.body))));
    this.el = h("section", { class: "ros-panel ros-timeline", "aria-label": "Timeline" }, this.#buildHead(),
      empty ? h("p", { class: "ros-empty", text: "The nodes did not communicate during the recording, or the recording has not ended." }) : this.window,
      empty ? null : this.details, empty ? null : this.#buildFoot(), this.#buildNotes(), empty ? null : this.table);
  }

  #buildHead() {
    const { recorded, count } = this.scene;
    const button = (/** @type {string} */ text, /** @type {string} */ label, /** @type {() => void} */ act) => h("button", { type: "button", class: "ros-quiet", "aria-label": label, title: label, text, onclick: act });
    const facts = `${duration(recorded.length)} recorded: ${counted(count, "event")} of ${counted(recorded.lanes.length, "node")}`;
    return h("div", { class: "ros-bar" }, h("span", { class: "ros-muted", text: facts }), count ? h("div", { class: "ros-buttons", role: "group", "aria-label": "View" },
      button("←", "Earlier", () => this.#move(-0.25)), button("→", "Later", () => this.#move(0.25)), button("−", "Zoom out", () => this.#zoom(2)),
      button("+", "Zoom in", () => this.#zoom(0.5)), button("All", "Show all", () => this.#look(this.#whole()))) : null);
  }

  #buildFoot() {
    const said = waiting(this.scene);
    return h("div", { class: "ros-foot" }, 
      h("ul", { class: "ros-waits", "aria-label": "Who waited for whom" }, ...said.map(({ waits, text }) => h("li", { class: waits ? "ros-blocked" : "" }, ...prose(text)))), legend(this.scene), this.thinned,
      h("p", { class: "ros-muted ros-hint", text: HINT }));
  }

  #buildNotes() {
    const { idle, unrecorded, notes } = this.scene.recorded;
    const lines = [...(idle.length ? [`Recorded without events: ${idle.map((node) => `\`${node}\``).join(", ")}.`] : []),
      ...unrecorded.map(([node, why]) => `Not recorded: \`${node}\`, because ${why}.`), ...notes];
    return lines.length ? h("ul", { class: "ros-notes", "aria-label": "What is missing" }, ...lines.map((line) => h("li", {}, ...prose(line)))) : null;
  }

  #listen() {
    this.observer = new ResizeObserver(([entry]) => {
      this.drawing.resize(Math.floor(entry.contentRect.width));
      this.#drawNow(); // Without this call, the page would show no drawing for a moment.
    });
    this.observer.observe(this.window);
    this.paper = window.matchMedia("print"); // A printed page has other colours.
    this.paper.addEventListener("change", this.#drawNow);
    this.themes = new MutationObserver(() => this.#drawSoon());
    for (const element of [document.documentElement, document.body]) this.themes.observe(element, { attributes: true });
    const on = (/** @type {string} */ name, /** @type {(event: any) => void} */ act, options = {}) => this.canvas.addEventListener(name, act, options);
    on("wheel", (event) => this.#wheel(event), { passive: false });
    on("pointerdown", (event) => this.#grab(event));
    on("pointermove", (event) => this.#drag(event));
    on("pointerup", (event) => this.#release(event));
    on("pointercancel", () => { this.grabbed = null; });
    on("keydown", (event) => this.#key(event));
  }

  /** @param {WheelEvent} event */
  #wheel(event) {
    const sideways = event.shiftKey ? event.deltaY : event.deltaX;
    if (event.ctrlKey) this.#zoom(Math.exp(Math.max(-100, Math.min(100, event.deltaY)) * 0.005), event.offsetX);
    else if (sideways) this.#move(sideways / this.drawing.width);
    else return; // If no key is pressed, the wheel scrolls the page.
    event.preventDefault();
  }

  /** @param {PointerEvent} event */
  #grab(event) {
    if (event.button !== 0) return;
    this.grabbed = { x: event.offsetX, from: this.view.from, moved: false };
    this.canvas.setPointerCapture(event.pointerId);
  }

  /** @param {PointerEvent} event */
  #drag(event) {
    if (!this.grabbed) {
      const over = this.drawing.view ? this.drawing.at(event.offsetX, event.offsetY) : -1;
      this.canvas.style.cursor = over < 0 ? "" : "pointer";
      return;
    }
    const shift = event.offsetX - this.grabbed.x;
    if (Math.abs(shift) > 3) this.grabbed.moved = true;
    if (!this.grabbed.moved) return;
    const from = this.grabbed.from - shift / this.drawing.scale;
    this.#look({ from, to: from + this.view.to - this.view.from });
  }

  /** @param {PointerEvent} event */
  #release(event) {
    if (this.grabbed && !this.grabbed.moved) this.#choose(this.drawing.at(event.offsetX, event.offsetY));
    this.grabbed = null;
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const acts = { "+": () => this.#zoom(0.5), "=": () => this.#zoom(0.5), "-": () => this.#zoom(2), 0: () => this.#look(this.#whole()), Home: () => this.#look(this.#whole()),
      ArrowLeft: () => this.#move(-0.1), ArrowRight: () => this.#move(0.1), ArrowDown: () => this.#step(1), ArrowUp: () => this.#step(-1),
      Enter: () => this.#open(), Escape: () => this.#choose(-1) };
    const act = event.ctrlKey || event.metaKey || event.altKey ? null : acts[/** @type {keyof acts} */ (event.key)];
    if (!act) return;
    event.preventDefault();
    act();
  }

  /** Chooses another event, and moves the view to it. @param {number} by */
  #step(by) {
    const next = this.chosen < 0 ? (by > 0 ? 0 : this.scene.count - 1) : Math.max(0, Math.min(this.scene.count - 1, this.chosen + by));
    this.#choose(next);
    const [start, span] = [this.scene.start[next], this.view.to - this.view.from];
    if (start < this.view.from || start > this.view.to) this.#look({ from: start - span / 4, to: start + (span * 3) / 4 });
    const [top] = this.scene.place(next);
    if (top < this.window.scrollTop + 30 || top > this.window.scrollTop + this.window.clientHeight - 40) this.window.scrollTop = top - 60;
  }

  /** Zooms in on the exchange of the chosen event. */
  #open() {
    if (this.chosen < 0) return;
    const whole = this.scene.exchanges.get(this.scene.key[this.chosen]) ?? [];
    const [from, to] = [Math.min(...whole.map((each) => this.scene.start[each])), Math.max(...whole.map((each) => this.scene.end[each]))];
    const room = Math.max((to - from) * 0.1, FINEST);
    this.#look({ from: from - room, to: to + room });
  }

  /** @param {number} event */
  #choose(event) {
    this.chosen = event;
    this.#showDetails();
    this.#drawSoon();
  }

  #showDetails() {
    if (this.chosen < 0) return this.details.replaceChildren(h("span", { class: "ros-muted", text: "Click an event in the drawing to read about it." }));
    const { scene, chosen } = this;
    const facts = [["at", `${moment(scene.start[chosen])} ms`], ["thread", scene.word(chosen, "thread")], ["belongs to", scene.word(chosen, "key")]];
    const whole = parts(scene, chosen);
    this.details.replaceChildren(h("p", {}, ...prose(sentence(scene, chosen))), h("p", { class: "ros-facts" }, ...facts.map(pair)),
      whole.length > 1 ? h("p", { class: "ros-facts" }, ...whole.slice(0, 12).map(pair), whole.length > 12 ? h("span", { class: "ros-muted", text: `and ${whole.length - 12} more` }) : "") : "");
  }

  /** @param {{from: number, to: number}} view */
  #look(view) {
    const [least, most] = this.scene.extent();
    const span = Math.min(Math.max(view.to - view.from, FINEST), most - least);
    const from = Math.max(least, Math.min(view.from, most - span));
    this.view = { from, to: from + span };
    this.#drawSoon();
  }

  #whole() {
    const [from, to] = this.scene.extent();
    return { from, to };
  }

  /** Zooms about a position (px) of the drawing, by default about the chosen event or the middle. @param {number}
   * factor @param {number} [at] */
  #zoom(factor, at) {
    const { from, to } = this.view;
    const start = this.chosen < 0 ? NaN : this.scene.start[this.chosen];
    const share = at !== undefined ? at / this.drawing.width : start >= from && start <= to ? (start - from) / (to - from) : 0.5;
    const span = Math.max((to - from) * factor, FINEST);
    const still = from + share * (to - from);
    this.#look({ from: still - share * span, to: still + (1 - share) * span });
  }

  /** @param {number} share of the view */
  #move(share) {
    const by = share * (this.view.to - this.view.from);
    this.#look({ from: this.view.from + by, to: this.view.to + by });
  }

  #drawSoon() {
    if (!this.frame) this.frame = requestAnimationFrame(() => this.#drawNow());
  }

  #drawNow = () => {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.drawing.draw(this.view, this.chosen);
    setAttribute(this.thinned, "hidden", !this.drawing.thinned);
  };

  /** Makes the rows of the table when it is opened for the first time, because thousands of rows would take too long. */
  #fillTable() {
    if (!this.table.open || this.body.childElementCount) return;
    const { scene } = this;
    const rows = document.createDocumentFragment();
    for (let each = 0; each < scene.count; each++) {
      const texts = [moment(scene.start[each]), scene.open[each] ? "not finished" : moment(scene.end[each] - scene.start[each]), scene.nodeOf(each), scene.kindOf(each),
        ...["name", "peer", "key", "thread", "note"].map((column) => scene.word(each, /** @type {any} */ (column)))];
      rows.append(h("tr", {}, ...texts.map((text) => h("td", { text }))));
    }
    this.body.append(rows);
  }
}

/** @param {string[]} labelled */
function pair([label, value]) {
  return h("span", { class: "ros-pair" }, h("span", { class: "ros-muted", text: `${label} ` }), h("code", { text: value }));
}

/** Returns the legend of the shapes in the drawing; the shapes of waiting events come first. @param {Scene} scene */
function legend(scene) {
  const id = freshId("ros-hatch");
  const hatch = `<defs><pattern id="${id}" width="6" height="6" patternUnits="userSpaceOnUse"><path class="ros-stripe" d="M-1,1 L1,-1 M0,6 L6,0 M5,7 L7,5"/></pattern></defs>`;
  const samples = [
    ["wait", "waits: blocked until another node answers", `${hatch}<rect class="ros-wait" fill="url(#${id})" x="1" y="2" width="32" height="14"/>`],
    ["lookup connect", "look-up or connection: also waits (a bar when you zoom in)", '<path class="ros-small" d="M10,4 l5,5 l-5,5 l-5,-5 z"/><circle class="ros-small" cx="25" cy="9" r="4"/>'],
    ["handler", "handler works", '<rect class="ros-work" x="1" y="2" width="32" height="14"/>'],
    ["request", "request and response", '<path class="ros-call" d="M1,5 H30"/><path class="ros-call ros-answer" d="M33,13 H4"/><path class="ros-tip" d="M33,5 l-7,-3 v6 z M1,13 l7,-3 v6 z"/>'],
    ["error", "failed", '<path class="ros-failed" d="M13,5 l8,8 m0,-8 l-8,8"/>'],
    ["publish", "publishes, does not wait", '<path class="ros-message" d="M17,3 V16"/><circle class="ros-dot" cx="17" cy="4" r="3"/>'],
    ["callback", "callback runs", '<rect class="ros-heard" x="1" y="2" width="32" height="14"/>'],
    ["open", "not finished when the recording ended", '<path class="ros-work" d="M1,2 H33 l-4,3.5 l4,3.5 l-4,3.5 l4,3.5 H1 z"/>'],
  ];
  const shown = new Set(Array.from({ length: scene.count }, (_, each) => scene.kindOf(each)));
  if (scene.open.some(Boolean)) shown.add("open");
  const found = samples.filter(([kinds]) => kinds.split(" ").some((kind) => shown.has(kind)));
  return h("ul", { class: "ros-legend", "aria-label": "What the shapes mean" }, ...found.map(([, text, shape]) => {
    const item = h("li", {});
    item.innerHTML = `<svg width="34" height="18" aria-hidden="true">${shape}</svg>`;
    item.append(text);
    return item;
  }));
}

export default { render };

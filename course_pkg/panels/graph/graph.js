/* The graph panel: the drawing, the details of what is clicked, and the same facts as a list. */
import { freshId, h, kernelLink, say, send, setAttribute } from "../kit.js";

/** @typedef {{key: string, kind: string, name: string, lost: boolean, facts: [string, string][]}} Fact */

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const ending = new AbortController();
  const panel = new GraphView(model);
  el.append(panel.el);
  kernelLink(model, ending.signal, (live) => panel.kernel(live));
  return () => ending.abort();
}

class GraphView {
  /** @param {import("../kit.js").Model} model */
  constructor(model) {
    this.model = model;
    this.live = true;
    this.chosen = "";
    this.#build();
    model.on("change:drawing", () => this.#draw());
    model.on("change:facts", () => this.#drawFacts());
    for (const trait of ["trouble", "notice"]) model.on(`change:${trait}`, () => this.#drawBanner());
    for (const trait of ["noise", "own", "show_own"]) model.on(`change:${trait}`, () => this.#drawBoxes());
    this.#draw();
    this.#drawFacts();
    this.#drawBanner();
    this.#drawBoxes();
  }

  #build() {
    this.banner = h("div", { class: "ros-banner", role: "status", hidden: true });
    this.canvas = h("div", { class: "ros-canvas", onclick: (/** @type {Event} */ event) => this.#choose(event.target),
      onkeydown: (/** @type {KeyboardEvent} */ event) => this.#key(event) });
    this.details = h("div", { class: "ros-details", "aria-live": "polite" });
    this.noise = box("loggers and /rosout", () => this.#toggle());
    this.own = box("this notebook's node", () => this.#toggle());
    this.list = h("tbody", {});
    const legend = h("ul", { class: "ros-legend", "aria-label": "Shapes" }, sample("node", "node"), sample("topic", "topic: a stream, one way"),
      sample("service", "service: a question and its answer"));
    this.el = h("section", { class: "ros-panel ros-graph", "aria-label": "Graph panel" }, this.banner, this.canvas, this.details,
      h("div", { class: "ros-foot" }, legend, h("div", { class: "ros-boxes", role: "group", "aria-label": "Show" }, h("span", { class: "ros-muted", text: "Show" }), this.noise.el, this.own.el)),
      h("details", { class: "ros-list" }, h("summary", { text: "The same as a list" }), h("table", {}, h("thead", {}, h("tr", {},
        ...["Kind", "Name", "Details"].map((text) => h("th", { scope: "col", text })))), this.list)));
  }

  #draw() {
    const drawing = this.model.get("drawing");
    const focused = this.canvas.contains(document.activeElement) ? document.activeElement?.getAttribute("data-key") : null;
    // The drawing is built in Python by an XML library, which escapes every name that comes from the graph.
    this.canvas.innerHTML = drawing;
    for (const shape of this.canvas.querySelectorAll("[data-key]")) shape.setAttribute("data-lm-suppress-shortcuts", "true");
    setAttribute(this.canvas, "hidden", !drawing);
    if (focused) /** @type {SVGElement | null} */ (this.#shape(focused))?.focus();
    this.#mark();
  }

  #drawFacts() {
    /** @type {Fact[]} */
    const facts = this.model.get("facts");
    this.list.replaceChildren(...facts.map((fact) => h("tr", {}, h("td", { text: fact.kind }), h("td", {}, h("code", { text: fact.name })),
      h("td", {}, ...pairs(fact)))));
    if (!facts.length) this.list.replaceChildren(h("tr", {}, h("td", { colspan: 3, text: "Nothing is on the graph yet." })));
    const list = /** @type {HTMLDetailsElement} */ (this.el.querySelector(".ros-list"));
    if (!this.model.get("drawing") && facts.length) list.open = true;
    this.#drawDetails();
  }

  #drawDetails() {
    const fact = this.model.get("facts").find((/** @type {Fact} */ each) => each.key === this.chosen);
    if (!fact) {
      this.chosen = "";
      const some = this.model.get("facts").length > 0;
      return this.details.replaceChildren(h("span", { class: "ros-muted", text: some ? "Click a shape for its details." :
        "Nothing is on the graph yet. Start a node; it appears here by itself." }));
    }
    this.details.replaceChildren(h("span", { class: "ros-muted", text: fact.kind }), h("code", { class: "ros-name", text: fact.name }), ...pairs(fact));
  }

  #drawBanner() {
    const notice = this.model.get("notice");
    const trouble = notice ? `The panel itself failed: ${notice}` : this.model.get("trouble");
    const text = trouble || (this.live || !this.model.get("live") ? "" : "No kernel answers: this picture was saved and does not follow the graph.");
    say(this.banner, text);
    this.banner.classList.toggle("ros-bad", Boolean(trouble));
    setAttribute(this.banner, "hidden", !text);
  }

  #drawBoxes() {
    this.noise.input.checked = this.model.get("noise");
    this.own.input.checked = this.model.get("show_own");
    setAttribute(this.own.el, "hidden", !this.model.get("own"));
    for (const each of [this.noise, this.own]) each.input.disabled = !this.live;
  }

  /** @param {boolean} live */
  kernel(live) {
    this.live = live;
    this.#drawBanner();
    this.#drawBoxes();
  }

  #toggle() {
    send(this.model, { kind: "choose", noise: this.noise.input.checked, show_own: this.own.input.checked });
  }

  /** @param {EventTarget | null} target */
  #choose(target) {
    const key = /** @type {Element} */ (target).closest("[data-key]")?.getAttribute("data-key") ?? "";
    this.chosen = key;
    this.#mark();
    this.#drawDetails();
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    this.#choose(event.target);
  }

  /** Show what is chosen and the lines that touch it. */
  #mark() {
    for (const shape of this.canvas.querySelectorAll("[data-key]")) {
      const chosen = shape.getAttribute("data-key") === this.chosen;
      shape.classList.toggle("ros-chosen", chosen);
      shape.setAttribute("aria-pressed", String(chosen));
    }
    for (const edge of this.canvas.querySelectorAll(".ros-edge"))
      edge.classList.toggle("ros-chosen", this.chosen !== "" && [edge.getAttribute("data-tail"), edge.getAttribute("data-head")].includes(this.chosen));
  }

  /** @param {string} key @returns {Element | undefined} */
  #shape(key) {
    return [...this.canvas.querySelectorAll("[data-key]")].find((shape) => shape.getAttribute("data-key") === key);
  }
}

/** @param {Fact} fact */
function pairs(fact) {
  const shown = fact.lost ? [["state", "does not answer"], ...fact.facts] : fact.facts;
  return shown.map(([label, value]) => h("span", { class: "ros-pair" }, h("span", { class: "ros-muted", text: `${label} ` }), h("code", { text: value })));
}

/** @param {string} label @param {() => void} changed */
function box(label, changed) {
  const id = freshId("ros-box");
  const input = /** @type {HTMLInputElement} */ (h("input", { id, type: "checkbox", onchange: changed }));
  return { input, el: h("label", { for: id, class: "ros-box" }, input, h("span", { text: label })) };
}

/** @param {string} kind @param {string} text */
function sample(kind, text) {
  const item = h("li", {});
  const shapes = { node: '<ellipse cx="14" cy="9" rx="13" ry="7"/>', topic: '<rect x="1" y="2" width="26" height="14" rx="2"/>',
    service: '<polygon points="1,9 7,2 21,2 27,9 21,16 7,16"/>' };
  item.innerHTML = `<svg width="28" height="18" aria-hidden="true"><g class="ros-shape ros-${kind}">${shapes[/** @type {keyof shapes} */ (kind)]}</g></svg>`;
  item.append(text);
  return item;
}

export default { render };

/* The graph panel: the drawing, the details of what is clicked, and the same facts as a list. */
import { freshId, h, kernelLink, say, send, setAttribute } from "../kit.js";
import { Canvas } from "./canvas.js";
import { pairs } from "./words.js";

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const ending = new AbortController();
  const panel = new GraphView(model);
  el.append(panel.el);
  kernelLink(model, ending.signal, (live) => panel.kernel(live));
  const clock = setInterval(() => panel.tick(), 1000);
  ending.signal.addEventListener("abort", () => clearInterval(clock));
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
    model.on("change:activity", () => this.#drawActivity());
    model.on("change:spaces", () => this.#drawFolding());
    for (const trait of ["trouble", "notice"]) model.on(`change:${trait}`, () => this.#drawBanner());
    for (const trait of ["noise", "own", "show_own"]) model.on(`change:${trait}`, () => this.#drawBoxes());
    this.#draw();
    this.#drawFacts();
    this.#drawBanner();
    this.#drawBoxes();
    this.#drawFolding();
  }

  #build() {
    this.banner = h("div", { class: "ros-banner", role: "status", hidden: true });
    this.canvas = new Canvas((key, folded) => this.#choose(key, folded));
    this.details = h("div", { class: "ros-details", "aria-live": "polite" });
    this.noise = box("loggers and /rosout", () => this.#toggle());
    this.own = box("this notebook's node", () => this.#toggle());
    this.list = h("tbody", {});
    const legend = h("ul", { class: "ros-legend", "aria-label": "Shapes" }, sample("node", "node"), sample("topic", "topic: a stream, one way"),
      sample("service", "service: a question and its answer"), sample("asked", "a call lately; dashed: still waits"));
    this.folding = h("div", { class: "ros-boxes", role: "group", "aria-label": "Namespaces", hidden: true },
      h("span", { class: "ros-muted", text: "Namespaces" }), this.#fold("Fold all", true), this.#fold("Unfold all", false));
    this.el = h("section", { class: "ros-panel ros-graph", "aria-label": "Graph panel" }, this.banner, this.canvas.tools, this.canvas.el, this.details,
      h("div", { class: "ros-foot" }, legend, this.folding,
        h("div", { class: "ros-boxes", role: "group", "aria-label": "Show" }, h("span", { class: "ros-muted", text: "Show" }), this.noise.el, this.own.el)),
      h("details", { class: "ros-list" }, h("summary", { text: "The same as a list" }), h("table", {}, h("thead", {}, h("tr", {},
        ...["Kind", "Name", "Details"].map((text) => h("th", { scope: "col", text })))), this.list)));
  }

  #draw() {
    this.canvas.draw(this.model.get("drawing"));
    this.#drawActivity();
  }

  #drawActivity() {
    this.canvas.happen(this.#activity());
    this.#drawList();
    this.#drawDetails();
  }

  #drawFacts() {
    const list = /** @type {HTMLDetailsElement} */ (this.el.querySelector(".ros-list"));
    if (!this.model.get("drawing") && this.model.get("facts").length) list.open = true;
    this.#drawList();
    this.#drawDetails();
  }

  #drawList() {
    /** @type {import("./words.js").Fact[]} */
    const facts = this.model.get("facts").filter((/** @type {import("./words.js").Fact} */ each) => each.kind !== "namespace");
    const said = JSON.stringify([facts, this.#activity().details, this.#activity().callers, this.live]);
    if (said === this.listed) return;
    this.listed = said;
    this.list.replaceChildren(...facts.map((fact) => h("tr", {}, h("td", { text: fact.kind }), h("td", {}, h("code", { text: fact.name })),
      h("td", {}, ...pairs(fact, this.#activity(), false)))));
    if (!facts.length) this.list.replaceChildren(h("tr", {}, h("td", { colspan: 3, text: "Nothing is on the graph yet." })));
  }

  #drawDetails() {
    const fact = this.model.get("facts").find((/** @type {import("./words.js").Fact} */ each) => each.key === this.chosen);
    const some = this.model.get("facts").length > 0;
    const parts = fact ? [h("div", { class: "ros-what" }, h("span", { class: "ros-muted", text: `${fact.kind} ` }), h("code", { class: "ros-name", text: fact.name })),
      ...pairs(fact, this.#activity(), this.live)] : [h("span", { class: "ros-muted", text: some ? "Click a shape for its details." :
      "Nothing is on the graph yet. Start a node; it appears here by itself." })];
    // Only what differs is written: a selection and a reader's place stay.
    const said = parts.map((part) => part.textContent).join("\n");
    if (said !== this.said) this.details.replaceChildren(...parts);
    this.said = said;
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

  #drawFolding() {
    /** @type {{name: string, folded: boolean}[]} */
    const spaces = this.model.get("spaces") ?? [];
    setAttribute(this.folding, "hidden", !spaces.length);
    const [fold, unfold] = /** @type {NodeListOf<HTMLButtonElement>} */ (this.folding.querySelectorAll("button"));
    fold.disabled = !this.live || spaces.every((each) => each.folded);
    unfold.disabled = !this.live || spaces.every((each) => !each.folded);
  }

  /** @param {boolean} live */
  kernel(live) {
    this.live = live;
    this.#drawBanner();
    this.#drawBoxes();
    this.#drawFolding();
    this.#drawDetails();
  }

  /** A second has passed: what was said to be so long ago is longer ago. */
  tick() {
    if (this.chosen.startsWith("service ")) this.#drawDetails();
  }

  /** @returns {import("./words.js").Activity} */
  #activity() {
    return this.model.get("activity") ?? {}; // a panel that was saved by an older release has none
  }

  #toggle() {
    send(this.model, { kind: "choose", noise: this.noise.input.checked, show_own: this.own.input.checked });
  }

  /** @param {string} text @param {boolean} fold */
  #fold(text, fold) {
    return h("button", { type: "button", class: "ros-quiet", text, onclick: () => send(this.model, { kind: "fold", name: "", fold }) });
  }

  /** @param {string} key @param {boolean | null} folded whether it is a folded namespace or a frame; null: neither */
  #choose(key, folded) {
    this.chosen = key;
    this.canvas.choose(key);
    this.#drawDetails();
    if (folded !== null && this.live) send(this.model, { kind: "fold", name: key.slice("namespace ".length), fold: !folded });
  }
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
    service: '<polygon points="1,9 7,2 21,2 27,9 21,16 7,16"/>', asked: '<path d="M2,9 H18"/><polygon points="27,9 18,5 18,13"/>' };
  item.innerHTML = `<svg width="28" height="18" aria-hidden="true"><g class="ros-shape ros-${kind}">${shapes[/** @type {keyof shapes} */ (kind)]}</g></svg>`;
  item.append(text);
  return item;
}

export default { render };

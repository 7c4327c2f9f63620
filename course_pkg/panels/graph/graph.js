/* The graph panel: the drawing, the details of the chosen shape, and all details as a list. */
import { freshId, h, kernelLink, say, send, setAttribute } from "../kit.js";
import { Replay, watch } from "../replay.js";
import { Canvas } from "./canvas.js";
import { recordingOf } from "./recording.js";
import { pairs } from "./sentences.js";

const TICK = 250; // While a recording plays, this code draws the fading lines every TICK ms.

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const ending = new AbortController();
  const panel = new GraphView(model, ending.signal);
  el.append(panel.el);
  kernelLink(model, ending.signal, (live) => panel.kernel(live));
  const clock = setInterval(() => panel.tick(), 1000);
  ending.signal.addEventListener("abort", () => clearInterval(clock));
  return () => ending.abort();
}

class GraphView {
  /** @param {import("../kit.js").Model} model @param {AbortSignal} signal */
  constructor(model, signal) {
    this.model = model;
    this.live = true;
    this.chosen = "";
    /** @type {import("./recording.js").Recording | null} */
    this.recording = null; // the recording that is played; null if a kernel answers or if nothing was recorded
    /** @type {any} */
    this.moment = null; // the moment of the recording that is shown
    this.step = 0; // the number of TICKs since the start of the recording
    this.#build();
    watch(this.el, signal, (visible) => this.replay.see(visible));
    signal.addEventListener("abort", () => this.replay.stop());
    model.on("change:drawing", () => this.#draw());
    model.on("change:facts", () => this.#drawFacts());
    model.on("change:activity", () => this.#drawActivity());
    model.on("change:spaces", () => this.#drawFolding());
    for (const trait of ["trouble", "notice"]) model.on(`change:${trait}`, () => this.#drawBanner());
    for (const trait of ["noise", "own", "show_own"]) model.on(`change:${trait}`, () => this.#drawBoxes());
    this.#drawBoxes();
    this.#drawAll();
  }

  #build() {
    this.banner = h("div", { class: "ros-banner", role: "status", hidden: true });
    this.canvas = new Canvas((key, folded) => this.#choose(key, folded));
    this.replay = new Replay((time) => this.#see(time));
    setAttribute(this.replay.el, "hidden", true);
    this.details = h("div", { class: "ros-details", "aria-live": "polite" });
    this.noise = box("loggers and /rosout", () => this.#toggle());
    this.own = box("this notebook's node", () => this.#toggle());
    this.list = h("tbody", {});
    const legend = h("ul", { class: "ros-legend", "aria-label": "Shapes" }, sample("node", "node"), sample("topic", "topic: messages in one direction"),
      sample("service", "service: a request and its response"), sample("asked", "a recent call; dashed: the call still waits"));
    this.folding = h("div", { class: "ros-boxes", role: "group", "aria-label": "Namespaces", hidden: true },
      h("span", { class: "ros-muted", text: "Namespaces" }), this.#fold("Fold all", true), this.#fold("Unfold all", false));
    this.el = h("section", { class: "ros-panel ros-graph", "aria-label": "Graph panel" }, this.banner, this.canvas.tools, this.canvas.el, this.replay.el, this.details,
      h("div", { class: "ros-foot" }, legend, this.folding,
        h("div", { class: "ros-boxes", role: "group", "aria-label": "Show" }, h("span", { class: "ros-muted", text: "Show" }), this.noise.el, this.own.el)),
      h("details", { class: "ros-list" }, h("summary", { text: "The same as a list" }), h("table", {}, h("thead", {}, h("tr", {},
        ...["Kind", "Name", "Details"].map((text) => h("th", { scope: "col", text })))), this.list)));
  }

  /** Returns a trait from the recording if one is played, otherwise from the model. @param {string} trait */
  #get(trait) {
    return this.moment ? this.moment[trait] : this.model.get(trait);
  }

  #drawAll() {
    this.#draw();
    this.#drawFacts();
    this.#drawBanner();
    this.#drawFolding();
  }

  #draw() {
    this.canvas.draw(this.#get("drawing"));
    this.#drawActivity();
  }

  #drawActivity() {
    this.canvas.happen(this.#activity(), this.#clock());
    this.#drawList();
    this.#drawDetails();
  }

  #drawFacts() {
    const list = /** @type {HTMLDetailsElement} */ (this.el.querySelector(".ros-list"));
    if (!this.#get("drawing") && this.#get("facts").length) list.open = true;
    this.#drawList();
    this.#drawDetails();
  }

  #drawList() {
    /** @type {import("./sentences.js").Fact[]} */
    const facts = this.#get("facts").filter((/** @type {import("./sentences.js").Fact} */ each) => each.kind !== "namespace");
    const said = JSON.stringify([facts, this.#activity().details, this.#activity().callers, this.live]);
    if (said === this.listed) return;
    this.listed = said;
    this.list.replaceChildren(...facts.map((fact) => h("tr", {}, h("td", { text: fact.kind }), h("td", {}, h("code", { text: fact.name })),
      h("td", {}, ...pairs(fact, this.#activity(), null)))));
    if (!facts.length) this.list.replaceChildren(h("tr", {}, h("td", { colspan: 3, text: "Nothing is on the graph yet." })));
  }

  #drawDetails() {
    const fact = this.#get("facts").find((/** @type {import("./sentences.js").Fact} */ each) => each.key === this.chosen);
    const some = this.#get("facts").length > 0;
    const now = this.#clock() ?? (this.live ? Date.now() / 1000 : null);
    const parts = fact ? [h("div", { class: "ros-what" }, h("span", { class: "ros-muted", text: `${fact.kind} ` }), h("code", { class: "ros-name", text: fact.name })),
      ...pairs(fact, this.#activity(), now)] : [h("span", { class: "ros-muted", text: some ? "Click a shape for its details." :
      this.moment ? "The graph was empty at this moment." : "Nothing is on the graph yet. Start a node; the node then appears here." })];
    // The details are replaced only if they differ. Otherwise, a selection and the position of a screen reader would be lost.
    const said = parts.map((part) => part.textContent).join("\n");
    if (said !== this.said) this.details.replaceChildren(...parts);
    this.said = said;
  }

  #drawBanner() {
    const notice = this.model.get("notice");
    const trouble = notice ? `The panel itself failed: ${notice}` : this.#get("trouble");
    const saved = this.recording ? "No kernel answers: this is a recording. Play it, or move the slider." : "No kernel answers: this is a saved picture, which does not change when the graph changes.";
    const text = trouble || (this.live || !this.model.get("live") ? "" : saved);
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
    const spaces = this.#get("spaces") ?? [];
    setAttribute(this.folding, "hidden", !spaces.length);
    const [fold, unfold] = /** @type {NodeListOf<HTMLButtonElement>} */ (this.folding.querySelectorAll("button"));
    fold.disabled = !this.live || spaces.every((each) => each.folded);
    unfold.disabled = !this.live || spaces.every((each) => !each.folded);
  }

  /** @param {boolean} live */
  kernel(live) {
    this.live = live;
    this.#drawBoxes();
    this.#turnTo(live ? null : recordingOf(this.model.get("history")));
    this.#drawBanner();
    this.#drawFolding();
    this.#drawDetails();
  }

  /** Shows the end of a recording; null means that the panel shows the current graph.
   * @param {import("./recording.js").Recording | null} recording */
  #turnTo(recording) {
    const was = this.recording;
    this.recording = recording;
    setAttribute(this.replay.el, "hidden", !recording);
    this.replay.stop();
    if (recording) {
      this.replay.be(recording.length, recording.length, true);
      this.replay.show();
      this.#see(recording.length);
    } else if (was) {
      this.moment = null;
      this.canvas.el.style.minHeight = "";
      this.#drawAll();
    }
  }

  /** Shows a moment of the recording. @param {number} time in ms */
  #see(time) {
    const [before, now, step] = [this.moment, this.recording?.at(time), Math.floor(time / TICK)];
    if (!now || (now === before && step === this.step)) return;
    this.moment = now;
    this.step = step;
    // While the recording plays, the text changes often, so a screen reader would read too much.
    setAttribute(this.details, "aria-live", this.replay.playing ? "off" : "polite");
    if (before?.scene === now.scene) return this.#drawActivity();
    // While the recording plays, the height of the canvas is constant, so the text below does not jump.
    this.canvas.el.style.minHeight = `${this.canvas.el.offsetHeight}px`;
    this.#drawAll();
  }

  /** Returns the time of the shown moment in s since the epoch, or null for the current time. */
  #clock() {
    return this.recording && this.moment ? this.recording.clock(this.replay.time) : null;
  }

  /** Updates the texts every second, because texts such as "5 s ago" change. */
  tick() {
    if (this.chosen.startsWith("service ")) this.#drawDetails();
  }

  /** @returns {import("./sentences.js").Activity} */
  #activity() {
    return this.#get("activity") ?? {}; // A panel that an older release saved has no activity.
  }

  #toggle() {
    send(this.model, { kind: "choose", noise: this.noise.input.checked, show_own: this.own.input.checked });
  }

  /** @param {string} text @param {boolean} fold */
  #fold(text, fold) {
    return h("button", { type: "button", class: "ros-quiet", text, onclick: () => send(this.model, { kind: "fold", name: "", fold }) });
  }

  /** @param {string} key @param {boolean | null} folded true for a folded namespace, false for a frame, null for a shape */
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

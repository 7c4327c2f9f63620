/* The topic panel: the nodes on the topic, a form to publish, the received messages, a chart. The model holds all
   state. */
import { FieldsForm } from "../forms/fields.js";
import { command, valueTable } from "../forms/parts.js";
import { freshId, h, kernelLink, same, say, send, setAttribute } from "../kit.js";
import { Chart } from "./chart.js";
import { deliveries, figures, names, number, seconds, setting } from "./parts.js";

const SETTLE = 120; // The panel sends typed texts if the student has pressed no key for this many ms.
const SLOW = 1500; // If the kernel has not handled a click after this many ms, the panel shows the reason.
const AGEING = 250; // The ages of the messages are updated every AGEING ms.
const SPAN = 20; // The chart shows this many s.

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const ending = new AbortController();
  const view = new TopicView(model, ending.signal);
  el.append(view.el);
  return () => ending.abort();
}

class TopicView {
  /** @param {import("../kit.js").Model} model @param {AbortSignal} signal */
  constructor(model, signal) {
    this.model = model;
    this.live = true;
    this.refused = model.get("check").refused ?? 0;
    /** @type {Map<number, number>} the time at which each message came, by the page's clock (ms) */
    this.came = new Map();
    this.fields = new FieldsForm(() => this.#edited(), "This message has no fields.");
    this.chart = new Chart();
    this.#build();
    const draw = { about: this.#drawAbout, trouble: this.#drawBanner, notice: this.#drawBanner, draft: () => this.fields.fill(model.get("draft")),
      settings: this.#drawSettings, check: this.#drawCheck, connections: this.#drawConnections, publisher: this.#drawPublisher, subscription: this.#drawSubscription,
      messages: this.#drawMessages, latest: this.#drawLatest, curve: this.#drawCurve };
    for (const [trait, part] of Object.entries(draw)) {
      model.on(`change:${trait}`, () => part.call(this));
      if (trait !== "draft") part.call(this);
    }
    const ageing = setInterval(() => this.#age(), AGEING);
    model.on("msg:custom", (/** @type {{kind: string}} */ content) => { if (content.kind === "taken") this.#settle(); });
    signal.addEventListener("abort", () => { clearTimeout(this.settling); clearTimeout(this.slow); clearInterval(ageing); this.chart.end(); });
    kernelLink(model, signal, (live) => this.#kernel(live));
  }

  #build() {
    this.banner = h("div", { class: "ros-banner", role: "status", hidden: true });
    this.about = h("p", { class: "ros-about ros-muted" });
    this.who = h("div", { class: "ros-who" });
    this.warnings = h("ul", { class: "ros-warnings", role: "status", hidden: true });
    this.problem = h("p", { class: "ros-empty", role: "status", hidden: true });
    this.body = h("div", { class: "ros-body" }, this.#publishing(), this.#hearing());
    this.el = h("section", { class: "ros-panel ros-topic-panel", "aria-label": "Topic panel", onkeydown: (/** @type {KeyboardEvent} */ event) => this.#key(event) },
      this.banner, h("div", { class: "ros-head" }, h("h3", {}, "Topic ", h("code", { text: this.model.get("about").topic })), this.about, this.who),
      this.warnings, this.problem, this.body, this.#drawing(), this.#byHand());
  }

  #publishing() {
    this.rate = setting("Rate", "Hz", "decimal", () => this.#edited());
    this.queue = setting("Queue size", "messages", "numeric", () => this.#edited());
    const id = freshId("ros-latch");
    this.latch = /** @type {HTMLInputElement} */ (h("input", { id, type: "checkbox", onchange: () => this.#edited() }));
    this.once = h("button", { type: "submit", class: "ros-main", text: "Publish" });
    this.often = h("button", { type: "button", text: "Publish at a rate", onclick: () => this.#repeat() });
    this.burst = h("button", { type: "button", onclick: () => this.#act("burst") });
    this.withdraw = h("button", { type: "button", class: "ros-quiet", text: "Unregister the publisher", onclick: () => this.#send({ kind: "withdraw" }) });
    this.wrong = h("p", { class: "ros-note ros-wrong" });
    this.words = h("p", { class: "ros-words", role: "status", "aria-live": "polite" });
    this.waiting = h("p", { class: "ros-muted", role: "status" });
    this.counts = h("div", { class: "ros-counts" });
    return h("form", { novalidate: true, class: "ros-publishing", "aria-label": "Publish", onsubmit: (/** @type {Event} */ event) => {
      event.preventDefault();
      this.#act("publish");
    } }, h("h4", { text: "Publish" }), this.fields.el,
    h("div", { class: "ros-settings" }, this.rate.el, this.queue.el, h("label", { class: "ros-latch", for: id }, this.latch, "Latch: keep the last message for later subscribers")),
    h("div", { class: "ros-actions" }, this.once, this.often, this.burst, this.wrong), this.waiting, this.words, this.counts, this.withdraw);
  }

  #hearing() {
    this.figures = h("p", { class: "ros-figures" });
    this.agedText = h("span", { class: "ros-muted" });
    this.latest = h("div", { class: "ros-latest" });
    this.messages = h("ol", { class: "ros-messages", "aria-label": "The last messages" });
    return h("section", { class: "ros-hearing", "aria-label": "Received" }, h("div", { class: "ros-heading" }, h("h4", { text: "Received" }), this.agedText),
      this.figures, this.latest, this.messages);
  }

  #drawing() {
    const id = freshId("ros-path");
    this.path = /** @type {HTMLSelectElement} */ (h("select", { id, onchange: () => this.#edited() }));
    this.left = h("span", { class: "ros-muted" });
    this.plot = h("section", { class: "ros-drawing", "aria-label": "Plot" },
      h("div", { class: "ros-heading" }, h("label", { for: id, text: "Draw" }), this.path, this.left), this.chart.el);
    return this.plot;
  }

  #byHand() {
    const pre = (/** @type {string} */ label) => h("pre", { tabindex: "0", "aria-label": label });
    [this.onceLine, this.oftenLine, this.python] = [pre("Command that publishes once"), pre("Command that publishes at a rate"), pre("Python lines")];
    this.stale = h("span", { class: "ros-muted" });
    this.listening = (this.model.get("about").listen ?? []).map((/** @type {string} */ line) => {
      const shown = pre(line.split(" ").slice(0, 2).join(" "));
      say(shown, line);
      return command(line.split(" ")[1], shown, "the command");
    });
    this.publishLines = h("div", {}, command("once", this.onceLine, "the command"), command("at a rate", this.oftenLine, "the command"), command("Python", this.python, "the Python lines"));
    return h("details", { class: "ros-commands" }, h("summary", { text: "The same as commands and in Python" }), this.stale, this.publishLines, ...this.listening);
  }

  #drawAbout() {
    const { message, numbers = [], problem, burst } = this.model.get("about");
    setAttribute(this.problem, "hidden", Boolean(message));
    say(this.problem, problem ?? "");
    for (const part of [this.body, this.publishLines]) setAttribute(part, "hidden", !message);
    setAttribute(this.plot, "hidden", !numbers.length);
    say(this.burst, `${burst} at once`);
    if (!message || same([message.name, message.md5], this.shown)) return;
    this.shown = [message.name, message.md5];
    this.about.replaceChildren(h("code", { text: message.name }), h("span", { text: ` MD5 ${message.md5.slice(0, 8)}…`, title: message.md5 }));
    this.fields.show(message.fields, message.constants, this.model.get("draft"));
    this.path.replaceChildren(...numbers.map((/** @type {string} */ path) => h("option", { value: path, text: path })));
    this.#drawSettings();
  }

  #drawSettings() {
    const { rate = "", queue = "", latch = false, path = "" } = this.model.get("settings");
    for (const [control, text] of [[this.rate.input, rate], [this.queue.input, queue]]) if (control.value !== text) control.value = text;
    this.latch.checked = latch;
    this.path.value = path;
  }

  #drawCheck() {
    const { errors = {}, refused = 0, once, often, python } = this.model.get("check");
    const anew = refused > this.refused;
    this.refused = Math.max(refused, this.refused);
    this.fields.mark(errors, refused > 0);
    for (const [control, name] of [[this.rate.input, "@rate"], [this.queue.input, "@queue"]])
      setAttribute(control, "aria-invalid", errors[name] ? "true" : null);
    say(this.wrong, [errors["@rate"], errors["@queue"]].filter(Boolean).join(" "));
    if (once !== undefined) [[this.onceLine, once], [this.oftenLine, often], [this.python, python]].forEach(([pre, line]) => say(pre, line));
    say(this.stale, Object.keys(errors).length ? "These lines are for the last message without a mistake." : "");
    if (anew) this.#refuse(errors);
  }

  /** @param {Record<string, string>} errors */
  #refuse(errors) {
    const count = Object.keys(errors).length;
    say(this.words, `Not published: ${count === 1 ? "one field needs" : `${count} fields need`} a correction.`);
    const settings = [this.rate.input, this.queue.input].find((input) => input.ariaInvalid);
    if (settings && !this.fields.el.querySelector("[aria-invalid]")) settings.focus();
    else this.fields.focus();
  }

  #drawConnections() {
    const { publishers = [], subscribers = [], own = "", warnings = [] } = this.model.get("connections");
    const said = [names(publishers, own, "no node"), names(subscribers, own, "no node")];
    if (!same(said, this.saidWho)) {
      this.saidWho = said;
      this.who.replaceChildren(...["Published by", "Subscribed by"].flatMap((label, index) => [h("span", { class: "ros-muted", text: label }), h("span", { text: said[index] })]));
    }
    setAttribute(this.warnings, "hidden", !warnings.length);
    if (same(warnings, this.warned)) return;
    this.warned = warnings;
    this.warnings.replaceChildren(...warnings.map((/** @type {string} */ text) => h("li", { text })));
  }

  #drawPublisher() {
    const publisher = this.model.get("publisher");
    say(this.words, publisher.problem || publisher.words || "Nothing is published yet. The first message creates the publisher.");
    this.words.classList.toggle("ros-failed", Boolean(publisher.problem));
    say(this.often, publisher.rate ? "Stop" : "Publish at a rate");
    setAttribute(this.withdraw, "hidden", !publisher.advertised);
    const facts = [publisher.published, publisher.unheard, publisher.sent, publisher.dropped, publisher.deliveries];
    if (same(facts, this.counted)) return;
    this.counted = facts;
    this.counts.replaceChildren(...(publisher.published ? [figures(publisher), deliveries(publisher)] : []));
  }

  #drawSubscription() {
    const { count = 0, statistics = {} } = this.model.get("subscription");
    const regular = statistics.rate ? ` at ${number(statistics.rate)} Hz, with a jitter of ${number(1000 * statistics.jitter)} ms` : "";
    say(this.figures, count ? `${count.toLocaleString("en")} ${count === 1 ? "message" : "messages"}${regular}.` : this.live ? "Nothing received yet." : "Nothing was received.");
    this.figures.title = statistics.gaps ? `over the last ${statistics.gaps + 1} messages; the longest gap was ${number(1000 * statistics.longest)} ms` : "";
  }

  #drawMessages() {
    /** @type {{number: number, ago: number, peer: string, line: string, understood: boolean}[]} */
    const entries = this.model.get("messages");
    const now = performance.now();
    this.came = new Map(entries.map(({ number: each, ago }) => [each, this.came.get(each) ?? now - 1000 * ago]));
    this.lines = entries.map((entry) => ({ entry, age: h("span", { class: "ros-muted ros-age" }) }));
    this.messages.replaceChildren(...this.lines.map(({ entry, age }) => h("li", { class: entry.understood ? "" : "ros-strange", title: `from ${entry.peer}` },
      h("span", { class: "ros-muted", text: `#${entry.number}` }), h("code", { text: entry.line }), age)));
    this.#age();
  }

  #age() {
    const now = performance.now();
    const age = (/** @type {number} */ each) => (now - (this.came.get(each) ?? now)) / 1000;
    const [first] = this.lines ?? [];
    say(this.agedText, first && this.live ? `the latest ${seconds(age(first.entry.number))} ago` : "");
    for (const line of this.lines ?? []) say(line.age, this.live ? seconds(age(line.entry.number)) : "");
  }

  #drawLatest() {
    const rows = this.model.get("latest");
    // For a message with one field, the list of messages already shows all values.
    this.latest.replaceChildren(...(rows.length > 1 ? [valueTable(rows, "")] : []));
  }

  #drawCurve() {
    const { points = [], count = 0, left_out: left = 0 } = JSON.parse(this.model.get("curve") || "{}");
    const last = points.at(-1)?.[0] ?? SPAN;
    say(this.left, left ? `${left} of ${count} values are not drawn, because they are NaN, infinite or missing.` : "");
    this.chart.show({ y: this.path.value, points, count, window: [Math.max(0, last - SPAN), Math.max(last, SPAN)] });
  }

  #drawBanner() {
    const [notice, trouble] = [this.model.get("notice"), this.model.get("trouble")];
    const text = notice ? `The panel itself failed: ${notice}` : !this.live ? "No kernel answers: this is the last saved state of the panel. Run the notebook to publish and to receive." : trouble;
    say(this.banner, text);
    this.banner.classList.toggle("ros-bad", Boolean(notice || (this.live && trouble)));
    setAttribute(this.banner, "hidden", !text);
  }

  /** @param {boolean} live */
  #kernel(live) {
    this.live = live;
    this.#drawBanner();
    this.#drawSubscription();
    this.#age();
    for (const button of [this.once, this.often, this.burst, this.withdraw]) setAttribute(button, "aria-disabled", live ? null : "true");
  }

  #edited() {
    clearTimeout(this.settling);
    this.settling = setTimeout(() => this.#save(), SETTLE);
  }

  #save() {
    clearTimeout(this.settling);
    this.model.set("draft", structuredClone(this.fields.draft));
    this.model.set("settings", this.#settings());
    this.model.save_changes();
  }

  #settings() {
    return { rate: this.rate.input.value, queue: this.queue.input.value, latch: this.latch.checked, path: this.path.value };
  }

  /** @param {string} action */
  #act(action) {
    clearTimeout(this.settling);
    this.#send({ kind: "act", action, draft: this.fields.draft, settings: this.#settings() });
  }

  #repeat() {
    if (this.model.get("publisher").rate) this.#send({ kind: "stop" });
    else this.#act("repeat");
  }

  /** @param {object} content */
  #send(content) {
    if (!this.live || !send(this.model, content)) return;
    clearTimeout(this.slow);
    this.slow = setTimeout(() => say(this.waiting, "Waiting for the kernel: it is busy with another cell."), SLOW);
  }

  /** Shows that the kernel has handled a click. */
  #settle() {
    clearTimeout(this.slow);
    say(this.waiting, "");
  }

  /** JupyterLab stops the Enter key from submitting a form, so this code submits the form.
   * @param {KeyboardEvent} event */
  #key(event) {
    if (event.key !== "Enter" || !(event.target instanceof HTMLInputElement)) return;
    event.preventDefault();
    this.#act("publish");
  }
}

export default { render };

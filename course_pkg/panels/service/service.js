/* The service panel: the student picks a service, fills in the request, calls the service, and reads the
   response. The model holds all state. */
import { FieldsForm } from "../forms/fields.js";
import { command, valueTable } from "../forms/parts.js";
import { freshId, h, kernelLink, prose, same, say, send, setAttribute } from "../kit.js";
import { recorded } from "./recording.js";

const SETTLE = 120; // The panel sends the draft if the student has pressed no key for this many ms.
const LONG = 8; // If a form has more fields than this, the response is below the form instead of beside it.
const SLOW = 1500; // If a click has no answer after this many ms, the panel shows the reason.

/** @param {{model: import("../kit.js").Model, el: HTMLElement, signal?: AbortSignal}} context */
function render({ model, el }) {
  const ending = new AbortController();
  const panel = new ServiceView(model, ending.signal);
  el.append(panel.el);
  return () => ending.abort();
}

class ServiceView {
  /** @param {import("../kit.js").Model} model @param {AbortSignal} signal */
  constructor(model, signal) {
    this.model = model;
    // This is true until the kernel fails to answer; otherwise, "No kernel" would appear for a moment.
    this.live = true;
    this.waiting = false;
    this.refused = model.get("check").refused ?? 0;
    this.request = new FieldsForm(() => this.#edited(), "This request has no fields.");
    this.#build();
    const draw = { services: "picker", trouble: "picker", notice: "banner", form: "picker", draft: "draft", check: "check",
      outcome: "outcome", history: "history", recording: "history", deadline: "deadline" };
    for (const [trait, part] of Object.entries(draw)) model.on(`change:${trait}`, () => this.#draw(part));
    for (const part of ["picker", "deadline", "check", "outcome", "history", "banner"]) this.#draw(part);
    signal.addEventListener("abort", () => [this.settling, this.slow, this.ticking].forEach(clearTimeout));
    kernelLink(model, signal, (live) => this.#kernel(live));
  }

  #build() {
    const id = freshId("ros-service");
    this.banner = h("div", { class: "ros-banner", role: "status", hidden: true });
    this.picker = /** @type {HTMLSelectElement} */ (h("select", { id, onchange: () => this.#pick() }));
    this.about = h("p", { class: "ros-about ros-muted" });
    this.problem = h("p", { class: "ros-problem", role: "status", hidden: true });
    this.deadline = /** @type {HTMLInputElement} */ (h("input", { type: "text", inputmode: "decimal",
      class: "ros-text", autocomplete: "off", "aria-describedby": `${id}-limit`, oninput: () => this.#edited() }));
    this.limit = h("span", { id: `${id}-limit`, class: "ros-note" });
    this.callButton = h("button", { type: "submit", class: "ros-main", text: "Call" });
    this.cancelButton = h("button", { type: "button", text: "Cancel", onclick: () => this.#cancel() });
    this.status = h("p", { class: "ros-status", role: "status", "aria-live": "polite" });
    this.clock = h("span", { class: "ros-muted ros-clock", "aria-hidden": "true" });
    this.answer = h("div", { class: "ros-answer" });
    this.shell = h("pre", { tabindex: "0", "aria-label": "Command for a terminal" });
    this.python = h("pre", { tabindex: "0", "aria-label": "Python lines" });
    this.stale = h("span", { class: "ros-muted" });
    this.past = h("ol", { class: "ros-past" });
    this.pastTitle = h("summary", {});
    this.history = h("details", { class: "ros-history" }, this.pastTitle, this.past);
    this.formElement = h("form", { novalidate: true, class: "ros-request", "aria-label": "Request", onsubmit: (/** @type {Event} */ event) => {
      event.preventDefault();
      this.#call();
    } }, h("h3", { text: "Request" }), this.request.el,
    h("div", { class: "ros-actions" }, this.callButton, this.cancelButton,
      h("label", { class: "ros-deadline" }, "Wait at most", this.deadline, "s"), this.limit));
    const response = h("section", { class: "ros-response", "aria-label": "Response" },
      h("div", { class: "ros-heading" }, h("h3", { text: "Response" }), this.clock), this.status, this.answer);
    this.body = h("div", { class: "ros-body" }, this.formElement, response);
    this.commands = h("section", { class: "ros-commands", "aria-label": "The same call as a command and in Python" },
      h("div", { class: "ros-heading" }, h("h3", { text: "The same call as a command and in Python" }), this.stale),
      command("Terminal", this.shell, "the command"), command("Python", this.python, "the Python lines"));
    this.empty = h("p", { class: "ros-empty", hidden: true });
    this.el = h("section", { class: "ros-panel ros-service", "aria-label": "Service panel", onkeydown: (/** @type {KeyboardEvent} */ event) => this.#key(event) }, this.banner, h("div", { class: "ros-head" }, h("label", { for: id, text: "Service" }), this.picker, this.about),
    this.problem, this.empty, this.body, this.commands, this.history);
  }

  /** @param {string} part */
  #draw(part) {
    const draw = { picker: () => this.#drawPicker(), banner: () => this.#drawBanner(),
      draft: () => this.request.fill(this.model.get("draft")), check: () => this.#drawCheck(), outcome: () => this.#drawOutcome(),
      history: () => this.#drawHistory(), deadline: () => this.#drawDeadline() };
    draw[/** @type {keyof typeof draw} */ (part)]();
  }

  #drawPicker() {
    const services = this.model.get("services");
    const picked = this.model.get("form").service ?? "";
    const known = services.some((/** @type {any} */ each) => each.name === picked);
    const option = (/** @type {any} */ each) => h("option", { value: each.name, text: each.name, selected: each.name === picked });
    const own = services.filter((/** @type {any} */ each) => !each.tool).map(option);
    const tools = services.filter((/** @type {any} */ each) => each.tool).map(option);
    const wanted = [picked, known, ...services.map((/** @type {any} */ each) => each.name)];
    if (!same(wanted, this.offered)) {
      this.offered = wanted;
      this.picker.replaceChildren(
        ...(picked ? [] : [h("option", { value: "", text: services.length ? "Pick a service" : "No service yet" })]),
        ...(picked && !known ? [h("option", { value: picked, text: `${picked} (not on the graph)`, selected: true })] : []),
        ...own, ...(tools.length ? [h("optgroup", { label: "Loggers of the nodes" }, ...tools)] : []));
    }
    this.picker.value = picked;
    this.#drawForm();
  }

  #drawForm() {
    const form = this.model.get("form");
    const typed = Boolean(form.request);
    if (typed && !same([form.service, form.type, form.md5], this.shown)) {
      this.shown = [form.service, form.type, form.md5];
      this.request.show(form.request.fields, form.request.constants, this.model.get("draft"));
      this.body.classList.toggle("ros-long", this.request.controls.size > LONG);
      this.refused = this.model.get("check").refused ?? 0;
    }
    this.about.replaceChildren(...(typed ? [h("code", { text: form.type }), ...(form.node ? [" served by ", h("code", { text: form.node })] : []),
      h("span", { class: "ros-md5", text: ` MD5 ${form.md5.slice(0, 8)}…`, title: form.md5 })] : []));
    setAttribute(this.problem, "hidden", !form.problem);
    say(this.problem, form.problem ?? "");
    for (const part of [this.body, this.commands]) setAttribute(part, "hidden", !typed);
    this.#drawEmpty(Boolean(form.service));
    this.#drawButtons();
  }

  /** @param {boolean} picked */
  #drawEmpty(picked) {
    const trouble = this.model.get("trouble");
    const some = this.model.get("services").length > 0;
    const text = trouble || (picked ? "" : some ? "Pick a service to see the fields of its request." :
      "No node provides a service yet. Run the cell that starts a server; its services then appear here.");
    say(this.empty, text);
    setAttribute(this.empty, "hidden", !text);
  }

  #drawCheck() {
    const check = this.model.get("check");
    const refused = check.refused ?? 0;
    const anew = refused > this.refused;
    this.refused = Math.max(refused, this.refused);
    this.request.mark(check.errors ?? {}, refused > 0);
    const late = check.errors?.["@deadline"] ?? "";
    setAttribute(this.deadline, "aria-invalid", late ? "true" : null);
    say(this.limit, late);
    this.limit.classList.toggle("ros-wrong", late !== "");
    if (check.shell !== undefined) {
      say(this.shell, check.shell);
      say(this.python, check.python);
    }
    say(this.stale, Object.keys(check.errors ?? {}).length ? "These lines are for the last request without a mistake." : "");
    if (anew) this.#refuse(Object.keys(check.errors).length);
  }

  /** @param {number} count */
  #refuse(count) {
    this.#settle();
    say(this.status, `Not called: ${count === 1 ? "one field needs" : `${count} fields need`} a correction.`);
    this.status.className = "ros-status ros-wrong";
    if (this.deadline.ariaInvalid && !this.el.querySelector(".ros-fields [aria-invalid]")) this.deadline.focus();
    else this.request.focus();
  }

  #drawOutcome() {
    this.#settle();
    this.#show(this.model.get("outcome"));
  }

  /** @param {any} outcome */
  #show(outcome) {
    const words = { idle: "Not called yet.", running: "Calling…", done: `Answered in ${outcome.ms} ms`,
      failed: `Failed after ${outcome.ms} ms`, cancelled: `Cancelled after ${outcome.ms} ms` };
    const phase = /** @type {keyof typeof words} */ (outcome.phase ?? "idle");
    say(this.status, words[phase]);
    this.status.className = `ros-status ros-${phase}`;
    say(this.clock, outcome.at ? `#${outcome.number} at ${outcome.at}` : "");
    clearInterval(this.ticking);
    if (phase === "running") this.#tick();
    else this.answer.replaceChildren(...(outcome.error ? failure(outcome.error) : outcome.rows ? [valueTable(outcome.rows, "The response has no fields. It shows only that the handler has finished.")] : []));
    this.answer.classList.toggle("ros-past-answer", phase === "running");
    this.#drawButtons();
  }

  #tick() {
    const began = performance.now();
    this.ticking = setInterval(() => say(this.clock, `${((performance.now() - began) / 1000).toFixed(1)} s`), 100);
  }

  #drawButtons() {
    const running = this.model.get("outcome").phase === "running";
    const answers = this.live || this.model.get("recording").length > 0;
    // The attribute `disabled` is not used, because a disabled button loses the keyboard focus.
    setAttribute(this.callButton, "aria-disabled", running || this.waiting || !answers ? "true" : null);
    setAttribute(this.cancelButton, "aria-disabled", running && this.live ? null : "true");
    this.picker.disabled = !this.live;
  }

  #drawDeadline() {
    const text = this.model.get("deadline");
    if (this.deadline.value !== text) this.deadline.value = text;
  }

  #drawHistory() {
    const recording = this.live ? [] : this.model.get("recording");
    const entries = recording.length ? recording : this.model.get("history");
    say(this.pastTitle, recording.length ? `Recorded requests (${entries.length})` : `History (${entries.length})`);
    setAttribute(this.history, "hidden", !entries.length);
    this.past.replaceChildren(...entries.map((/** @type {any} */ entry) => h("li", {},
      h("button", { type: "button", class: `ros-entry-line ros-${entry.phase}`, title: "Put this request into the form again", onclick: () => this.#recall(entry) },
        h("span", { class: "ros-muted", text: `#${entry.number}` }), h("code", { text: entry.asked }),
        h("span", { "aria-label": "gave", text: "→" }), h("code", { text: entry.said }), h("span", { class: "ros-muted", text: `${entry.ms} ms` })))));
  }

  #drawBanner() {
    const notice = this.model.get("notice");
    const text = notice ? `The panel itself failed: ${notice}` : this.live ? "" : this.model.get("recording").length
      ? "No kernel answers. The responses here were recorded from a real server. Pick a recorded request below, or run the notebook to call the service."
      : "No kernel answers: this is a saved panel. Run the notebook to call the service.";
    say(this.banner, text);
    this.banner.classList.toggle("ros-bad", notice !== "");
    setAttribute(this.banner, "hidden", !text);
  }

  /** @param {boolean} live */
  #kernel(live) {
    if (live === this.live) return;
    this.live = live;
    for (const part of ["banner", "history"]) this.#draw(part);
    this.#drawButtons();
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.key === "Escape") this.#cancel();
    // JupyterLab stops the Enter key from submitting a form, so this code submits the form.
    if (event.key !== "Enter" || !(event.target instanceof HTMLInputElement)) return;
    event.preventDefault();
    this.#call();
  }

  #pick() {
    send(this.model, { kind: "pick", service: this.picker.value });
  }

  #edited() {
    clearTimeout(this.settling);
    this.settling = setTimeout(() => this.#save(), SETTLE);
  }

  #save() {
    clearTimeout(this.settling);
    this.model.set("draft", structuredClone(this.request.draft));
    this.model.set("deadline", this.deadline.value);
    this.model.save_changes();
  }

  #call() {
    if (disabled(this.callButton)) return;
    this.#save(); // The kernel handles messages in order: first the typed texts, then the call.
    if (!this.live) return this.#replay();
    this.waiting = true;
    this.#drawButtons();
    this.slow = setTimeout(() => say(this.status, "Waiting for the kernel: it is busy with another cell."), SLOW);
    send(this.model, { kind: "call", draft: this.request.draft, deadline: this.deadline.value });
  }

  #replay() {
    const found = recorded(this.model.get("recording"), this.model.get("form").request.fields, this.request.draft);
    if (!found) {
      this.answer.replaceChildren();
      this.status.className = "ros-status ros-wrong";
      return say(this.status, "This request was not recorded. Pick one of the recorded requests below.");
    }
    this.#show(found.outcome);
    say(this.status, `Recorded: ${this.status.textContent}`);
    say(this.shell, found.check.shell);
    say(this.python, found.check.python);
  }

  #cancel() {
    if (!disabled(this.cancelButton)) send(this.model, { kind: "cancel" });
  }

  /** Shows that the kernel has handled a click. */
  #settle() {
    this.waiting = false;
    clearTimeout(this.slow);
    this.#drawButtons();
  }

  /** @param {any} entry */
  #recall(entry) {
    this.request.fill(entry.draft);
    this.#save();
    this.request.focus();
  }
}

/** @param {HTMLElement} button */
const disabled = (button) => button.hasAttribute("aria-disabled");

/** @param {{name: string, words: string, cause?: string, remedy?: string, taught?: string}} error */
function failure(error) {
  return [h("pre", { class: "ros-words", tabindex: "0", "aria-label": "The error message of ROS" }, h("b", { text: error.name }), `: ${error.words}`),
    ...(error.cause ? [h("p", { class: "ros-cause" }, ...prose(error.cause)), h("p", { class: "ros-remedy" }, ...prose(error.remedy ?? "")),
      error.taught ? h("p", { class: "ros-muted", text: `This topic is taught in ${error.taught}.` }) : ""] : [])];
}

export default { render };

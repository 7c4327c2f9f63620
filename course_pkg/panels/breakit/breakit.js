/* The panel "Break it": a row of cases, the open case with the outputs of its tools, and an answer. The
   model holds all state. */
import { freshId, h, kernelLink, prose, same, say, send, setAttribute } from "../kit.js";
import { block, lookTitle } from "./parts.js";

const STATES = { new: "not answered", wrong: "no right answer yet", shown: "answer shown", solved: "solved" };
const SLOW = 1500; // If the kernel has not handled a click after this many ms, the panel shows the reason.

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const ending = new AbortController();
  const view = new LabView(model);
  el.append(view.el);
  kernelLink(model, ending.signal, (live) => view.kernel(live));
  return () => ending.abort();
}

class LabView {
  /** @param {import("../kit.js").Model} model */
  constructor(model) {
    this.model = model;
    this.live = true;
    this.slow = 0;
    this.drawn = /** @type {Record<string, any>} */ ({});
    this.#build();
    for (const trait of ["cases", "score", "case", "trouble", "notice"]) model.on(`change:${trait}`, () => this.#draw());
    model.on("msg:custom", (/** @type {{kind: string}} */ content) => content.kind === "taken" && this.#taken());
    this.#draw();
  }

  #build() {
    this.banner = h("div", { class: "ros-banner", role: "status", hidden: true });
    this.score = h("p", { class: "ros-score ros-muted" });
    this.buttons = this.model.get("cases").map((/** @type {any} */ each) => this.#caseButton(each.number));
    this.row = h("div", { class: "ros-cases", role: "toolbar", "aria-label": "Cases", onkeydown: (/** @type {KeyboardEvent} */ event) => this.#arrow(event) }, ...this.buttons);
    this.story = h("p", { class: "ros-story" });
    this.status = h("p", { class: "ros-status", role: "status", "aria-live": "polite" });
    this.symptom = h("div", { class: "ros-symptom" });
    this.toolRow = h("div", { class: "ros-tools", role: "group", "aria-label": "Look closer" });
    this.looks = h("ol", { class: "ros-looks" });
    this.diagnoses = question("What is wrong?", () => this.#drawButtons());
    this.remedies = question("What helps?", () => this.#drawButtons());
    this.check = h("button", { type: "button", class: "ros-main", text: "Check", onclick: () => this.#answer() });
    this.reveal = h("button", { type: "button", text: "Show the answer", onclick: () => this.#ask(this.reveal, { kind: "reveal" }) });
    this.undo = h("button", { type: "button", text: "Undo the fault", onclick: () => this.#ask(this.undo, { kind: "undo" }) });
    this.verdict = h("div", { class: "ros-outcome", role: "status", "aria-live": "polite" });
    this.body = h("div", { class: "ros-case", hidden: true }, this.story, this.status, this.symptom,
      h("section", { class: "ros-closer", "aria-label": "Look closer" }, h("h4", { text: "Look closer" }), this.toolRow, this.looks),
      h("section", { class: "ros-answer", "aria-label": "Your answer" }, h("div", { class: "ros-questions" }, this.diagnoses.el, this.remedies.el),
        h("div", { class: "ros-actions" }, this.check, this.reveal, this.undo), this.verdict));
    this.empty = h("p", { class: "ros-empty", text: "Each case causes a real fault on the graph, and shows its symptoms. Find the fault. Click a case to begin. When the next case begins, the panel removes this fault." });
    this.trouble = h("div", { class: "ros-trouble", role: "alert", hidden: true });
    this.el = h("section", { class: "ros-panel ros-breakit", "aria-label": "Break it" }, this.banner,
      h("div", { class: "ros-head" }, h("h3", {}, h("span", { class: "ros-tag", text: "Break it" }), " Find the fault"), this.score), this.row, this.trouble, this.empty, this.body);
  }

  /** @param {number} number */
  #caseButton(number) {
    return h("button", { type: "button", class: "ros-number", tabindex: "-1", text: `Case ${number}`, "data-case": number,
      onclick: (/** @type {Event} */ event) => this.#ask(/** @type {HTMLElement} */ (event.currentTarget), { kind: "open", case: number }) });
  }

  /** The Tab key moves to the row of cases; the arrow keys move from case to case. @param {KeyboardEvent} event */
  #arrow(event) {
    const at = this.buttons.indexOf(/** @type {HTMLElement} */ (document.activeElement));
    const steps = { ArrowRight: at + 1, ArrowDown: at + 1, ArrowLeft: at - 1, ArrowUp: at - 1, Home: 0, End: this.buttons.length - 1 };
    const to = steps[/** @type {keyof typeof steps} */ (event.key)];
    if (at < 0 || to === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    this.#stop((to + this.buttons.length) % this.buttons.length);
    this.buttons[(to + this.buttons.length) % this.buttons.length].focus();
  }

  /** @param {number} at */
  #stop(at) {
    this.buttons.forEach((/** @type {HTMLElement} */ button, /** @type {number} */ index) => button.setAttribute("tabindex", index === at ? "0" : "-1"));
  }

  #draw() {
    const open = this.model.get("case");
    this.#drawBanner();
    this.#drawCases(open.number);
    this.#drawTrouble();
    setAttribute(this.body, "hidden", open.number === undefined);
    setAttribute(this.empty, "hidden", open.number !== undefined);
    if (open.number !== undefined) this.#drawCase(open);
    this.#drawButtons();
  }

  #drawBanner() {
    const notice = this.model.get("notice");
    const seen = this.model.get("case").number === undefined ? "" : " It shows the last state of the last case.";
    const text = notice ? `The panel itself failed: ${notice}` : this.live ? "" : `No kernel answers: this is a saved panel.${seen} Run the notebook to cause a fault.`;
    say(this.banner, text);
    this.banner.classList.toggle("ros-bad", notice !== "");
    setAttribute(this.banner, "hidden", !text);
  }

  /** @param {number | undefined} current */
  #drawCases(current) {
    const listed = this.model.get("cases");
    listed.forEach((/** @type {any} */ each, /** @type {number} */ index) => {
      const button = this.buttons[index];
      const words = STATES[/** @type {keyof typeof STATES} */ (each.state)];
      button.className = `ros-number ros-is-${each.state}`;
      setAttribute(button, "aria-pressed", each.number === current ? "true" : "false");
      setAttribute(button, "aria-label", `Case ${each.number}, ${words}`);
      setAttribute(button, "title", words);
    });
    const at = listed.findIndex((/** @type {any} */ each) => each.number === current);
    if (!this.row.contains(document.activeElement)) this.#stop(Math.max(at, 0));
    const score = this.model.get("score");
    const first = score.solved ? `, ${score.first} at the first try` : "";
    say(this.score, `${score.solved ?? 0} of ${score.of ?? 0} solved${first}`);
  }

  #drawTrouble() {
    const trouble = this.model.get("trouble");
    setAttribute(this.trouble, "hidden", !trouble);
    say(this.trouble, trouble && `The case could not be set up. ${trouble}`);
  }

  /** @param {any} open */
  #drawCase(open) {
    say(this.story, `Case ${open.number}. ${open.story}`);
    say(this.status, this.#words(open));
    this.status.className = `ros-status ros-${this.live ? open.phase : "over"}`;
    this.#drawLooks(open);
    if (!same([open.number, open.tools], this.drawn.tools)) {
      this.drawn.tools = [open.number, open.tools];
      this.toolRow.replaceChildren(...open.tools.map((/** @type {any} */ tool) => h("button", { type: "button", class: "ros-quiet ros-tool",
        onclick: (/** @type {Event} */ event) => this.#ask(/** @type {HTMLElement} */ (event.currentTarget), { kind: "use", tool: tool.name }) }, ...prose(tool.label))));
      this.diagnoses.offer(open.diagnoses);
      this.remedies.offer(open.remedies);
    }
    this.#drawVerdict(open.verdict);
  }

  /** @param {any} open */
  #words(open) {
    const words = { causing: "The panel causes the fault and collects the symptom…", looking: "The tool runs…", ready: "The fault is active. Use the tools, and answer.",
      over: "The fault was removed. Click the case to cause the fault again." };
    if (!this.live) return "This is the last saved state of the case.";
    if (this.model.get("trouble")) return "The fault is not active yet. Solve the problem above, and click the case again.";
    if (open.phase === "ready" && settled(open)) return "The fault is still active. You know the answer now: use the tools again, or undo the fault.";
    return words[/** @type {keyof typeof words} */ (open.phase)] ?? "";
  }

  /** @param {any} open */
  #drawLooks(open) {
    if (same(open.looks, this.drawn.looks)) return;
    const before = this.drawn.looks ?? [];
    this.drawn.looks = open.looks;
    const [first, ...rest] = open.looks;
    this.symptom.replaceChildren(...(first ? [h("h4", { text: "What you see" }), ...block(first)] : []));
    const newest = rest.length && !before.some((/** @type {any} */ each) => each.number === rest[rest.length - 1].number);
    this.looks.replaceChildren(...[...rest].reverse().map((/** @type {any} */ look, /** @type {number} */ index) => h("li", {},
      h("details", { open: index === 0 }, h("summary", {}, ...prose(lookTitle(look, open.tools))), ...block(look)))));
    if (newest) this.looks.firstElementChild?.scrollIntoView?.({ block: "nearest" });
  }

  /** @param {any} verdict */
  #drawVerdict(verdict) {
    if (same(verdict, this.drawn.verdict)) return;
    this.drawn.verdict = verdict;
    this.verdict.className = `ros-outcome ros-${verdict.state ?? "none"}`;
    const told = verdict.diagnosis ? [h("p", {}, h("b", { text: "What is wrong: " }), ...prose(verdict.diagnosis)), h("p", {}, h("b", { text: "Why: " }), ...prose(verdict.reason)),
      h("p", {}, h("b", { text: "What helps: " }), ...prose(verdict.remedy)), h("p", { class: "ros-muted", text: `This topic is taught in ${verdict.taught}.` })]
      : verdict.reason ? [h("p", {}, ...prose(verdict.reason))] : [];
    const server = verdict.server ? [h("details", {}, h("summary", { text: "The server of this case" }), h("pre", { class: "ros-shown ros-whole", tabindex: "0", "aria-label": "The server's program", text: verdict.server }))] : [];
    this.verdict.replaceChildren(...(verdict.words ? [h("p", { class: "ros-mark" }, h("b", { text: verdict.words })), ...told, ...server] : []));
    if (verdict.diagnosis) {
      this.diagnoses.pick(verdict.diagnosis);
      this.remedies.pick(verdict.remedy);
    }
  }

  #drawButtons() {
    const open = this.model.get("case");
    const busy = ["causing", "looking"].includes(open.phase);
    const over = settled(open);
    const off = (/** @type {Element} */ button, /** @type {boolean} */ is) => setAttribute(button, "aria-disabled", is || !this.live ? "true" : null);
    for (const button of this.buttons) off(button, busy);
    for (const button of this.toolRow.children) off(button, open.phase !== "ready");
    off(this.check, over || !open.looks?.length || !this.diagnoses.picked() || !this.remedies.picked());
    off(this.reveal, over || !open.looks?.length);
    off(this.undo, busy || open.phase === "over");
    for (const each of [this.diagnoses, this.remedies]) each.use(this.live && !over && Boolean(open.looks?.length));
  }

  #answer() {
    this.#ask(this.check, { kind: "answer", diagnosis: this.diagnoses.picked(), remedy: this.remedies.picked() });
  }

  /** Sends the message of a button, unless the button is disabled. @param {HTMLElement} button @param {object} content
   */
  #ask(button, content) {
    if (button.hasAttribute("aria-disabled") || !send(this.model, content)) return;
    clearTimeout(this.slow);
    this.slow = setTimeout(() => say(this.status, "Waiting for the kernel: it is busy with another cell."), SLOW);
  }

  /** Shows that the kernel has handled a click. */
  #taken() {
    clearTimeout(this.slow);
    this.#draw();
  }

  /** @param {boolean} live */
  kernel(live) {
    this.live = live;
    this.#draw();
  }
}

/** Returns whether the student knows the solution. @param {any} open @returns {boolean} */
function settled(open) {
  return ["right", "shown"].includes(open.verdict?.state);
}

/** Returns a group of radio buttons. @param {string} title @param {() => void} changed */
function question(title, changed) {
  const name = freshId("ros-question");
  const list = h("div", { class: "ros-options" });
  const el = h("fieldset", {}, h("legend", { text: title }), list);
  /** @type {HTMLInputElement[]} */
  let inputs = [];
  return {
    el,
    picked: () => inputs.find((input) => input.checked)?.value ?? "",
    offer: (/** @type {string[]} */ texts) => {
      inputs = texts.map((value) => /** @type {HTMLInputElement} */ (h("input", { type: "radio", name, value, onchange: changed })));
      list.replaceChildren(...inputs.map((input) => h("label", {}, input, h("span", {}, ...prose(input.value)))));
    },
    pick: (/** @type {string} */ text) => inputs.forEach((input) => { input.checked = input.value === text; }),
    use: (/** @type {boolean} */ can) => inputs.forEach((input) => { input.disabled = !can; }),
  };
}

export default { render };

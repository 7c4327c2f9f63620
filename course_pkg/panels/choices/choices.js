/* Choices: a row for each case, and one button. After a press of this button, each row shows whether the
   choice is right, and the reason. */
import { freshId, h, kernelLink, prose, same, say, send, setAttribute } from "../kit.js";

/** @typedef {{chosen: string, fits: boolean, answer: string, reason: string}} Verdict */

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const ending = new AbortController();
  const view = new ChoicesView(model);
  el.append(view.el);
  kernelLink(model, ending.signal, (live) => view.kernel(live));
  return () => ending.abort();
}

class ChoicesView {
  /** @param {import("../kit.js").Model} model */
  constructor(model) {
    this.model = model;
    this.live = true;
    this.asked = false; // true if the button was pressed before the student decided all cases
    /** @type {Map<number, string>} */
    this.sent = new Map(); // for each case, the option that the kernel has not confirmed yet
    this.rows = model.get("cases").map((/** @type {string} */ text, /** @type {number} */ number) => this.#row(text, number));
    this.status = h("p", { class: "ros-standing", role: "status", "aria-live": "polite", tabindex: "-1" });
    this.button = h("button", { type: "button", class: "ros-main", onclick: () => this.#press() });
    this.el = h("section", { class: "ros-panel ros-choices-panel", "aria-label": "Choices" },
      h("h3", {}, h("span", { class: "ros-tag", text: "Choose" }), " ", ...prose(model.get("question"))),
      h("ol", {}, ...this.rows.map((/** @type {any} */ row) => row.el)), h("div", { class: "ros-actions" }, this.button, this.status));
    model.on("change:chosen", () => this.#confirm());
    for (const trait of ["chosen", "verdicts", "first", "notice"]) model.on(`change:${trait}`, () => this.#draw());
    this.#draw();
  }

  /** @param {string} text @param {number} number */
  #row(text, number) {
    const id = freshId("ros-case");
    const pick = (/** @type {string} */ option) => {
      this.sent.set(number, option);
      send(this.model, { kind: "choose", case: number, option });
      this.#draw();
    };
    const inputs = this.model.get("options").map((/** @type {string} */ option) =>
      /** @type {HTMLInputElement} */ (h("input", { type: "radio", name: id, value: option, onchange: () => pick(option) })));
    const verdict = h("p", { class: "ros-verdict", id: `${id}-verdict` });
    const el = h("li", {}, h("p", { class: "ros-case", id }, ...prose(text)),
      h("div", { class: "ros-options", role: "radiogroup", "aria-labelledby": id, "aria-describedby": `${id}-verdict` },
        ...inputs.map((/** @type {HTMLInputElement} */ input) => h("label", {}, input, h("span", {}, ...prose(input.value))))), verdict);
    return { el, inputs, verdict };
  }

  /** @returns {string[]} the option of each case, including those that the kernel has not confirmed yet */
  #chosen() {
    return this.model.get("chosen").map((/** @type {string} */ option, /** @type {number} */ number) => this.sent.get(number) ?? option);
  }

  #confirm() {
    const chosen = this.model.get("chosen");
    for (const [number, option] of this.sent) if (chosen[number] === option) this.sent.delete(number);
  }

  #draw() {
    const chosen = this.#chosen();
    /** @type {Verdict[]} */
    const verdicts = this.model.get("verdicts");
    this.rows.forEach((/** @type {any} */ row, /** @type {number} */ number) => this.#drawRow(row, chosen[number], verdicts[number]));
    setAttribute(this.button, "aria-disabled", this.live ? null : "true");
    say(this.button, verdicts.length ? "Choose again" : "Show the reasons");
    this.button.classList.toggle("ros-main", !verdicts.length);
    say(this.status, this.#words(chosen, verdicts));
  }

  /** @param {any} row @param {string} chosen @param {Verdict | undefined} verdict */
  #drawRow(row, chosen, verdict) {
    for (const input of row.inputs) {
      input.checked = input.value === chosen;
      input.disabled = !this.live || Boolean(verdict);
    }
    row.el.className = verdict ? (verdict.fits ? "ros-right" : "ros-wrong") : this.asked && !chosen ? "ros-open" : "";
    const said = verdict ? [verdict.fits ? "Fits." : `Does not fit. Better: ${verdict.answer}.`, verdict.reason] : [this.asked && !chosen ? "No answer yet." : "", ""];
    if (same(said, row.said)) return;
    row.said = said;
    row.verdict.replaceChildren(...(said[0] ? [h("b", {}, ...prose(said[0])), " ", ...prose(said[1])] : []));
  }

  /** @param {string[]} chosen @param {Verdict[]} verdicts */
  #words(chosen, verdicts) {
    const notice = this.model.get("notice");
    const first = this.model.get("first");
    const open = chosen.filter((each) => !each).length;
    const counts = first.of ? ` ${first.fit} of ${first.of} of your first choices fit, and only the first choices count.` : "";
    if (notice) return `The panel itself failed: ${notice}`;
    if (!this.live) return "No kernel answers: run the notebook to choose.";
    if (verdicts.length) {
      const fit = verdicts.filter((verdict) => verdict.fits).length;
      return `${fit} of ${verdicts.length} fit.${first.now ? "" : counts}`;
    }
    if (!open) return `Each case has an answer. You can change an answer until you see the reasons.${counts}`;
    return `${this.asked ? "First choose an option for each case: " : ""}${open} of ${chosen.length} cases ${open === 1 ? "has" : "have"} no answer.${counts}`;
  }

  #press() {
    if (!this.live) return;
    const shown = this.model.get("verdicts").length > 0;
    const open = this.#chosen().indexOf("");
    this.asked = !shown && open >= 0;
    if (this.asked) {
      this.#draw();
      this.rows[open].inputs[0].focus();
      return;
    }
    if (shown) this.sent.clear();
    send(this.model, { kind: shown ? "again" : "compare" });
  }

  /** @param {boolean} live */
  kernel(live) {
    this.live = live;
    if (!live) this.sent.clear();
    this.#draw();
  }
}

export default { render };

/* Predictions: the question, the comparison, and the table of a chapter. */
import { freshId, h, kernelLink, say, send, setAttribute } from "../kit.js";

/** @typedef {{question: string, predicted: string, actual: string, state: string, verdict: string, result?: string, fit?: number, cases?: number}} Shown */

/** @typedef {{text: string, parts: {check: string, state: string, mark: string}[], next: string, problems: string[]}} Row */

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const ending = new AbortController();
  const part = model.get("part");
  if (part === "question") question(model, el, ending.signal);
  else if (part === "comparison") el.append(comparison(model.get("record")));
  else el.append(table(model.get("records"), model.get("row") ?? {}));
  return () => ending.abort();
}

/** @param {import("../kit.js").Model} model @param {HTMLElement} el @param {AbortSignal} signal */
function question(model, el, signal) {
  const choices = model.get("choices");
  const keep = (/** @type {string} */ answer) => send(model, { kind: "answer", answer });
  const status = h("p", { class: "ros-muted ros-kept", role: "status", "aria-live": "polite" });
  const answer = choices.length ? radios(choices, keep) : line(keep);
  el.append(h("section", { class: "ros-panel ros-predict", "aria-label": "Prediction" },
    h("fieldset", {}, h("legend", {}, h("span", { class: "ros-tag", text: "Predict" }), " ", model.get("question")), answer.el), status));
  let live = true;
  const draw = () => {
    answer.write(model.get("answer"), live);
    const said = model.get("answer") ? "Your answer is stored. You can change it until the result is known." : "Answer before you run the next cell.";
    const after = model.get("answer") ? "Your answer is stored. The result is known now, so a change is marked as a late change." : "The result is known. If you answer now, your answer is marked as late.";
    say(status, !live ? "No kernel answers: run the notebook to store a prediction." : model.get("notice") || (model.get("compared") ? after : said));
  };
  for (const trait of ["answer", "compared", "notice"]) model.on(`change:${trait}`, draw);
  draw();
  kernelLink(model, signal, (now) => { live = now; draw(); });
}

/** @param {string[]} choices @param {(answer: string) => void} keep */
function radios(choices, keep) {
  const name = freshId("ros-predict");
  const inputs = choices.map((choice) => /** @type {HTMLInputElement} */ (h("input", { type: "radio", name, value: choice, onchange: () => keep(choice) })));
  const el = h("div", { class: "ros-choices" }, ...inputs.map((input) => h("label", {}, input, h("span", { text: input.value }))));
  const write = (/** @type {string} */ answer, /** @type {boolean} */ live) => inputs.forEach((input) => {
    input.checked = input.value === answer;
    input.disabled = !live;
  });
  return { el, write };
}

/** @param {(answer: string) => void} keep */
function line(keep) {
  const id = freshId("ros-predict");
  const input = /** @type {HTMLInputElement} */ (h("input", { id, type: "text", class: "ros-text", autocomplete: "off" }));
  const el = h("form", { class: "ros-free", onsubmit: (/** @type {Event} */ event) => { event.preventDefault(); keep(input.value); } },
    h("label", { for: id, text: "Your answer" }), input, h("button", { type: "submit", text: "Keep" }));
  const write = (/** @type {string} */ answer, /** @type {boolean} */ live) => {
    if (document.activeElement !== input || answer) input.value = answer;
    setAttribute(input, "disabled", !live);
  };
  return { el, write };
}

/** @param {Shown} shown */
function comparison(shown) {
  return h("section", { class: `ros-panel ros-predict ros-${shown.state}`, "aria-label": "Prediction compared" },
    h("div", { class: "ros-sides" }, side("You predicted", shown.predicted || "nothing"), side("What really happened", shown.actual)),
    h("p", { class: "ros-verdict", text: shown.verdict }));
}

/** @param {string} label @param {string} text */
function side(label, text) {
  return h("p", {}, h("span", { class: "ros-muted", text: `${label} ` }), h("b", { text }));
}

/** @param {Shown[]} records @param {Partial<Row>} row */
function table(records, row) {
  const words = { open: "not compared yet", late: "no prediction", right: "as predicted", wrong: "otherwise" };
  const rows = records.map((shown) => h("tr", { class: `ros-${shown.state}` }, h("td", { text: shown.question }), h("td", { text: shown.predicted || "nothing" }),
    h("td", { text: shown.actual || "not known yet" }), h("td", { class: "ros-result", text: shown.result || words[/** @type {keyof words} */ (shown.state)], title: shown.verdict })));
  const head = h("thead", {}, h("tr", {}, ...["Question", "You predicted", "What really happened", "Result"].map((text) => h("th", { scope: "col", text }))));
  const right = records.filter((shown) => shown.state === "right").length;
  const seen = records.filter((shown) => ["right", "wrong"].includes(shown.state)).length;
  const predicted = seen ? `${right} of ${seen} ${seen === 1 ? "prediction was" : "predictions were"} right. ` : "";
  const [fit, cases] = ["fit", "cases"].map((part) => records.reduce((sum, shown) => sum + (/** @type {any} */ (shown)[part] ?? 0), 0));
  const chosen = cases ? `${fit} of ${cases} choices fit. ` : "";
  const score = predicted + chosen || "No prediction has been compared yet. ";
  const text = records.length ? `${score}A wrong prediction helps you if you now understand why it was wrong.` : "Nothing has been predicted yet.";
  return h("section", { class: "ros-panel ros-predict", "aria-label": "Predictions" },
    h("div", { class: "ros-scroll", tabindex: "0", role: "region", "aria-label": "Table of predictions" }, records.length ? h("table", {}, head, h("tbody", {}, ...rows)) : ""), h("p", { class: "ros-kept", text }),
    row.text ? progress(/** @type {Row} */ (row)) : "");
}

/** Returns the student's progress in the chapter. @param {Row} row */
function progress({ text, parts, next, problems }) {
  const kinds = { "✓": "ros-right", "✗": "ros-wrong" };
  const marks = parts.map(({ check, state, mark }) => h("li", { class: kinds[/** @type {keyof typeof kinds} */ (mark)] ?? "", title: `${check} ${state}` },
    h("span", { "aria-hidden": "true", text: `${mark} ` }), check, h("span", { class: "ros-hidden", text: ` ${state}` })));
  return h("section", { class: "ros-progress", "aria-label": "Progress in this chapter" }, h("p", {}, h("b", { text })),
    h("ul", { class: "ros-marks" }, ...marks), h("p", { text: next }), ...problems.map((problem) => h("p", { class: "ros-problem", text: problem })));
}

export default { render };

/* Elements that panels show next to a form: a message as a table, and a command to copy. */
import { copyButton, h } from "../kit.js";

/** @param {string} label @param {HTMLElement} pre @param {string} what */
export function command(label, pre, what) {
  return h("div", { class: "ros-command" }, h("span", { class: "ros-muted", text: label }), pre,
    copyButton(what, () => pre.textContent ?? ""));
}

/** @typedef {{depth: number, name: string, type: string, text: string}} Row */

/** Returns a message as a table, or the given text if the message has no fields.
 * @param {Row[]} rows @param {string} empty */
export function valueTable(rows, empty) {
  if (!rows.length) return h("p", { class: "ros-muted", text: empty });
  return h("table", { class: "ros-values" }, h("tbody", {}, ...rows.map((row) => h("tr", {},
    h("th", { scope: "row", style: `padding-left: ${16 * row.depth}px` }, row.name),
    h("td", { class: "ros-value", text: row.text }), h("td", { class: "ros-muted", text: row.type })))));
}

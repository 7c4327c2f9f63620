/* Parts of the topic panel: a setting, counts, deliveries, and numbers as texts. */
import { freshId, h } from "../kit.js";

/** @param {string} label @param {string} unit @param {string} mode @param {() => void} edited */
export function setting(label, unit, mode, edited) {
  const id = freshId("ros-setting");
  const input = /** @type {HTMLInputElement} */ (h("input", { id, type: "text", class: "ros-text", inputmode: mode, autocomplete: "off", oninput: edited }));
  return { input, el: h("span", { class: "ros-setting" }, h("label", { for: id, text: label }), input, h("span", { class: "ros-muted", text: unit })) };
}

/** @param {{node: string, type: string}[]} nodes @param {string} own @param {string} nobody */
export function names(nodes, own, nobody) {
  const shown = nodes.map(({ node, type }) => (node === own ? `this panel (the node ${own})` : type ? node : `${node} (does not answer)`));
  return shown.length ? shown.join(", ") : nobody;
}

/** @param {any} publisher */
export function figures({ published, unheard, sent, dropped }) {
  const facts = { Published: published, "No subscriber": unheard, Sent: sent, Dropped: dropped };
  return h("div", { class: "ros-facts" }, ...Object.entries(facts).map(([label, count]) => h("p", {}, h("span", { class: "ros-muted", text: label }), h("b", { text: count.toLocaleString("en") }))));
}

/** @param {any} publisher */
export function deliveries({ deliveries: rows, own, queue }) {
  if (!rows.length) return "";
  const head = ["Subscriber", "sent", "waiting", "dropped"].map((text) => h("th", { scope: "col", text }));
  return h("div", { class: "ros-scroll" }, h("table", { class: "ros-deliveries" }, h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...rows.map((/** @type {any} */ each) => h("tr", {},
    h("th", { scope: "row", text: each.peer === own ? "this panel" : each.peer }), ...["sent", "waiting", "dropped"].map((part) => h("td", { text: each[part].toLocaleString("en") })))))),
  h("p", { class: "ros-muted", text: `A message is sent when it has been written to the connection. ${queue ? `If more than ${queue} messages wait, the oldest message is dropped.` : "The queue has no limit."}` }));
}

/** @param {number} value */
export function number(value) {
  return value >= 100 ? value.toFixed(0) : value >= 1 ? value.toFixed(1) : value.toFixed(2);
}

/** @param {number} age */
export function seconds(age) {
  return age < 10 ? `${age.toFixed(1)} s` : age < 120 ? `${age.toFixed(0)} s` : `${(age / 60).toFixed(0)} min`;
}

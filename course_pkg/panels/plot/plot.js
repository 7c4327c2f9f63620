/* The plot: a chart with its title, what was left out, and the same as a table. It needs no kernel. */
import { h } from "../kit.js";
import { Bars } from "./bars.js";
import { Chart } from "./chart.js";

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const data = model.get("data");
  const chart = data.kind === "bars" ? new Bars(data) : new Chart();
  el.append(h("section", { class: "ros-panel ros-plot", "aria-label": data.title ? `Plot: ${data.title}` : "Plot" },
    data.title ? h("h3", { text: data.title }) : null, chart.el,
    ...data.notes.map((/** @type {string} */ note) => h("p", { class: "ros-muted", text: note })),
    data.tables.length ? h("details", {}, h("summary", { text: "The same as a table" }), ...data.tables.map(tabulated)) : null));
  chart.show(data);
  return () => chart.end();
}

/** @param {{head: string[], rows: string[][], note?: string}} given */
function tabulated({ head, rows, note }) {
  const [first, ...others] = head;
  const row = ([name, ...values]) => h("tr", {}, h("th", { scope: "row", text: name }), ...values.map((text) => h("td", { class: "ros-value", text })));
  const corner = h(first ? "th" : "td", first ? { scope: "col", text: first } : {}); // an empty one heads nothing
  return h("div", { class: "ros-scroll", tabindex: "0", role: "region", "aria-label": "Values" },
    h("table", {}, h("thead", {}, h("tr", {}, corner, ...others.map((text) => h("th", { scope: "col", text })))), h("tbody", {}, ...rows.map(row))),
    note ? h("p", { class: "ros-muted", text: note }) : null);
}

export default { render };

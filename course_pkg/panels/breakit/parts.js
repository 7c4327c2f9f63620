/* One output of a case: a program or command, and the text that it printed. */
import { h } from "../kit.js";

/** @typedef {{number: number, tool: string, shown: string, said: string, verdict: string, waiting: boolean}} Look */

/** @param {Look} look @returns {HTMLElement[]} */
export function block(look) {
  const printed = look.said || (look.waiting ? "(nothing printed yet)" : "(nothing printed)");
  return [
    h("pre", { class: "ros-shown", tabindex: "0", "aria-label": "What was run", text: look.shown }),
    h("pre", { class: "ros-said", tabindex: "0", "aria-label": "What it printed", text: printed }),
    h("p", { class: look.waiting ? "ros-end ros-waiting" : "ros-end", text: sentence(look.verdict) }),
  ].filter((part) => part.textContent !== "");
}

/** @param {Look} look @param {{name: string, label: string}[]} tools */
export function lookTitle(look, tools) {
  return tools.find((tool) => tool.name === look.tool)?.label ?? look.tool;
}

/** @param {string} words */
function sentence(words) {
  return words ? `${words[0].toUpperCase()}${words.slice(1)}.` : "";
}

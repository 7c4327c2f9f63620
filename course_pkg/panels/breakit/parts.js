/* What is seen of a case: a program or a command, and what it printed. */
import { h, prose } from "../kit.js";

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

/** What failed, in its own words, and what that means. @param {{words: string, cause: string, remedy: string}} trouble */
export function failure(trouble) {
  return [h("p", {}, h("b", { text: "The case could not be set up. " }), trouble.words), h("p", {}, h("b", { text: "Cause: " }), ...prose(trouble.cause)),
    h("p", {}, h("b", { text: "What to do: " }), ...prose(trouble.remedy))];
}

/** @param {string} words */
function sentence(words) {
  return words ? `${words[0].toUpperCase()}${words.slice(1)}.` : "";
}

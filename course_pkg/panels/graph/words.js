/* What the details of a shape say. */
import { h } from "../kit.js";

/** @typedef {{key: string, kind: string, name: string, lost: boolean, facts: [string, string][]}} Fact */
/** @typedef {{node: string, calls: number, last: number, running: number, gone: boolean}} Caller */
/** @typedef {{notes?: Record<string, string>, details?: Record<string, [string, string][]>,
 *   callers?: Record<string, Caller[]>, calls?: {tail: string, head: string, last: number, running: number}[]}} Activity */

/** Each fact of a shape, and what happens there. @param {Fact} fact @param {Activity} activity @param {boolean} live
 * @returns {HTMLElement[]} */
export function pairs(fact, activity, live) {
  const shown = [...(fact.lost ? [["state", "does not answer"]] : []), ...fact.facts, ...(activity.details?.[fact.key] ?? [])];
  const said = shown.map(([label, value]) => pair(label, value));
  if (fact.kind === "service" && activity.callers) said.push(...callers(activity.callers[fact.key], live));
  return said;
}

/** @param {string} label @param {string} value */
function pair(label, value) {
  return h("span", { class: "ros-pair" }, h("span", { class: "ros-muted", text: `${label} ` }), h("code", { text: value }));
}

/** Who called a service lately. @param {Caller[] | undefined} told @param {boolean} live */
function callers(told, live) {
  if (!told) return [pair("called by", "its server does not tell who calls")];
  if (!told.length) return [pair("called by", "nobody yet")];
  return told.map((each) => pair("called by", `${each.node}${each.gone ? ", which is gone," : ""} ${calls(each, live)}`));
}

/** @param {Caller} caller @param {boolean} live */
function calls(caller, live) {
  const count = `${caller.calls} ${caller.calls === 1 ? "call" : "calls"}`;
  return caller.running && !caller.gone ? `${count}, waits for an answer` : `${when(caller.last, live)}, ${count}`;
}

/** How long ago, in words that change seldom; a page without a kernel says the time of day.
 * @param {number} last in s since the epoch @param {boolean} live */
function when(last, live) {
  if (!live) return `at ${new Date(1000 * last).toTimeString().slice(0, 8)}`;
  const seconds = Math.max(0, Date.now() / 1000 - last);
  if (seconds < 2) return "just now";
  if (seconds < 10) return `${Math.floor(seconds)} s ago`;
  if (seconds < 60) return `${10 * Math.floor(seconds / 10)} s ago`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ago`;
  return `${Math.floor(seconds / 3600)} h ago`;
}

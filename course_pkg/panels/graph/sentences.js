/* The texts in the details of a shape. */
import { h } from "../kit.js";

/** @typedef {{key: string, kind: string, name: string, lost: boolean, facts: [string, string][]}} Fact */
/** @typedef {{node: string, calls: number, last: number, running: number, gone: boolean}} Caller */
/** @typedef {{notes?: Record<string, string>, details?: Record<string, [string, string][]>,
 *   callers?: Record<string, Caller[]>, calls?: {tail: string, head: string, last: number, running: number}[]}} Activity */

/** Returns the details of a shape: its facts and its activity.
 * @param {Fact} fact @param {Activity} activity
 * @param {number | null} now in s since the epoch, for texts such as "5 s ago"; null for the time of day
 * @returns {HTMLElement[]} */
export function pairs(fact, activity, now) {
  const lost = fact.lost && fact.kind !== "namespace" ? [["state", "does not answer"]] : [];
  const told = [...lost, ...fact.facts.filter(([label]) => label !== "address"), ...(activity.details?.[fact.key] ?? [])];
  const address = fact.facts.filter(([label]) => label === "address");
  const said = [...told.map(([label, value]) => pair(label, value)), ...asked(fact, activity, now)];
  return [...said, ...address.map(([label, value]) => pair(label, value))];
}

/** @param {string} label @param {string} value @param {string} [more] */
function pair(label, value, more = "") {
  return h("span", { class: "ros-pair" }, h("span", { class: "ros-muted", text: `${label} ` }), h("code", { text: value }), more);
}

/** Returns the recent callers of a service, or the services that a node called.
 * @param {Fact} fact @param {Activity} activity @param {number | null} now */
function asked(fact, activity, now) {
  if (fact.kind === "service" && activity.callers) return callers(activity.callers[fact.key], now);
  if (fact.kind !== "node") return [];
  return Object.entries(activity.callers ?? {}).flatMap(([service, told]) => told.filter((each) => each.node === fact.name)
    .map((each) => pair("called", service.slice("service ".length), ` ${calls(each, now)}`)));
}

/** @param {Caller[] | undefined} told @param {number | null} now */
function callers(told, now) {
  if (!told) return [pair("called by", "", "unknown: the server does not report its callers")];
  if (!told.length) return [pair("called by", "", "no node yet")];
  return told.map((each) => pair("called by", each.node, `${each.gone ? " (gone)" : ""} ${calls(each, now)}`));
}

/** @param {Caller} caller @param {number | null} now */
function calls(caller, now) {
  const count = `${caller.calls} ${caller.calls === 1 ? "call" : "calls"}`;
  return caller.running && !caller.gone ? `${count}, waits for the response` : `${when(caller.last, now)}, ${count}`;
}

/** Returns a text that says how long ago a call was. The text has coarse steps, so it changes rarely. A saved
 * picture shows the time of day instead.
 * @param {number} last in s since the epoch @param {number | null} now */
function when(last, now) {
  if (now === null) return `at ${new Date(1000 * last).toTimeString().slice(0, 8)}`;
  const seconds = Math.max(0, now - last);
  if (seconds < 2) return "just now";
  if (seconds < 10) return `${Math.floor(seconds)} s ago`;
  if (seconds < 60) return `${10 * Math.floor(seconds / 10)} s ago`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ago`;
  return `${Math.floor(seconds / 3600)} h ago`;
}

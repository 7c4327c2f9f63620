/* What a timeline shows, in words. */
import { numeral } from "../kit.js";

/** @typedef {import("./scene.js").Scene} Scene */

const SENTENCES = 8; // sentences about who waited, before the rest is only counted

/** A span of time (µs). @param {number} span */
export function duration(span) {
  return span >= 2e6 ? `${numeral(span / 1e6, 3)} s` : `${numeral(span / 1e3, 3)} ms`;
}

/** A point of time (µs) as ms. @param {number} time */
export function moment(time) {
  return (time / 1e3).toFixed(3);
}

/** One event as sentences. @param {Scene} scene @param {number} each @returns {string} */
export function sentence(scene, each) {
  const kind = scene.kindOf(each);
  const [node, name, peer, note] = [scene.nodeOf(each), ...["name", "peer", "note"].map((column) => scene.word(each, /** @type {any} */ (column)))];
  const took = duration(scene.end[each] - scene.start[each]);
  const open = scene.open[each];
  const says = {
    lookup: () => `\`${node}\` asked the master for the address of \`${name}\`, and ${open ? "was still waiting at the end" : `waited ${took}`}.`,
    connect: () => `\`${node}\` connected to ${peer ? `\`${peer}\`` : "the server"} for \`${name}\`: ${open ? "no answer up to the end" : took}.`,
    request: () => `\`${node}\` sent its request for \`${name}\` to \`${peer}\`.`,
    wait: () => (open ? `\`${node}\` was still waiting for \`${peer}\` to answer on \`${name}\` when the recording ended, for ${took} by then.`
      : `\`${node}\` waited ${took} for \`${peer}\` to answer on \`${name}\`. Its thread could do nothing else.`),
    response: () => `\`${node}\` had the response of \`${peer}\` on \`${name}\`.`,
    error: () => `The call of \`${node}\` on \`${name}\` failed: ${note}`,
    handler: () => `\`${node}\` ${open ? "was still working" : `worked ${took}`} on \`${name}\` for \`${peer}\`${open ? " when the recording ended" : ""}.${note ? ` It ended so: ${note}` : ""}`,
    publish: () => `\`${node}\` published on \`${name}\` and waited for nobody${note ? `: ${note}` : ""}. ${heard(scene, each)}`,
    callback: () => `\`${node}\` ${open ? "was still in a callback" : `spent ${took} in a callback`} for a message on \`${name}\`${peer ? ` from \`${peer}\`` : ""}${open ? " when the recording ended" : ""}.${scene.reached.has(each) ? "" : " Which message it was is not on record."}`,
  };
  return says[/** @type {keyof says} */ (kind)]();
}

/** The parts of the exchange that an event belongs to, with how long each took. @param {Scene} scene @param {number} each @returns {[string, string][]} */
export function parts(scene, each) {
  return (scene.exchanges.get(scene.key[each]) ?? []).filter((part) => !["request", "response", "error"].includes(scene.kindOf(part)))
    .map((part) => [`${scene.kindOf(part)} (${scene.nodeOf(part)})`, scene.open[part] ? "not over" : duration(scene.end[part] - scene.start[part])]);
}

/** @param {Scene} scene @param {number} each */
function heard(scene, each) {
  const callbacks = (scene.exchanges.get(scene.key[each]) ?? []).length - 1;
  return callbacks ? `${counted(callbacks, "callback")} got it.` : "No callback that got it is on record.";
}

/** Who waited for whom, and who for nobody, one sentence each. @param {Scene} scene @returns {{waits: boolean, text: string}[]} */
export function waiting(scene) {
  const { calls, streams } = scene.recorded.waits;
  const said = [...calls.map((wait) => ({ waits: true, text: waited(wait) })), ...streams.map((stream) => ({ waits: false, text: published(stream) }))];
  const rest = said.length - SENTENCES;
  return rest > 1 ? [...said.slice(0, SENTENCES), { waits: false, text: `And ${rest} more, which the table lists.` }] : said;
}

/** @param {any} wait */
function waited({ node, service, servers, calls, blocked, longest, open, failed }) {
  const whom = servers.length ? `waited for ${servers.map((/** @type {string} */ each) => `\`${each}\``).join(" and ")} on` : open ? "waited for a server that does not speak, on" : "reached nobody on";
  const long = calls > 1 ? `${duration(blocked * 1e6)} in ${calls} calls, the longest ${duration(longest * 1e6)}` : duration(blocked * 1e6);
  const ends = [open ? (calls > 1 ? `${open} not over` : "and it is not over") : "", failed ? (calls > 1 ? `${failed} failed` : "in vain") : ""].filter(Boolean);
  return `\`${node}\` ${whom} \`${service}\`: ${[long, ...ends].join(", ")}.`;
}

/** @param {any} stream */
function published({ node, topic, published: messages, alone, heard_by }) {
  const who = heard_by.length ? `heard by ${heard_by.map((/** @type {string} */ each) => `\`${each}\``).join(" and ")}` : "heard by nobody on record";
  const lost = !alone ? "" : alone === messages ? ", when nobody was connected" : `, ${alone} of them when nobody was connected`;
  return `\`${node}\` published ${counted(messages, "message")} on \`${topic}\`${alone === messages ? "" : `, ${who}`}${lost}, and waited for nobody.`;
}

/** "1 node", "2 nodes". @param {number} number @param {string} noun */
export function counted(number, noun) {
  return `${number} ${noun}${number === 1 ? "" : "s"}`;
}

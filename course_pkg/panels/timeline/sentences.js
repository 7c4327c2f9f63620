/* The texts of a timeline. */
import { numeral } from "../kit.js";

/** @typedef {import("./scene.js").Scene} Scene */

const SENTENCES = 8; // At most this many sentences about waiting are shown; the text gives the number of all others.

/** Returns a span of time (µs) as text. @param {number} span */
export function duration(span) {
  return span >= 2e6 ? `${numeral(span / 1e6, 3)} s` : `${numeral(span / 1e3, 3)} ms`;
}

/** Returns a point of time (µs) in ms as text. @param {number} time */
export function moment(time) {
  return (time / 1e3).toFixed(3);
}

/** Returns sentences about one event. @param {Scene} scene @param {number} each @returns {string} */
export function sentence(scene, each) {
  const kind = scene.kindOf(each);
  const [node, name, peer, note] = [scene.nodeOf(each), ...["name", "peer", "note"].map((column) => scene.word(each, /** @type {any} */ (column)))];
  const took = duration(scene.end[each] - scene.start[each]);
  const open = scene.open[each];
  const says = {
    lookup: () => `\`${node}\` asked the master for the address of \`${name}\`, and ${open ? "was still waiting at the end" : `waited ${took}`}.`,
    connect: () => `\`${node}\` connected to ${peer ? `\`${peer}\`` : "the server"} for \`${name}\`: ${open ? "no answer before the end" : took}.`,
    request: () => `\`${node}\` sent its request for \`${name}\` to \`${peer}\`.`,
    wait: () => (open ? `\`${node}\` waited ${took} for \`${peer}\` to answer on \`${name}\`, and was still waiting when the recording ended.`
      : `\`${node}\` waited ${took} for \`${peer}\` to answer on \`${name}\`. Its thread could do nothing else.`),
    response: () => `\`${node}\` received the response of \`${peer}\` on \`${name}\`.`,
    error: () => `The call of \`${node}\` on \`${name}\` failed: ${note}`,
    handler: () => `\`${node}\` ${open ? "was still working" : `worked ${took}`} on \`${name}\` for \`${peer}\`${open ? " when the recording ended" : ""}.${note ? ` Its end: ${note}` : ""}`,
    publish: () => `\`${node}\` published on \`${name}\` and did not wait${note ? `: ${note}` : ""}. ${heard(scene, each)}`,
    callback: () => `\`${node}\` ${open ? "was still in a callback" : `spent ${took} in a callback`} for a message on \`${name}\`${peer ? ` from \`${peer}\`` : ""}${open ? " when the recording ended" : ""}.${scene.reached.has(each) ? "" : " The recording does not show which message it was."}`,
  };
  return says[/** @type {keyof says} */ (kind)]();
}

/** Returns the steps of the exchange of an event, each with its duration. @param {Scene} scene @param {number} each
 * @returns {[string, string][]} */
export function parts(scene, each) {
  return (scene.exchanges.get(scene.key[each]) ?? []).filter((part) => !["request", "response", "error"].includes(scene.kindOf(part)))
    .map((part) => [`${scene.kindOf(part)} (${scene.nodeOf(part)})`, scene.open[part] ? "not finished" : duration(scene.end[part] - scene.start[part])]);
}

/** @param {Scene} scene @param {number} each */
function heard(scene, each) {
  const callbacks = (scene.exchanges.get(scene.key[each]) ?? []).length - 1;
  return callbacks ? `${counted(callbacks, "callback")} got it.` : "The recording shows no callback that got it.";
}

/** Returns a sentence for each caller and each publisher about the nodes for which it waited.
 * @param {Scene} scene @returns {{waits: boolean, text: string}[]} */
export function waiting(scene) {
  const { calls, streams } = scene.recorded.waits;
  const said = [...calls.map((wait) => ({ waits: true, text: waited(wait) })), ...streams.map((stream) => ({ waits: false, text: published(stream) }))];
  const rest = said.length - SENTENCES;
  return rest > 1 ? [...said.slice(0, SENTENCES), { waits: false, text: `The table has ${rest} more.` }] : said;
}

/** @param {any} wait */
function waited({ node, service, servers, calls, blocked, longest, open, failed }) {
  const whom = servers.length ? `waited for ${servers.map((/** @type {string} */ each) => `\`${each}\``).join(" and ")} on` : open ? "waited for a server that does not answer, on" : "reached no server on";
  const long = calls > 1 ? `${duration(blocked * 1e6)} in ${calls} calls, the longest ${duration(longest * 1e6)}` : duration(blocked * 1e6);
  const ends = [open ? (calls > 1 ? `${open} not finished` : "and it is not finished") : "", failed ? (calls > 1 ? `${failed} failed` : "which failed") : ""].filter(Boolean);
  return `\`${node}\` ${whom} \`${service}\`: ${[long, ...ends].join(", ")}.`;
}

/** @param {any} stream */
function published({ node, topic, published: messages, alone, heard_by }) {
  const who = heard_by.length ? `received by ${heard_by.map((/** @type {string} */ each) => `\`${each}\``).join(" and ")}` : "received by no recorded node";
  const lost = !alone ? "" : alone === messages ? ", when no subscriber was connected" : `, ${alone} of them when no subscriber was connected`;
  return `\`${node}\` published ${counted(messages, "message")} on \`${topic}\`${alone === messages ? "" : `, ${who}`}${lost}, and did not wait.`;
}

/** Returns, for example, "1 node" or "2 nodes". @param {number} number @param {string} noun */
export function counted(number, noun) {
  return `${number} ${noun}${number === 1 ? "" : "s"}`;
}

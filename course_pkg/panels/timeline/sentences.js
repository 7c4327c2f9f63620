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
    lookup: () => `\`${node}\` asked the master for the address of \`${name}\`, and ${open ? "was still waiting when the recording ended" : `waited ${took}`}.`,
    connect: () => `\`${node}\` ${open ? "tried to connect" : "connected"} to ${peer ? `\`${peer}\`` : "the server"} to call \`${name}\`. ${open ? "The server did not answer before the recording ended" : `This took ${took}`}.`,
    request: () => `\`${node}\` sent its request for \`${name}\` to \`${peer}\`.`,
    wait: () => (open ? `\`${node}\` waited ${took} for \`${peer}\` to answer on \`${name}\`, and was still waiting when the recording ended.`
      : `\`${node}\` waited ${took} for \`${peer}\` to answer on \`${name}\`. During this time, its thread could do nothing else.`),
    response: () => `\`${node}\` received the response of \`${peer}\` on \`${name}\`.`,
    error: () => `The call of \`${node}\` on \`${name}\` failed: ${note}`,
    handler: () => `\`${node}\` ${open ? "was still working" : `worked for ${took}`} on \`${name}\` for \`${peer}\`${open ? " when the recording ended" : ""}.${note ? ` Result of the handler: ${note}` : ""}`,
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
  return callbacks ? `${counted(callbacks, "callback")} received the message.` : "The recording shows no callback that received the message.";
}

/** Returns a sentence for each caller and each publisher about the nodes for which it waited.
 * @param {Scene} scene @returns {{waits: boolean, text: string}[]} */
export function waiting(scene) {
  const { calls, streams } = scene.recorded.waits;
  const said = [...calls.map((wait) => ({ waits: true, text: waited(wait) })), ...streams.map((stream) => ({ waits: false, text: published(stream) }))];
  const rest = said.length - SENTENCES;
  return rest > 1 ? [...said.slice(0, SENTENCES), { waits: false, text: `${rest} more sentences are not shown. The table contains all events.` }] : said;
}

/** @param {any} wait */
function waited({ node, service, servers, calls, blocked, longest, open, failed }) {
  const whom = servers.length ? `waited for ${servers.map((/** @type {string} */ each) => `\`${each}\``).join(" and ")} on` : open ? "waited for a server that does not answer, on" : "reached no server on";
  const long = calls > 1 ? `${duration(blocked * 1e6)} in ${calls} calls. The longest call took ${duration(longest * 1e6)}` : duration(blocked * 1e6);
  const unfinished = !open ? "" : calls > 1 ? ` ${counted(open, "call")} had not finished when the recording ended.` : " The call had not finished when the recording ended.";
  const wrong = !failed ? "" : calls > 1 ? ` ${counted(failed, "call")} failed.` : " The call failed.";
  return `\`${node}\` ${whom} \`${service}\`: ${long}.${unfinished}${wrong}`;
}

/** @param {any} stream */
function published({ node, topic, published: messages, alone, heard_by }) {
  const who = heard_by.length ? ` ${heard_by.map((/** @type {string} */ each) => `\`${each}\``).join(" and ")} received messages.` : " No recorded node received a message.";
  const lost = !alone ? "" : alone === messages ? " No subscriber was connected." : ` No subscriber was connected when ${counted(alone, "message")} ${alone === 1 ? "was" : "were"} published.`;
  return `\`${node}\` published ${counted(messages, "message")} on \`${topic}\` and did not wait.${alone === messages ? "" : who}${lost}`;
}

/** Returns, for example, "1 node" or "2 nodes". @param {number} number @param {string} noun */
export function counted(number, noun) {
  return `${number} ${noun}${number === 1 ? "" : "s"}`;
}

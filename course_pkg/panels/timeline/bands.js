/* Joins events that are too close to each other into bands. */

/** @typedef {{events: number[], left: number, right: number, key: number, count: number, what: string}} Band */

const CLOSE = 3; // Events are not drawn separately if they are narrower and closer than this many px.
const MANY = 5; // A band contains at least this many calls or messages.
const BANDS = { lookup: "calls", connect: "calls", request: "calls", wait: "calls", response: "calls", handler: "requests", publish: "messages", callback: "callbacks" };

/** Returns the bands of the events in view. Events of the chosen exchange (a call or a message) are not put
 * into bands.
 * @param {import("./scene.js").Scene} scene @param {(time: number) => number} x the position of a time
 * @param {number} width px @param {number} chosen the key of the chosen exchange, or -1 @returns {Band[]} */
export function bandsOf(scene, x, width, chosen) {
  /** @type {Map<string, Band>} */
  const open = new Map();
  /** @type {Band[]} */
  const bands = [];
  for (let each = 0; each < scene.count; each++) {
    const [left, right] = [x(scene.start[each]), x(scene.end[each])];
    const what = BANDS[/** @type {keyof BANDS} */ (scene.kindOf(each))];
    if (!what || right < -8 || left > width + 8 || right - left >= CLOSE || scene.key[each] === chosen) continue;
    const place = `${scene.lane[each]} ${scene.rows[each]} ${scene.depth[each]} ${what}`;
    let band = open.get(place);
    if (!band || left - band.right >= CLOSE) {
      band = { events: [], left, right, key: -1, count: 0, what };
      open.set(place, band);
      bands.push(band);
    }
    band.events.push(each);
    band.right = Math.max(band.right, right);
    if (band.key !== scene.key[each]) band.count += 1;
    band.key = scene.key[each];
  }
  return bands.filter((band) => band.count >= MANY);
}

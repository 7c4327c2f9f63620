/* The data of a timeline: events in typed columns, and the positions of lanes and rows. This module does
   not use the page. */

/** @typedef {{length: number, kinds: string[], lanes: {node: string, rows: number}[], columns: Record<string, number[]>, strings: string[],
 *   arrows: [number, number][], waits: {calls: any[], streams: any[]}, idle: string[], unrecorded: [string, string][], notes: string[]}} Recorded */

const HEAD = 22; // The name of a lane is this many px high.
const GAP = 12; // The distance between two lanes is this many px.
// Each entry contains the maximum number of rows, the height of a row (px) and the distance between two rows
// (px).
const ROWS = [[16, 20, 3], [32, 12, 2], [52, 8, 2], [Infinity, 4, 1]];

/** All times are in µs. */
export class Scene {
  /** @param {Recorded} recorded */
  constructor(recorded) {
    const { columns } = recorded;
    this.recorded = recorded;
    this.length = recorded.length;
    this.count = columns.start?.length ?? 0;
    this.kinds = recorded.kinds;
    this.strings = recorded.strings;
    this.start = Float64Array.from(columns.start ?? []);
    this.end = Float64Array.from(columns.end ?? [], (end) => (end < 0 ? recorded.length : end));
    this.open = Array.from(columns.end ?? [], (end) => end < 0);
    this.rows = columns.row ?? [];
    for (const name of ["kind", "lane", "depth", "name", "peer", "key", "thread", "note"]) /** @type {any} */ (this)[name] = columns[name] ?? [];
    /** @type {number[]} */
    this.top = [];
    this.#layOut();
    this.#tie();
  }

  #layOut() {
    const rows = this.recorded.lanes.reduce((sum, lane) => sum + lane.rows, 0);
    const [, high, between] = /** @type {number[]} */ (ROWS.find(([most]) => rows <= most));
    [this.row, this.between] = [high, between];
    let y = 4;
    for (const lane of this.recorded.lanes) {
      this.top.push(y);
      y += HEAD + lane.rows * (this.row + this.between) + GAP;
    }
    this.height = Math.max(y - GAP + 8, 40);
  }

  /** Collects the events of each exchange (a call or a message), and the events that have an arrow. */
  #tie() {
    /** @type {Map<number, number[]>} */
    this.exchanges = new Map();
    for (let each = 0; each < this.count; each++) {
      const parts = this.exchanges.get(this.key[each]);
      if (parts) parts.push(each);
      else this.exchanges.set(this.key[each], [each]);
    }
    this.reached = new Set(this.recorded.arrows.flat());
  }

  /** @param {number} each */
  kindOf(each) {
    return this.kinds[this.kind[each]];
  }

  /** @param {number} each @param {"name" | "peer" | "key" | "thread" | "note"} column @returns {string} */
  word(each, column) {
    return this.strings[this[column][each]];
  }

  /** @param {number} each */
  nodeOf(each) {
    return this.recorded.lanes[this.lane[each]].node;
  }

  /** Returns the upper edge and the height of an event; an event inside another event has a smaller height. @param {number} each */
  place(each) {
    const inset = Math.min(this.depth[each] * 3, this.row / 2 - 2);
    const y = this.top[this.lane[each]] + HEAD + this.rows[each] * (this.row + this.between);
    return [y + inset, this.row - 2 * inset];
  }

  /** Returns the first and the last time that can be shown. */
  extent() {
    const room = Math.max(this.length * 0.02, 10);
    return [-room, this.length + room];
  }
}

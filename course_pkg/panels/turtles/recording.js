/* The turtles at a time of a recording: their positions, and the paper with their trails. */

/** @typedef {any[]} Row
 * @typedef {{background: number[], names: string[], palette: number[][], rows: Row[], length: number, edition: number}} Recording
 * @typedef {{x: number, y: number, theta: number}} Place */

export const SIDE = 500; // The simulator's paper is this many px wide and high.
export const DELAY = 150; // The picture has a delay of this many ms, so the next position of each turtle is already known.
const WORLD = 11088.889; // The world is this many mm wide and high.
const PEN = 3; // A pen has this default width in px, because no topic contains the width.

/** Plays the rows up to a time: stores the position of each turtle, and draws the lines on the paper. */
export class Player {
  /** @param {CanvasRenderingContext2D} paper */
  constructor(paper) {
    this.paper = paper;
    this.load({ background: [69, 86, 255], names: [], palette: [], rows: [], length: 0, edition: 0 });
  }

  /** @param {Recording} recording */
  load(recording) {
    this.recording = recording;
    this.rewind();
  }

  rewind() {
    this.done = 0; // the number of played rows
    this.time = 0;
    /** @type {Map<number, Row>} */
    this.here = new Map();
    this.#wipe();
  }

  /** Goes to a time, and draws the lines up to it. @param {number} time */
  goTo(time) {
    if (time < this.time) this.rewind();
    const rows = this.recording.rows;
    while (this.done < rows.length && rows[this.done][0] <= time) {
      this.#happen(rows[this.done], this.done);
      this.done += 1;
    }
    this.time = time;
  }

  /** Returns the positions of the turtles, also for a time between two rows. @returns {[number, Place][]} */
  places() {
    return [...this.here].map(([turtle, row]) => [turtle, between(row, this.#next(turtle), this.time)]);
  }

  /** @param {number} turtle @returns {Row | null} */
  #next(turtle) {
    const rows = this.recording.rows;
    for (let index = this.done; index < rows.length && rows[index][0] <= this.time + 4 * DELAY; index += 1)
      if (rows[index][1] === turtle) return typeof rows[index][2] === "string" ? null : rows[index];
    return null;
  }

  /** @param {Row} row @param {number} index */
  #happen(row, index) {
    const [, turtle, what] = row;
    if (what === "cleared") this.#wipe();
    else if (what === "gone") this.here.delete(turtle);
    else if (what === "undrawn") this.#undraw(turtle, row[3], index);
    else {
      const before = this.here.get(turtle);
      if (before && row[5] >= 0) this.#line(before, row);
      this.here.set(turtle, row);
    }
  }

  #wipe() {
    this.paper.fillStyle = colour(this.recording.background);
    this.paper.fillRect(0, 0, SIDE, SIDE);
  }

  /** Removes the colour from rows during which the pen was up, and draws everything again.
   * @param {number} turtle @param {number} since @param {number} until */
  #undraw(turtle, since, until) {
    let changed = false;
    for (const row of this.recording.rows.slice(0, until)) {
      if (row[1] !== turtle || typeof row[2] === "string" || row[0] <= since || row[5] < 0) continue;
      row[5] = -1;
      changed = true;
    }
    if (!changed) return;
    this.here.clear();
    this.#wipe();
    for (let index = 0; index < until; index += 1) if (this.recording.rows[index][2] !== "undrawn") this.#happen(this.recording.rows[index], index);
  }

  /** @param {Row} from @param {Row} to */
  #line(from, to) {
    const paper = this.paper;
    paper.strokeStyle = colour(this.recording.palette[to[5]]);
    paper.lineWidth = PEN;
    paper.lineCap = "round";
    paper.beginPath();
    paper.moveTo(...pixel(from[2], from[3]));
    paper.lineTo(...pixel(to[2], to[3]));
    paper.stroke();
  }
}

/** @param {number} x mm @param {number} y mm @returns {[number, number]} */
export function pixel(x, y) {
  return [(x / WORLD) * (SIDE - 1), (1 - y / WORLD) * (SIDE - 1)];
}

/** @param {number[]} rgb */
function colour(rgb) {
  return `rgb(${rgb.join(" ")})`;
}

/** Returns the position of a turtle between two rows. @param {Row} row @param {Row | null} next @param {number} time
 * @returns {Place} */
function between(row, next, time) {
  const part = next && next[0] > row[0] ? Math.min(Math.max((time - row[0]) / (next[0] - row[0]), 0), 1) : 0;
  // The turtle was teleported.
  if (!next || Math.hypot(next[2] - row[2], next[3] - row[3]) > 1500) return { x: row[2], y: row[3], theta: row[4] };
  const turn = ((((next[4] - row[4] + 3142) % 6283) + 6283) % 6283) - 3142;
  return { x: row[2] + part * (next[2] - row[2]), y: row[3] + part * (next[3] - row[3]), theta: row[4] + part * turn };
}

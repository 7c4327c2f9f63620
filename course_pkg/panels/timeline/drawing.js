/* Draws a scene on a canvas: only the part in view, in the colours of the page's style sheet. */
import { axis } from "../axes.js";
import { bandsOf } from "./bands.js";
import { cross, diamond, head, ring, tick, torn } from "./marks.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {{from: number, to: number}} View */

const MARK = 14; // An event that is narrower than this (px) is a small mark; a wider event is a bar with a text.
const APART = { message: 8, call: 3 }; // If arrows between the same two lanes are closer than this (px), some arrows are left out.
const AXIS = 26; // px
const COLOURS = ["text", "muted", "line", "ground", "raised", "error", "handler", "handler-edge", "wait-edge", "callback", "callback-edge"];
const BLOCKED = ["lookup", "connect", "wait"];
const NAMES = { lookup: "look-up", connect: "connect", request: "request", publish: "publish" };

export class Drawing {
  /** @param {Scene} scene */
  constructor(scene) {
    this.scene = scene;
    this.axis = canvas("ros-axis");
    this.axis.setAttribute("aria-hidden", "true");
    this.body = canvas("ros-body");
    this.probes = COLOURS.map((name) => probe(name));
    this.width = 0;
    this.thinned = false;
    /** @type {{colour: string, pattern: CanvasPattern | null}} */
    this.hatch = { colour: "", pattern: null };
  }

  /** @param {number} width px */
  resize(width) {
    this.width = width;
    this.ratio = window.devicePixelRatio || 1;
    fit(this.axis, width, AXIS, this.ratio);
    fit(this.body, width, this.scene.height, this.ratio);
    this.hatch.colour = "";
  }

  /** @param {View} view @param {number} chosen an event, or -1 */
  draw(view, chosen) {
    if (!this.width) return;
    this.view = view;
    this.scale = this.width / (view.to - view.from);
    this.colours = Object.fromEntries(COLOURS.map((name, index) => [name, getComputedStyle(this.probes[index]).color]));
    this.key = chosen < 0 ? -1 : this.scene.key[chosen];
    const ticks = this.#ticks();
    this.#drawAxis(ticks);
    const pen = this.#pen(this.body);
    this.#drawGround(pen, ticks);
    this.#drawArrows(pen);
    this.#drawEvents(pen, chosen);
    this.#drawNames(pen);
  }

  /** @param {number} time */
  x(time) {
    return (time - this.view.from) * this.scale;
  }

  /** Returns the event at a point of the body, or -1. The innermost and latest event has priority. @param {number} x
   * @param {number} y */
  at(x, y) {
    const { scene } = this;
    let [best, distance] = [-1, 5];
    for (let each = scene.count - 1; each >= 0; each--) {
      const [top, high] = scene.place(each);
      if (y < top - 2 || y > top + high + 2) continue;
      const [left, right] = [this.x(scene.start[each]), this.x(scene.end[each])];
      const off = Math.max(left - x, x - right, 0) - (right - left < 6 ? 0.5 : 0); // A small mark has priority over the bar below.
      if (off < distance || (off === distance && best >= 0 && scene.depth[each] > scene.depth[best])) [best, distance] = [each, off];
    }
    return best;
  }

  /** @param {HTMLCanvasElement} element */
  #pen(element) {
    const pen = /** @type {CanvasRenderingContext2D} */ (element.getContext("2d"));
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.clearRect(0, 0, element.width, element.height);
    pen.textBaseline = "middle";
    return pen;
  }

  #ticks() {
    const unit = this.view.to - this.view.from > 4e6 ? 1e6 : 1e3;
    const most = Math.max(2, Math.floor(this.width / 90));
    return axis(this.view.from / unit, this.view.to / unit, most, true).ticks
      .map(({ value, text }) => ({ x: this.x(value * unit), text: `${text} ${unit === 1e6 ? "s" : "ms"}` }));
  }

  /** @param {{x: number, text: string}[]} ticks */
  #drawAxis(ticks) {
    const pen = this.#pen(this.axis);
    pen.font = `11px ${font(this.axis)}`;
    pen.fillStyle = this.colours.muted;
    pen.textAlign = "center";
    for (const { x, text } of ticks) {
      const half = pen.measureText(text).width / 2 + 2;
      pen.fillText(text, Math.max(half, Math.min(x, this.width - half)), AXIS / 2);
      pen.fillRect(Math.round(x), AXIS - 5, 1, 5);
    }
  }

  /** @param {CanvasRenderingContext2D} pen @param {{x: number}[]} ticks */
  #drawGround(pen, ticks) {
    const [{ width }, { height }] = [this, this.scene];
    pen.fillStyle = this.colours.raised; // This colour marks the time outside the recording.
    const [first, last] = [this.x(0), this.x(this.scene.length)];
    if (first > 0) pen.fillRect(0, 0, first, height);
    if (last < width) pen.fillRect(last, 0, width - last, height);
    pen.fillStyle = this.colours.line;
    for (const { x } of ticks) pen.fillRect(Math.round(x), 0, 1, height);
    for (const top of this.scene.top.slice(1)) pen.fillRect(0, Math.round(top - 6), width, 1);
    pen.fillStyle = this.colours.muted;
    for (const x of [first, last]) if (x >= 0 && x <= width) pen.fillRect(Math.round(x), 0, 1, height);
  }

  /** @param {CanvasRenderingContext2D} pen */
  #drawNames(pen) {
    pen.textAlign = "left";
    pen.font = `600 12px ${font(this.body)}`;
    this.scene.recorded.lanes.forEach((lane, index) => {
      const [y, wide] = [this.scene.top[index] + 9, pen.measureText(lane.node).width];
      pen.globalAlpha = 0.85;
      pen.fillStyle = this.colours.ground;
      pen.fillRect(4, y - 9, wide + 8, 18);
      pen.globalAlpha = 1;
      pen.fillStyle = this.colours.text;
      pen.fillText(lane.node, 8, y, this.width - 16);
    });
  }

  /** @param {CanvasRenderingContext2D} pen */
  #drawArrows(pen) {
    const { scene } = this;
    /** @type {Map<number, number>} */
    const last = new Map(); // the position of the last arrow between two lanes
    this.thinned = false;
    for (const [from, to] of scene.recorded.arrows) {
      const mine = scene.key[from] === this.key;
      const message = scene.kindOf(from) === "publish";
      const answer = scene.kindOf(from) === "handler";
      const [x1, x2] = [this.x(answer ? scene.end[from] : scene.start[from]), this.x(scene.start[to])];
      if (Math.max(x1, x2) < -8 || Math.min(x1, x2) > this.width + 8) continue;
      if (!mine) {
        const pair = (scene.lane[from] * 1000 + scene.lane[to]) * 4 + (message ? 2 : Number(answer));
        if (Math.abs(x2 - (last.get(pair) ?? -Infinity)) < (message ? APART.message : APART.call)) {
          this.thinned = true;
          continue;
        }
        last.set(pair, x2);
      }
      const [[above, high], [below, deep]] = [scene.place(from), scene.place(to)];
      const [y1, y2] = above < below ? [above + high, below] : [above, below + deep];
      pen.globalAlpha = this.key < 0 || mine ? 1 : 0.3;
      pen.strokeStyle = pen.fillStyle = message ? this.colours["callback-edge"] : this.colours["handler-edge"];
      pen.lineWidth = mine ? 2.5 : message ? 1 : 1.5;
      pen.setLineDash(answer ? [5, 3] : []);
      pen.beginPath();
      pen.moveTo(x1, y1);
      pen.lineTo(x2, y2);
      pen.stroke();
      head(pen, x1, y1, x2, y2);
    }
    pen.setLineDash([]);
    pen.globalAlpha = 1;
  }

  /** @param {CanvasRenderingContext2D} pen @param {number} chosen */
  #drawEvents(pen, chosen) {
    const { scene } = this;
    pen.font = `11px ${font(this.body)}`;
    const crowded = this.#drawBands(pen);
    pen.textAlign = "left";
    for (let each = 0; each < scene.count; each++) {
      const [left, right] = [this.x(scene.start[each]), this.x(scene.end[each])];
      if (right < -8 || left > this.width + 8 || crowded.has(each)) continue;
      pen.globalAlpha = this.key < 0 || scene.key[each] === this.key ? 1 : 0.4;
      this.#drawEvent(pen, each, left, right);
    }
    pen.globalAlpha = 1;
    if (chosen >= 0) this.#outline(pen, chosen);
  }

  /** Draws events that are too small and too close as bands with a number; returns these events.
   * @param {CanvasRenderingContext2D} pen */
  #drawBands(pen) {
    const bands = bandsOf(this.scene, (time) => this.x(time), this.width, this.key);
    pen.textAlign = "center";
    for (const { events, left, right, count, what } of bands) {
      const [y, high] = this.scene.place(events[0]);
      const [from, to] = [Math.max(left, 0), Math.min(right, this.width)];
      const message = what === "messages" || what === "callbacks";
      pen.globalAlpha = this.key < 0 ? 1 : 0.4;
      pen.fillStyle = what === "calls" ? this.#hatched(pen) : this.colours[message ? "callback" : "handler"];
      pen.strokeStyle = this.colours[what === "calls" ? "wait-edge" : message ? "callback-edge" : "handler-edge"];
      pen.lineWidth = 1;
      pen.setLineDash([2, 2]); // A dashed line shows that a band is not one long event.
      pen.fillRect(from, y + high / 4, to - from, high / 2);
      pen.strokeRect(from, y + high / 4, to - from, high / 2);
      pen.setLineDash([]);
      const [text, middle] = [`${count} ${what}`, (from + to) / 2];
      const wide = pen.measureText(text).width + 8;
      if (wide > to - from || high < 11) continue;
      pen.fillStyle = this.colours.ground;
      pen.fillRect(middle - wide / 2, y + high / 2 - 7, wide, 14);
      pen.fillStyle = this.colours.text;
      pen.fillText(text, middle, y + high / 2 + 0.5);
    }
    pen.globalAlpha = 1;
    if (bands.length) this.thinned = true;
    return new Set(bands.flatMap((band) => band.events));
  }

  /** @param {CanvasRenderingContext2D} pen @param {number} each @param {number} left @param {number} right */
  #drawEvent(pen, each, left, right) {
    const kind = this.scene.kindOf(each);
    const [y, high] = this.scene.place(each);
    const wide = right - left;
    const bar = ["handler", "callback", "wait"].includes(kind) || wide >= MARK;
    if (kind === "error") cross(pen, left, y + high / 2, this.colours.error);
    else if (kind === "response") tick(pen, left, y, high, this.colours["handler-edge"]);
    else if (bar) this.#drawBar(pen, each, kind, Math.max(left, -20), Math.min(right, this.width + 20), y, high);
    else if (kind === "lookup") diamond(pen, left + wide / 2, y + Math.min(4, high / 2), this.colours["wait-edge"], this.colours.ground);
    else if (kind === "connect") ring(pen, left + wide / 2, y + high - Math.min(4, high / 2), this.colours["wait-edge"], this.colours.ground);
    else tick(pen, left, y, high, kind === "publish" ? this.colours["callback-edge"] : this.colours["handler-edge"], kind === "publish");
  }

  /** @param {CanvasRenderingContext2D} pen @param {number} each */
  #outline(pen, each) {
    const [y, high] = this.scene.place(each);
    const [left, right] = [Math.max(this.x(this.scene.start[each]), -20), Math.min(this.x(this.scene.end[each]), this.width + 20)];
    pen.strokeStyle = this.colours.text;
    pen.lineWidth = 2;
    pen.strokeRect(left - 2, y - 2, Math.max(right - left, 2) + 4, high + 4);
  }

  /** @param {CanvasRenderingContext2D} pen @param {number} each @param {string} kind @param {number} left @param {number} right
   * @param {number} y @param {number} high */
  #drawBar(pen, each, kind, left, right, y, high) {
    const open = this.scene.open[each];
    const wide = Math.max(right - left, 2);
    const message = kind === "callback" || kind === "publish";
    const edge = BLOCKED.includes(kind) ? "wait-edge" : message ? "callback-edge" : "handler-edge";
    pen.beginPath();
    if (open) torn(pen, left, y, wide, high);
    else pen.rect(left, y, wide, high);
    pen.fillStyle = wide <= 3 ? this.colours[edge] : BLOCKED.includes(kind) ? this.colours.ground : this.colours[message ? "callback" : "handler"];
    pen.fill();
    if (BLOCKED.includes(kind) && wide > 3) {
      pen.fillStyle = this.#hatched(pen);
      pen.fill();
    }
    pen.strokeStyle = this.colours[edge];
    pen.lineWidth = 1;
    if (wide > 3) pen.stroke();
    this.#drawWord(pen, each, kind, left, wide, y, high);
  }

  /** Writes a text into a bar if there is room for the text. In a hatched bar, the text has a plain
   * background.
   * @param {CanvasRenderingContext2D} pen @param {number} each @param {string} kind @param {number} left
   * @param {number} wide @param {number} y @param {number} high */
  #drawWord(pen, each, kind, left, wide, y, high) {
    if (wide < 30 || high < 11) return;
    const open = this.scene.open[each];
    const peer = this.scene.word(each, "peer");
    const whole = kind === "wait" ? `${open ? "still waits" : "waits"}${peer ? ` for ${peer}` : ""}` : kind === "handler" || kind === "callback" ? this.scene.word(each, "name") : NAMES[kind];
    const from = Math.max(left, 0);
    const room = Math.min(left + wide, this.width) - from - 10;
    const text = [whole, kind === "wait" ? (open ? "still waits" : "waits") : whole].find((each) => pen.measureText(each).width <= room);
    if (!text) return;
    if (BLOCKED.includes(kind)) {
      pen.fillStyle = this.colours.ground;
      pen.fillRect(from + 3, y + 2, pen.measureText(text).width + 4, high - 4);
    }
    pen.fillStyle = this.colours.text;
    pen.fillText(text, from + 5, y + high / 2 + 0.5);
  }

  /** Returns the stripes that mark waiting. @param {CanvasRenderingContext2D} pen */
  #hatched(pen) {
    const colour = this.colours["wait-edge"];
    if (this.hatch.colour !== colour) {
      const tile = document.createElement("canvas");
      const side = 6 * this.ratio;
      tile.width = tile.height = side;
      const brush = /** @type {CanvasRenderingContext2D} */ (tile.getContext("2d"));
      brush.strokeStyle = colour;
      brush.lineWidth = 1.4 * this.ratio;
      for (const shift of [-side, 0, side]) {
        brush.beginPath();
        brush.moveTo(shift, side);
        brush.lineTo(shift + side, 0);
        brush.stroke();
      }
      const pattern = pen.createPattern(tile, "repeat");
      pattern?.setTransform(new DOMMatrix().scale(1 / this.ratio));
      this.hatch = { colour, pattern };
    }
    return this.hatch.pattern ?? colour;
  }
}

/** @param {string} name */
function canvas(name) {
  const element = document.createElement("canvas");
  element.className = name;
  return element;
}

/** Makes a hidden element that has the colour of a variable in the current theme. @param {string} name */
function probe(name) {
  const element = document.createElement("i");
  element.hidden = true;
  element.style.color = `var(--ros-${name})`;
  return element;
}

/** @param {HTMLCanvasElement} element @param {number} width @param {number} height @param {number} ratio */
function fit(element, width, height, ratio) {
  element.width = Math.round(width * ratio);
  element.height = Math.round(height * ratio);
  element.style.width = `${width}px`;
  element.style.height = `${height}px`;
}

/** @param {Element} element */
function font(element) {
  return getComputedStyle(element).fontFamily || "sans-serif";
}

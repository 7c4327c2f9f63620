/* The turtle panel: paper with trails, turtles on top of it, and a tape that can be played again. */
import { freshId, h, kernelLink, say, send, setAttribute } from "../kit.js";

/** @typedef {any[]} Row
 * @typedef {{background: number[], names: string[], palette: number[][], rows: Row[], length: number, edition: number}} Tape
 * @typedef {{x: number, y: number, theta: number}} Place */

const SIDE = 500; // px of the simulator's own paper
const WORLD = 11088.889; // mm
const PEN = 3; // px: nobody announces a width, and this is the usual one
const DELAY = 150; // ms that the picture lags behind, so that there is always a next place to go to
const TABLE = 250; // ms between updates of the table
const KEPT = 5000; // ms between states kept for a saved notebook
const BODIES = ["#2f7d32", "#b3541e", "#6a3d9a", "#00695c", "#a01c5d", "#5d4a00", "#37474f", "#8e1b1b"];

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const ending = new AbortController();
  const panel = new TurtleView(model, ending.signal);
  el.append(panel.el);
  kernelLink(model, ending.signal, (live) => panel.kernel(live));
  return () => ending.abort();
}

/** What the rows come to at a time: where each turtle is, and what is on the paper. */
class Film {
  /** @param {CanvasRenderingContext2D} paper */
  constructor(paper) {
    this.paper = paper;
    this.load({ background: [69, 86, 255], names: [], palette: [], rows: [], length: 0, edition: 0 });
  }

  /** @param {Tape} tape */
  load(tape) {
    this.tape = tape;
    this.rewind();
  }

  rewind() {
    this.done = 0; // rows that have happened
    this.time = 0;
    /** @type {Map<number, Row>} */
    this.here = new Map();
    this.#wipe();
  }

  /** Go to a time, drawing on the way. @param {number} time */
  goTo(time) {
    if (time < this.time) this.rewind();
    const rows = this.tape.rows;
    while (this.done < rows.length && rows[this.done][0] <= time) {
      this.#happen(rows[this.done], this.done);
      this.done += 1;
    }
    this.time = time;
  }

  /** Where the turtles are between two rows. @returns {[number, Place][]} */
  places() {
    return [...this.here].map(([turtle, row]) => [turtle, between(row, this.#next(turtle), this.time)]);
  }

  /** @param {number} turtle @returns {Row | null} */
  #next(turtle) {
    const rows = this.tape.rows;
    for (let index = this.done; index < rows.length && rows[index][0] <= this.time + 4 * DELAY; index += 1)
      if (rows[index][1] === turtle) return typeof rows[index][2] === "string" ? null : rows[index];
    return null;
  }

  /** @param {Row} row @param {number} index */
  #happen(row, index) {
    const [, turtle, what] = row;
    if (what === "wiped") this.#wipe();
    else if (what === "gone") this.here.delete(turtle);
    else if (what === "undrawn") this.#undraw(turtle, row[3], index);
    else {
      const before = this.here.get(turtle);
      if (before && row[5] >= 0) this.#line(before, row);
      this.here.set(turtle, row);
    }
  }

  #wipe() {
    this.paper.fillStyle = colour(this.tape.background);
    this.paper.fillRect(0, 0, SIDE, SIDE);
  }

  /** The pen was up after all: take the ink out of the rows and draw all of it again.
   * @param {number} turtle @param {number} since @param {number} until */
  #undraw(turtle, since, until) {
    let changed = false;
    for (const row of this.tape.rows.slice(0, until)) {
      if (row[1] !== turtle || typeof row[2] === "string" || row[0] <= since || row[5] < 0) continue;
      row[5] = -1;
      changed = true;
    }
    if (!changed) return;
    this.here.clear();
    this.#wipe();
    for (let index = 0; index < until; index += 1) if (this.tape.rows[index][2] !== "undrawn") this.#happen(this.tape.rows[index], index);
  }

  /** @param {Row} from @param {Row} to */
  #line(from, to) {
    const paper = this.paper;
    paper.strokeStyle = colour(this.tape.palette[to[5]]);
    paper.lineWidth = PEN;
    paper.lineCap = "round";
    paper.beginPath();
    paper.moveTo(...pixel(from[2], from[3]));
    paper.lineTo(...pixel(to[2], to[3]));
    paper.stroke();
  }
}

class TurtleView {
  /** @param {import("../kit.js").Model} model @param {AbortSignal} signal */
  constructor(model, signal) {
    this.model = model;
    this.live = true;
    this.playing = false;
    this.visible = true;
    this.frame = 0;
    this.frames = 0;
    this.lag = 0; // ms by which the tape's clock is ahead of the page's
    this.tabled = -TABLE;
    this.kept = 0;
    this.#build();
    this.film = new Film(/** @type {CanvasRenderingContext2D} */ (this.paper.getContext("2d")));
    this.film.load(copy(model.get("tape")));
    model.on("msg:custom", (/** @type {any} */ content) => this.#hear(content));
    model.on("change:notice", () => this.#drawBanner());
    this.#watch(signal);
    this.#toEnd();
  }

  #build() {
    this.banner = h("div", { class: "ros-banner", role: "status", hidden: true });
    const size = Math.round(SIDE * Math.max(1, Math.min(window.devicePixelRatio || 1, 2)));
    this.scale = size / SIDE;
    this.canvas = /** @type {HTMLCanvasElement} */ (h("canvas", { width: size, height: size, role: "img" }));
    this.paper = /** @type {HTMLCanvasElement} */ (document.createElement("canvas"));
    this.paper.width = this.paper.height = size;
    this.paper.getContext("2d")?.scale(this.scale, this.scale);
    const id = freshId("ros-scrub");
    this.scrub = /** @type {HTMLInputElement} */ (h("input", { id, type: "range", min: 0, max: 0, step: 10, value: 0, "aria-label": "Moment of the recording",
      oninput: () => this.#seek(Number(this.scrub.value)) }));
    this.scrub.setAttribute("data-lm-suppress-shortcuts", "true");
    this.play = h("button", { type: "button", text: "Play", onclick: () => this.#toggle() });
    this.now = h("button", { type: "button", class: "ros-quiet", text: "Go live", onclick: () => this.#goLive() });
    this.moment = h("output", { for: id, class: "ros-muted" });
    this.body = h("tbody", {});
    this.empty = h("p", { class: "ros-muted ros-nobody", text: "" });
    this.el = h("section", { class: "ros-panel ros-turtles", "aria-label": "Turtle panel" }, this.banner,
      h("div", { class: "ros-stage" }, h("div", { class: "ros-world" }, this.canvas), h("div", { class: "ros-side" },
        h("table", {}, h("caption", { text: "Turtles" }), h("thead", {}, h("tr", {}, ...["Name", "x", "y", "θ"].map((text) => h("th", { scope: "col", text })))), this.body), this.empty)),
      h("div", { class: "ros-tape" }, this.play, this.scrub, this.moment, this.now));
  }

  /** Draw only what can be seen. @param {AbortSignal} signal */
  #watch(signal) {
    const observer = new IntersectionObserver(([entry]) => this.#see(entry.isIntersecting && !document.hidden));
    observer.observe(this.canvas);
    document.addEventListener("visibilitychange", () => this.#see(!document.hidden), { signal });
    signal.addEventListener("abort", () => {
      observer.disconnect();
      cancelAnimationFrame(this.frame);
    });
  }

  /** @param {boolean} visible */
  #see(visible) {
    if (visible === this.visible) return;
    this.visible = visible;
    send(this.model, { kind: visible ? "resend" : "pause" });
    if (visible) this.#run();
  }

  /** @param {any} content */
  #hear(content) {
    if (content.kind === "tape") {
      const at = this.following ? Infinity : this.film.time;
      this.film.load(content.tape);
      this.#clock(content.now);
      if (at !== Infinity) this.film.goTo(at);
    } else if (content.kind === "rows") {
      const tape = this.film.tape;
      if (content.start !== tape.rows.length) return void send(this.model, { kind: "resend" });
      tape.rows.push(...content.rows);
      tape.names = content.names;
      tape.palette = content.palette;
      this.#clock(content.now);
    } else return;
    this.#run();
  }

  /** @param {number} now */
  #clock(now) {
    this.film.tape.length = Math.max(this.film.tape.length, now);
    const lag = now - performance.now();
    this.lag = Math.abs(lag - this.lag) > 1000 ? lag : Math.max(lag, this.lag - 1);
    if (performance.now() - this.kept > KEPT) {
      this.kept = performance.now();
      this.model.set("tape", copy(this.film.tape)); // only here: this is what a saved notebook keeps
    }
  }

  /** @param {boolean} live */
  kernel(live) {
    this.live = live;
    if (live && !this.playing) this.following = true;
    if (!live && this.following) this.#toEnd();
    this.#drawBanner();
    this.#run();
  }

  #toEnd() {
    this.following = this.live;
    this.playing = false;
    this.film.goTo(this.film.tape.length);
    this.#draw();
  }

  #goLive() {
    this.playing = false;
    this.following = true;
    this.#run();
  }

  /** @param {number} time */
  #seek(time) {
    this.following = this.playing = false;
    this.film.goTo(time);
    this.#draw();
  }

  #toggle() {
    this.following = false;
    this.playing = !this.playing;
    if (this.playing && this.film.time >= this.film.tape.length - 50) this.film.goTo(0);
    this.last = performance.now();
    this.#run();
  }

  /** Keep drawing as long as something can move. */
  #run() {
    if (this.frame || !this.visible) return;
    this.last = performance.now();
    this.frame = requestAnimationFrame((now) => this.#step(now));
  }

  /** @param {number} now */
  #step(now) {
    this.frame = 0;
    if (!this.el.isConnected && this.frames > 0) return;
    const tape = this.film.tape;
    const end = tape.rows.length ? tape.rows[tape.rows.length - 1][0] : 0;
    if (this.following) this.film.goTo(Math.max(now + this.lag - DELAY, 0));
    else if (this.playing) this.film.goTo(Math.min(this.film.time + now - (this.last ?? now), tape.length));
    this.last = now;
    if (this.playing && this.film.time >= tape.length) this.playing = false;
    this.#draw();
    const more = this.following ? this.film.time <= end + DELAY : this.playing;
    if (more && this.visible) this.frame = requestAnimationFrame((next) => this.#step(next));
  }

  #draw() {
    this.frames += 1;
    const pen = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext("2d"));
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.drawImage(this.paper, 0, 0);
    pen.setTransform(this.scale, 0, 0, this.scale, 0, 0);
    const places = this.film.places();
    const dark = this.#darkText();
    for (const [turtle, place] of places) drawTurtle(pen, place, BODIES[turtle % BODIES.length], this.film.tape.names[turtle], dark);
    if (performance.now() - this.tabled > TABLE || !this.frame) this.#drawFacts(places);
  }

  /** @param {[number, Place][]} places */
  #drawFacts(places) {
    this.tabled = performance.now();
    const names = this.film.tape.names;
    const sorted = [...places].sort(([one], [other]) => names[one].localeCompare(names[other], undefined, { numeric: true }));
    while (this.body.rows.length > sorted.length) this.body.lastElementChild?.remove();
    while (this.body.rows.length < sorted.length)
      this.body.append(h("tr", {}, h("th", { scope: "row" }, h("span", { class: "ros-swatch" }), h("code", {})), h("td", {}), h("td", {}), h("td", {})));
    sorted.forEach(([turtle, place], index) => {
      const row = this.body.rows[index];
      /** @type {HTMLElement} */ (row.querySelector(".ros-swatch")).style.background = BODIES[turtle % BODIES.length];
      say(/** @type {Element} */ (row.querySelector("code")), names[turtle]);
      [place.x / 1000, place.y / 1000, place.theta / 1000].forEach((value, column) => say(row.cells[column + 1], value.toFixed(2)));
    });
    const words = sorted.map(([turtle, place]) => `${names[turtle]} at ${(place.x / 1000).toFixed(1)}, ${(place.y / 1000).toFixed(1)}`);
    setAttribute(this.canvas, "aria-label", words.length ? `The turtles' world: ${words.join("; ")}` : "The turtles' world, empty");
    say(this.empty, words.length ? "x and y in metres from the lower left, θ in radians" : this.live
      ? "No turtle is on the graph. Start turtlesim_node; they appear here by themselves." : "No turtle was recorded.");
    this.#drawTape();
    this.el.dataset.frames = String(this.frames);
  }

  #drawTape() {
    const { length } = this.film.tape;
    const time = Math.min(this.film.time, length);
    setAttribute(this.scrub, "max", length);
    this.scrub.value = String(time);
    say(this.moment, `${(time / 1000).toFixed(1)} of ${(length / 1000).toFixed(1)} s`);
    setAttribute(this.scrub, "aria-valuetext", `${(time / 1000).toFixed(1)} seconds`);
    say(this.play, this.playing ? "Pause" : "Play");
    setAttribute(this.play, "disabled", !this.film.tape.rows.length);
    setAttribute(this.scrub, "disabled", !this.film.tape.rows.length);
    setAttribute(this.now, "hidden", !this.live);
    setAttribute(this.now, "disabled", this.following);
    say(this.now, this.following ? "Live" : "Go live");
  }

  #drawBanner() {
    const notice = this.model.get("notice");
    const text = notice ? `The panel itself failed: ${notice}` : this.live ? "" : "No kernel answers: this is a recording. Play it, or drag the handle.";
    say(this.banner, text);
    this.banner.classList.toggle("ros-bad", Boolean(notice));
    setAttribute(this.banner, "hidden", !text);
    this.#drawTape();
  }

  /** Whether dark letters read better on this paper. */
  #darkText() {
    const [red, green, blue] = this.film.tape.background;
    return 0.299 * red + 0.587 * green + 0.114 * blue > 140;
  }
}

/** A turtle seen from above. @param {CanvasRenderingContext2D} pen @param {Place} place @param {string} body
 * @param {string} name @param {boolean} dark */
function drawTurtle(pen, place, body, name, dark) {
  const [x, y] = pixel(place.x, place.y);
  pen.save();
  pen.translate(x, y);
  pen.save();
  pen.rotate(-place.theta / 1000);
  pen.lineWidth = 1.5;
  pen.strokeStyle = "#ffffff";
  pen.fillStyle = "#9ccc65";
  for (const [px, py, rx, ry] of [[19, 0, 7, 5], [11, 13, 6, 4], [11, -13, 6, 4], [-11, 13, 6, 4], [-11, -13, 6, 4], [-19, 0, 5, 2]]) oval(pen, px, py, rx, ry);
  pen.fillStyle = body;
  oval(pen, 0, 0, 16, 13);
  pen.strokeStyle = "rgb(255 255 255 / 45%)";
  pen.beginPath();
  pen.moveTo(-9, 0); pen.lineTo(9, 0); pen.moveTo(-4, -10); pen.lineTo(-4, 10); pen.moveTo(5, -10); pen.lineTo(5, 10);
  pen.stroke();
  pen.restore();
  pen.font = "12px ui-monospace, Menlo, Consolas, monospace";
  pen.textAlign = "center";
  pen.lineWidth = 3;
  pen.strokeStyle = dark ? "#ffffff" : "#10182b";
  pen.fillStyle = dark ? "#10182b" : "#ffffff";
  const reach = pen.measureText(name).width / 2 + 4;
  const at = /** @type {[string, number, number]} */ ([name, Math.min(Math.max(x, reach), SIDE - reach) - x, y > SIDE - 40 ? -26 : 36]);
  pen.strokeText(...at);
  pen.fillText(...at);
  pen.restore();
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {number} rx @param {number} ry */
function oval(pen, x, y, rx, ry) {
  pen.beginPath();
  pen.ellipse(x, y, rx, ry, 0, 0, 2 * Math.PI);
  pen.fill();
  pen.stroke();
}

/** @param {number} x mm @param {number} y mm @returns {[number, number]} */
function pixel(x, y) {
  return [(x / WORLD) * (SIDE - 1), (1 - y / WORLD) * (SIDE - 1)];
}

/** @param {number[]} rgb */
function colour(rgb) {
  return `rgb(${rgb.join(" ")})`;
}

/** Where a turtle is on its way from one row to the next. @param {Row} row @param {Row | null} next @param {number} time
 * @returns {Place} */
function between(row, next, time) {
  const part = next && next[0] > row[0] ? Math.min(Math.max((time - row[0]) / (next[0] - row[0]), 0), 1) : 0;
  if (!next || Math.hypot(next[2] - row[2], next[3] - row[3]) > 1500) return { x: row[2], y: row[3], theta: row[4] }; // a teleport
  const turn = ((((next[4] - row[4] + 3142) % 6283) + 6283) % 6283) - 3142;
  return { x: row[2] + part * (next[2] - row[2]), y: row[3] + part * (next[3] - row[3]), theta: row[4] + part * turn };
}

/** @template T @param {T} value @returns {T} */
function copy(value) {
  return JSON.parse(JSON.stringify(value));
}

export default { render };

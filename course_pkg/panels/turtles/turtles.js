/* The turtle panel: the paper with the trails, the turtles on it, and a recording that can be played. */
import { h, kernelLink, say, send, setAttribute } from "../kit.js";
import { Replay, watch } from "../replay.js";
import { drawTurtle } from "./body.js";
import { DELAY, Player, SIDE } from "./recording.js";

const TABLE = 250; // The table is updated every TABLE ms.
const KEPT = 5000; // The state for the saved notebook is updated every KEPT ms.
const BODIES = ["#2f7d32", "#b3541e", "#6a3d9a", "#00695c", "#a01c5d", "#5d4a00", "#37474f", "#8e1b1b"];

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const ending = new AbortController();
  const panel = new TurtleView(model, ending.signal);
  el.append(panel.el);
  kernelLink(model, ending.signal, (live) => panel.kernel(live));
  return () => ending.abort();
}

class TurtleView {
  /** @param {import("../kit.js").Model} model @param {AbortSignal} signal */
  constructor(model, signal) {
    this.model = model;
    this.live = true;
    this.following = true;
    this.visible = true;
    this.frame = 0;
    this.frames = 0;
    this.lag = 0; // The recording's clock is this many ms ahead of the page's clock.
    this.tabled = -TABLE;
    this.kept = 0;
    this.#build();
    this.player = new Player(/** @type {CanvasRenderingContext2D} */ (this.paper.getContext("2d")));
    this.player.load(copy(model.get("recorded")));
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
    this.now = h("button", { type: "button", class: "ros-quiet", text: "Go live", onclick: () => this.#goLive() });
    this.replay = new Replay((time) => this.#show(time), this.now);
    this.body = h("tbody", {});
    this.empty = h("p", { class: "ros-muted ros-nobody", text: "" });
    this.el = h("section", { class: "ros-panel ros-turtles", "aria-label": "Turtle panel" }, this.banner,
      h("div", { class: "ros-stage" }, h("div", { class: "ros-world" }, this.canvas), h("div", { class: "ros-side" },
        h("table", {}, h("caption", { text: "Turtles" }), h("thead", {}, h("tr", {}, ...["Name", "x", "y", "θ"].map((text) => h("th", { scope: "col", text })))), this.body), this.empty)),
      this.replay.el);
  }

  /** Stops drawing while the panel cannot be seen. @param {AbortSignal} signal */
  #watch(signal) {
    watch(this.canvas, signal, (visible) => this.#see(visible));
    signal.addEventListener("abort", () => {
      this.replay.stop();
      cancelAnimationFrame(this.frame);
    });
  }

  /** @param {boolean} visible */
  #see(visible) {
    if (visible === this.visible) return;
    this.visible = visible;
    this.replay.see(visible);
    send(this.model, { kind: visible ? "resend" : "pause" });
    if (visible) this.#run();
  }

  /** @param {any} content */
  #hear(content) {
    if (content.kind === "recording") {
      const at = this.following ? Infinity : this.player.time;
      this.player.load(content.recording);
      this.#clock(content.now);
      if (at !== Infinity) this.player.goTo(at);
    } else if (content.kind === "rows") {
      const recording = this.player.recording;
      if (content.start !== recording.rows.length) return void send(this.model, { kind: "resend" });
      recording.rows.push(...content.rows);
      recording.names = content.names;
      recording.palette = content.palette;
      this.#clock(content.now);
    } else return;
    this.#run();
  }

  /** @param {number} now */
  #clock(now) {
    this.player.recording.length = Math.max(this.player.recording.length, now);
    const lag = now - performance.now();
    this.lag = Math.abs(lag - this.lag) > 1000 ? lag : Math.max(lag, this.lag - 1);
    if (performance.now() - this.kept > KEPT) {
      this.kept = performance.now();
      this.model.set("recorded", copy(this.player.recording)); // JupyterLab saves this value with the notebook; it is not sent to the kernel.
    }
  }

  /** @param {boolean} live */
  kernel(live) {
    this.live = live;
    if (live && !this.replay.playing) this.following = true;
    if (!live && this.following) this.#toEnd();
    this.#drawBanner();
    this.#run();
  }

  #toEnd() {
    this.following = this.live;
    this.replay.stop();
    this.player.goTo(this.player.recording.length);
    this.#draw();
  }

  #goLive() {
    this.replay.stop();
    this.following = true;
    this.#run();
  }

  /** Shows a moment of the recording. @param {number} time */
  #show(time) {
    this.following = false;
    this.player.goTo(time);
    this.#draw();
  }

  /** Draws repeatedly while a turtle can move. */
  #run() {
    if (this.frame || !this.visible) return;
    this.frame = requestAnimationFrame((now) => this.#step(now));
  }

  /** @param {number} now */
  #step(now) {
    this.frame = 0;
    if (!this.el.isConnected && this.frames > 0) return;
    const recording = this.player.recording;
    const end = recording.rows.length ? recording.rows[recording.rows.length - 1][0] : 0;
    if (this.following) this.player.goTo(Math.max(now + this.lag - DELAY, 0));
    this.#draw();
    if (this.following && this.player.time <= end + DELAY && this.visible) this.frame = requestAnimationFrame((next) => this.#step(next));
  }

  #draw() {
    this.frames += 1;
    const pen = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext("2d"));
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.drawImage(this.paper, 0, 0);
    pen.setTransform(this.scale, 0, 0, this.scale, 0, 0);
    this.replay.be(this.player.time, this.player.recording.length, this.player.recording.rows.length > 0);
    const places = this.player.places();
    const dark = this.#darkText();
    for (const [turtle, place] of places) drawTurtle(pen, place, BODIES[turtle % BODIES.length], this.player.recording.names[turtle], dark);
    if (performance.now() - this.tabled > TABLE || !this.frame) this.#drawFacts(places);
  }

  /** @param {[number, Place][]} places */
  #drawFacts(places) {
    this.tabled = performance.now();
    const names = this.player.recording.names;
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
      ? "No turtle is on the graph. Start turtlesim_node; its turtles then appear here." : "No turtle was recorded.");
    this.#drawRecording();
    this.el.dataset.frames = String(this.frames);
  }

  #drawRecording() {
    this.replay.show();
    setAttribute(this.now, "hidden", !this.live);
    setAttribute(this.now, "disabled", this.following);
    say(this.now, this.following ? "Live" : "Go live");
  }

  #drawBanner() {
    const notice = this.model.get("notice");
    const text = notice ? `The panel itself failed: ${notice}` : this.live ? "" : "No kernel answers: this is a recording. Play it, or move the slider.";
    say(this.banner, text);
    this.banner.classList.toggle("ros-bad", Boolean(notice));
    setAttribute(this.banner, "hidden", !text);
    this.#drawRecording();
  }

  /** Returns whether dark letters are easier to read on this paper. */
  #darkText() {
    const [red, green, blue] = this.player.recording.background;
    return 0.299 * red + 0.587 * green + 0.114 * blue > 140;
  }
}

/** @template T @param {T} value @returns {T} */
function copy(value) {
  return JSON.parse(JSON.stringify(value));
}

export default { render };

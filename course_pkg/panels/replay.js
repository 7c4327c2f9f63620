/* The controls that play a recording: a button, a slider, the time as text, and the clock that moves them. */
import { freshId, h, say, setAttribute } from "./kit.js";

const NEAR = 50; // If Play is pressed less than this many ms before the end, the recording starts again.
const ARROW = 100; // An arrow key moves the slider by this many ms.
const CALM = 1000; // If the reader's system asks for less motion, this code draws a picture every CALM ms.

/** Calls `told(visible)` now and after each change of the element's visibility.
 * @param {Element} element @param {AbortSignal} signal @param {(visible: boolean) => void} told */
export function watch(element, signal, told) {
  const observer = new IntersectionObserver(([entry]) => told(entry.isIntersecting && !document.hidden));
  observer.observe(element);
  document.addEventListener("visibilitychange", () => told(!document.hidden), { signal });
  signal.addEventListener("abort", () => observer.disconnect());
}

export class Replay {
  /** @param {(time: number) => void} moved gets the new time (ms) when the reader or the clock moves it
   * @param {...HTMLElement} more elements after the text of the time */
  constructor(moved, ...more) {
    this.moved = moved;
    this.time = 0; // ms
    this.length = 0; // ms
    this.some = false; // true if there is a recording to play
    this.playing = false;
    this.visible = true;
    this.frame = 0;
    this.last = 0;
    const id = freshId("ros-scrub");
    this.play = h("button", { type: "button", text: "Play", onclick: () => this.#toggle() });
    this.scrub = /** @type {HTMLInputElement} */ (h("input", { id, type: "range", min: 0, max: 0, step: ARROW, value: 0, "aria-label": "Moment of the recording",
      "data-lm-suppress-shortcuts": "true", oninput: () => this.#seek(Number(this.scrub.value)) }));
    this.moment = h("output", { for: id, class: "ros-muted" });
    this.el = h("div", { class: "ros-replay" }, this.play, this.scrub, this.moment, ...more);
  }

  /** Sets the time and the length (ms) of the recording, but does not change the page; show() updates the page.
   * @param {number} time @param {number} length @param {boolean} some */
  be(time, length, some) {
    this.length = length;
    this.time = Math.min(time, length);
    this.some = some;
  }

  /** Writes the time to the page if the page shows another time. */
  show() {
    const [time, length] = [this.time, this.length].map((each) => (each / 1000).toFixed(1));
    const step = this.length < 10 * ARROW ? 1 : ARROW; // A slider stops only at steps, so a short recording has smaller steps.
    setAttribute(this.scrub, "step", step);
    setAttribute(this.scrub, "max", step * Math.ceil(this.length / step)); // Without this rounding, the slider could not reach the end.
    this.scrub.value = String(this.time);
    say(this.moment, `${time} of ${length} s`);
    setAttribute(this.scrub, "aria-valuetext", `${time} of ${length} seconds`);
    say(this.play, this.playing ? "Pause" : "Play");
    for (const control of [this.play, this.scrub]) setAttribute(control, "disabled", !this.some);
  }

  stop() {
    this.playing = false;
    cancelAnimationFrame(this.frame);
    this.frame = 0;
  }

  /** The clock stops while the recording is not visible, and then continues from the same time of the
   * recording.
   * @param {boolean} visible */
  see(visible) {
    this.visible = visible;
    this.#run();
  }

  #toggle() {
    this.playing = !this.playing;
    if (this.playing && this.time >= this.length - NEAR) this.#go(0);
    this.show();
    this.#run();
  }

  /** @param {number} time */
  #seek(time) {
    this.stop();
    this.#go(time);
    this.show();
  }

  /** @param {number} time */
  #go(time) {
    this.time = Math.min(time, this.length);
    this.moved(this.time);
  }

  #run() {
    if (this.frame || !this.playing || !this.visible) return;
    this.last = performance.now();
    this.frame = requestAnimationFrame((now) => this.#step(now));
  }

  /** @param {number} now */
  #step(now) {
    this.frame = 0;
    if (!this.playing || !this.visible || !this.el.isConnected) return;
    const passed = Math.max(0, now - this.last);
    if (passed >= (matchMedia("(prefers-reduced-motion: reduce)").matches ? CALM : 0)) {
      this.last = now;
      this.playing = this.time + passed < this.length;
      this.#go(this.time + passed);
      this.show();
    }
    if (this.playing) this.frame = requestAnimationFrame((next) => this.#step(next));
  }
}

/* The wire view: the steps of a call, and the bytes of the chosen step beside their meaning. */
import { freshId, h, say, setAttribute } from "../kit.js";

/** @typedef {{role: string, at: number, size: number, depth: number, name: string, type: string, value: string, hex: string}} Piece */
/** @typedef {{title: string, from: string, to: string, ms: number, says: string, size: number, pieces: Piece[], text: string,
 *   bad: boolean, connection: number}} Step */
/** @typedef {{service: string, names: Record<string, string>, steps: Step[], outcome: string, notes: string[]}} Exchange */

const ROW = 8; // A row has this many bytes.
const HUES = 6; // The view uses this many colours in turn.
const LOUD = ["key", "md5", "value"]; // Only pieces with these roles have such a colour.
const KEYS = { ArrowDown: 1, ArrowUp: -1, Home: -Infinity, End: Infinity };

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const view = new WireView(model.get("exchange"));
  el.append(view.el);
}

class WireView {
  /** @param {Exchange} exchange */
  constructor(exchange) {
    this.exchange = exchange;
    const { service, names, steps, outcome, notes } = exchange;
    this.back = h("button", { type: "button", "aria-label": "The previous step", text: "◀", onclick: () => this.#go(this.current - 1) });
    this.next = h("button", { type: "button", "aria-label": "The next step", text: "▶", onclick: () => this.#go(this.current + 1) });
    this.slider = /** @type {HTMLInputElement} */ (h("input", { type: "range", min: 1, max: Math.max(steps.length, 1), value: 1, "aria-label": "Step of the call",
      "data-lm-suppress-shortcuts": "true", oninput: () => this.#go(Number(this.slider.value) - 1) }));
    this.count = h("span", { class: "ros-muted", role: "status" });
    this.rungs = steps.map((step, number) => this.#rung(step, number));
    this.details = h("div", { class: "ros-step" });
    this.table = h("details", { class: "ros-list" }, h("summary", { text: "The whole exchange as a table" }));
    this.table.addEventListener("toggle", () => this.#fillTable());
    this.el = h("section", { class: "ros-panel ros-wire", "aria-label": "Wire view" },
      h("div", { class: "ros-bar" }, h("h3", { text: `A call of ${service}, byte by byte` }),
        h("div", { class: "ros-steps" }, this.back, this.slider, this.next, this.count)),
      outcome ? h("p", { class: "ros-banner ros-bad", text: `The call failed: ${outcome}` }) : null,
      steps.length ? h("ol", { class: "ros-ladder", "aria-label": `Steps between ${names.client} and ${names.server}` }, ...this.rungs)
        : h("p", { class: "ros-empty", text: "No connection was made during the recording." }),
      this.details, this.table,
      h("p", { class: "ros-foot ros-muted", text: ["This is a recording of a real call, and the panel needs no kernel. The relay that recorded the call made each step a little slower.", ...notes].join(" ") }));
    const failed = steps.findIndex((step) => step.bad);
    this.#go(Math.max(failed < 0 ? steps.findIndex((step) => step.title === "Request") : failed, 0));
  }

  /** @param {Step} step @param {number} number */
  #rung(step, number) {
    const { names } = this.exchange;
    const right = step.from === "client";
    const far = names[right ? step.to : step.from];
    const words = `${names[step.from]} to ${names[step.to]}: ${step.title}`;
    const button = h("button", { type: "button", onclick: () => this.#go(number) },
      h("span", { class: "ros-time", text: `${step.ms.toFixed(2)} ms` }), " ", h("code", { class: "ros-end", text: names.client }), " ",
      h("span", { class: "ros-arrow", text: right ? "──▶" : "◀──" }), " ", h("code", { class: "ros-end", text: far }), " ",
      h("span", { class: "ros-title", text: `${step.connection ? `${step.connection}: ` : ""}${step.title}` }), " ",
      h("span", { class: "ros-size", text: step.size ? `${step.size.toLocaleString("en")} B` : "" }));
    // For speech input, the accessible name must contain the visible text.
    setAttribute(button, "aria-label", `${button.textContent?.trim()}: ${words}`);
    button.addEventListener("keydown", (event) => {
      const by = KEYS[/** @type {keyof KEYS} */ (event.key)];
      if (by === undefined) return;
      event.preventDefault();
      this.#go(Math.min(Math.max(this.current + by, 0), this.rungs.length - 1));
      this.rungs[this.current].querySelector("button")?.focus();
    });
    return h("li", { class: step.bad ? "ros-failed" : null }, button);
  }

  /** @param {number} number */
  #go(number) {
    const { steps } = this.exchange;
    if (number < 0 || number >= steps.length) {
      if (!steps.length) for (const each of [this.back, this.next, this.slider]) setAttribute(each, "disabled", true);
      return;
    }
    this.current = number;
    this.slider.value = String(number + 1);
    setAttribute(this.slider, "aria-valuetext", steps[number].title);
    setAttribute(this.back, "disabled", number === 0);
    setAttribute(this.next, "disabled", number === steps.length - 1);
    say(this.count, `step ${number + 1} of ${steps.length}`);
    this.rungs.forEach((rung, each) => {
      rung.classList.toggle("ros-later", each > number);
      setAttribute(/** @type {HTMLElement} */ (rung.firstChild), "aria-current", each === number ? "step" : null);
      setAttribute(/** @type {HTMLElement} */ (rung.firstChild), "tabindex", each === number ? "0" : "-1");
    });
    this.#show(steps[number]);
  }

  /** @param {Step} step */
  #show(step) {
    const parts = [h("h4", { text: step.title }), h("p", { text: step.says })];
    if (step.text) parts.push(h("pre", { tabindex: "0", "aria-label": "What was sent, as text", text: step.text }));
    if (step.pieces.length) parts.push(this.#bytes(step));
    this.details.replaceChildren(...parts);
  }

  /** @param {Step} step */
  #bytes(step) {
    const hues = huesOf(step.pieces);
    const leaves = step.pieces.filter((piece) => piece.role !== "group");
    /** @type {Map<number, HTMLElement[]>} */
    const cells = new Map(); // the elements that show a byte, by the offset of the byte
    const dump = h("div", { class: "ros-dump" });
    let row = /** @type {HTMLElement | null} */ (null);
    let column = 0;
    for (const piece of leaves) {
      const shown = piece.hex.length / 2;
      for (let each = 0; each < shown; each++) {
        const [at, byte] = [piece.at + each, parseInt(piece.hex.slice(2 * each, 2 * each + 2), 16)];
        if (!row || column === ROW) [row, column] = [line(dump, at), 0];
        const look = `ros-byte ${hues.get(piece)}`;
        const [hex, char] = [h("span", { class: look, text: piece.hex.slice(2 * each, 2 * each + 2) }), h("span", { class: look, text: byte > 31 && byte < 127 ? String.fromCharCode(byte) : "·" })];
        row.children[1].append(hex);
        row.children[2].append(char);
        cells.set(at, [hex, char]);
        for (const cell of [hex, char]) cell.dataset.at = String(at);
        column += 1;
      }
      if (shown < piece.size) {
        dump.append(h("div", { class: "ros-fold", text: `… ${(piece.size - shown).toLocaleString("en")} more bytes, folded` }));
        row = null;
      }
    }
    const rows = step.pieces.map((piece, number) => this.#row(piece, number, /** @type {string} */ (hues.get(piece))));
    const body = h("tbody", {}, ...rows);
    const light = (/** @type {number} */ chosen) => {
      const piece = step.pieces[chosen];
      for (const [at, pair] of cells) for (const cell of pair) cell.classList.toggle("ros-on", Boolean(piece) && at >= piece.at && at < piece.at + piece.size);
      rows.forEach((each, number) => each.classList.toggle("ros-on", number === chosen));
    };
    let kept = -1;
    rows.forEach((each, number) => {
      each.addEventListener("mouseenter", () => light(number));
      each.addEventListener("focus", () => {
        rows[Math.max(kept, 0)].tabIndex = -1;
        each.tabIndex = 0;
        light((kept = number));
      });
      each.addEventListener("keydown", (event) => {
        const by = KEYS[/** @type {keyof KEYS} */ (event.key)];
        if (by === undefined) return;
        event.preventDefault();
        rows[Math.min(Math.max(number + by, 0), rows.length - 1)].focus();
      });
    });
    body.addEventListener("mouseleave", () => light(kept));
    const under = (/** @type {Event} */ event) => {
      const at = Number(/** @type {HTMLElement} */ (event.target).dataset?.at ?? NaN);
      return step.pieces.findIndex((piece) => piece.role !== "group" && at >= piece.at && at < piece.at + piece.size);
    };
    dump.addEventListener("mouseover", (event) => light(under(event) < 0 ? kept : under(event)));
    dump.addEventListener("mouseleave", () => light(kept));
    dump.addEventListener("click", (event) => rows[under(event)]?.focus());
    const head = ["Offset", "Bytes", "Name", "Type", "Value"].map((text) => h("th", { scope: "col", text }));
    return h("div", { class: "ros-sides" }, h("div", { class: "ros-scroll", "aria-hidden": "true" }, dump),
      h("div", { class: "ros-scroll" }, h("table", { "aria-label": `The pieces of: ${step.title}. Use the arrow keys to go from one piece to the next.` }, h("thead", {}, h("tr", {}, ...head)), body)));
  }

  /** @param {Piece} piece @param {number} number @param {string} hue */
  #row(piece, number, hue) {
    const name = h("td", { style: `padding-left: ${24 + 14 * piece.depth}px` }, h("span", { class: `ros-swatch ${hue}`, "aria-hidden": "true" }), h("span", { text: piece.name }));
    return h("tr", { class: `ros-${piece.role}`, tabindex: number ? "-1" : "0", "data-lm-suppress-shortcuts": "true" },
      h("td", {}, h("code", { text: offset(piece.at) })), h("td", { text: piece.size.toLocaleString("en") }), name,
      h("td", {}, h("code", { text: piece.type })), h("td", { class: "ros-says" }, h("code", { text: piece.value })));
  }

  /** Fills the table when it is opened for the first time. */
  #fillTable() {
    if (!(/** @type {HTMLDetailsElement} */ (this.table).open) || this.table.childElementCount > 1) return;
    const heads = ["Step", "Offset", "Size", "Bytes", "Name", "Type", "Value"].map((text) => h("th", { scope: "col", text }));
    const rows = this.exchange.steps.flatMap((step, number) => {
      const title = `${number + 1}. ${step.title}`;
      if (!step.pieces.length) return [[title, "", String(step.size || ""), "", "", "", step.text ? "text" : ""]];
      return step.pieces.map((piece, each) => [each ? "" : title, offset(piece.at), String(piece.size), spaced(piece), piece.name, piece.type, piece.value]);
    });
    this.table.append(h("div", { class: "ros-scroll", tabindex: "0", role: "group", "aria-label": "The whole exchange" },
      h("table", {}, h("thead", {}, h("tr", {}, ...heads)), h("tbody", {}, ...rows.map((row) => h("tr", {}, ...row.map((text) => h("td", { text }))))))));
  }
}

/** Adds a row to the dump: offset, bytes, characters. @param {HTMLElement} dump @param {number} at */
function line(dump, at) {
  const row = h("div", { class: "ros-row" }, h("span", { class: "ros-offset", text: offset(at) }), h("span", { class: "ros-hex" }), h("span", { class: "ros-chars" }));
  dump.append(row);
  return row;
}

/** @param {Piece[]} pieces */
function huesOf(pieces) {
  let turn = 0;
  return new Map(pieces.map((piece) => [piece, LOUD.includes(piece.role) ? `ros-hue${turn++ % HUES}` : `ros-is-${piece.role}`]));
}

/** @param {number} at */
function offset(at) {
  return `0x${at.toString(16).padStart(4, "0")}`;
}

/** @param {Piece} piece */
function spaced(piece) {
  return (piece.hex.match(/../g) ?? []).join(" ") + (piece.role !== "group" && piece.hex.length / 2 < piece.size ? " …" : "");
}

export default { render };

/* The type browser: the list of all types, and the open type. */
import { command } from "../forms/parts.js";
import { h, kernelLink, prose, same, say, send, setAttribute } from "../kit.js";
import { TypeList } from "./list.js";

/** @typedef {{name: string, type: string, help: string, fields: Field[]}} Field */
/** @typedef {{title: string, help: string, fields: Field[], constants: {name: string, type: string, value: string}[]}} Part */
/** @typedef {{name: string, half: "srv" | "msg", md5: string, file: string, text: string, problem: string, warning: string,
 *   parts: Part[], lines: {label: string, text: string}[]}} Described */

/** @param {{model: import("../kit.js").Model, el: HTMLElement}} context */
function render({ model, el }) {
  const ending = new AbortController();
  const panel = new TypeView(model);
  el.append(panel.el);
  kernelLink(model, ending.signal, (live) => panel.kernel(live));
  return () => ending.abort();
}

class TypeView {
  /** @param {import("../kit.js").Model} model */
  constructor(model) {
    this.model = model;
    this.live = true;
    /** @type {Set<string>} */
    this.unfolded = new Set();
    this.list = new TypeList((type) => send(model, { kind: "open", ...type }));
    this.banner = h("div", { class: "ros-banner", role: "status", hidden: true });
    this.about = h("div", { class: "ros-about", role: "region", "aria-label": "The open type" });
    this.offers = h("div", { class: "ros-offers" });
    this.el = h("section", { class: "ros-panel ros-types", "aria-label": "Type browser" }, this.banner, h("div", { class: "ros-sides" }, this.list.el, this.about));
    model.on("change:packages", () => this.#drawList());
    model.on("change:described", () => this.#drawType());
    model.on("change:offers", () => this.#drawOffers());
    for (const trait of ["trouble", "notice"]) model.on(`change:${trait}`, () => this.#drawBanner());
    this.#drawList();
    this.#drawType();
    this.#drawBanner();
  }

  /** @param {boolean} live */
  kernel(live) {
    this.live = live;
    this.list.kernel(live);
    this.#drawBanner();
    this.#drawOffers();
  }

  #drawList() {
    this.list.packages = this.model.get("packages");
    this.list.offered = this.#offered();
    this.list.draw();
  }

  #drawBanner() {
    const notice = this.model.get("notice");
    const saved = "No kernel answers: this is a saved panel. You can search the list. To open another type, run the notebook.";
    const text = notice ? `The panel itself failed: ${notice}` : this.live ? this.model.get("trouble") : saved;
    say(this.banner, text);
    this.banner.classList.toggle("ros-bad", Boolean(text) && this.live);
    setAttribute(this.banner, "hidden", !text);
  }

  #drawType() {
    /** @type {Described} */
    const type = this.model.get("described");
    if (!type.name) return this.about.replaceChildren(h("p", { class: "ros-muted ros-nothing", text: "Pick a type from the list to see its fields." }));
    if (this.name !== type.name) this.unfolded = new Set(type.problem ? ["text"] : []); // The error is in the text of the file.
    this.name = type.name;
    const what = type.half === "srv" ? "service type" : "message type";
    const parts = [h("div", { class: "ros-what" }, h("h3", {}, h("code", { text: type.name })), " ", h("span", { class: "ros-muted", text: what })),
      type.problem ? h("pre", { class: "ros-problem", "aria-label": "What is wrong", text: type.problem }) : null,
      type.warning ? h("p", { class: "ros-warning" }, ...prose(type.warning)) : null,
      ...type.parts.map((part, number) => this.#part(part, `${number}`)), this.offers,
      type.problem ? null : h("div", { class: "ros-lines" }, line("MD5", type.md5), ...type.lines.map(({ label, text }) => line(label, text))),
      type.text || type.file ? this.#text(type) : null];
    this.about.replaceChildren(.../** @type {HTMLElement[]} */ (parts.filter(Boolean)));
    this.list.show({ name: type.name, half: type.half });
    this.#drawOffers();
  }

  /** @param {Described} type */
  #text(type) {
    const name = type.file ? type.file.split("/").slice(-1)[0] : `${type.name.split("/")[1]}.${type.half}`;
    return this.#fold("text", [h("span", { text: `The text of ${name}` })], type.file ? h("p", { class: "ros-muted", text: type.file }) : null,
      h("pre", { class: "ros-text", tabindex: "0", "aria-label": `The text of ${name}`, text: type.text || "The file is empty." }));
  }

  /** @param {Part} part @param {string} path */
  #part(part, path) {
    return h("div", { class: "ros-part" }, h("h4", { text: part.title }), part.help ? h("p", { class: "ros-muted", text: part.help }) : null,
      part.fields.length ? this.#tree(part.fields, path) : h("p", { class: "ros-muted", text: "no fields" }),
      part.constants.length ? h("ul", { class: "ros-tree", "aria-label": "Constants" },
        ...part.constants.map((each) => h("li", {}, ...apart(h("code", { class: "ros-kind-of", text: each.type }), h("code", { text: `${each.name} = ${each.value}` }), h("span", { class: "ros-muted", text: "constant" }))))) : null);
  }

  /** @param {Field[]} fields @param {string} path @returns {HTMLElement} */
  #tree(fields, path) {
    return h("ul", { class: "ros-tree" }, ...fields.map((field) => {
      const row = apart(h("code", { class: "ros-kind-of", text: field.type }), h("code", { class: "ros-field", text: field.name }),
        field.help ? h("span", { class: "ros-muted", text: field.help }) : null);
      const inner = `${path}.${field.name}`;
      return h("li", {}, ...(field.fields.length ? [this.#fold(inner, row, this.#tree(field.fields, inner))] : row));
    }));
  }

  /** Returns a section that the reader can unfold. An unfolded section does not change when the type is read
   * again.
   * @param {string} path @param {(Node |
   * string)[]} title
   * @param {...(HTMLElement | null)} inside */
  #fold(path, title, ...inside) {
    const fold = /** @type {HTMLDetailsElement} */ (h("details", { open: this.unfolded.has(path) }, h("summary", {}, ...title), ...inside));
    fold.addEventListener("toggle", () => (fold.open ? this.unfolded.add(path) : this.unfolded.delete(path)));
    return fold;
  }

  #offered() {
    const offers = this.model.get("offers") ?? {};
    return { srv: offers.srv ?? {}, msg: offers.msg ?? {} };
  }

  #drawOffers() {
    const offered = this.#offered();
    const used = Object.values(offered).map((each) => Object.keys(each));
    if (!same(used, this.used)) {
      this.used = used;
      this.#drawList();
    }
    /** @type {Described} */
    const type = this.model.get("described");
    if (!type.name) return;
    const rows = offered[type.half][type.name] ?? [];
    const what = type.half === "srv" ? "service" : "topic";
    const title = this.live ? "On the graph now" : "On the graph when this was saved";
    const none = this.model.get("trouble") && this.live ? "The graph cannot be read." : `No ${what} of this type.`;
    const parts = [h("h4", { text: title }), rows.length ? h("ul", { class: "ros-tree" }, ...rows.map(offer)) : h("p", { class: "ros-muted", text: none })];
    if (!same(parts.map((part) => part.textContent), this.told) || !this.offers.firstChild) this.offers.replaceChildren(...parts);
    this.told = parts.map((part) => part.textContent);
  }
}

/** @param {Record<string, any>} row */
function offer(row) {
  const ends = Object.entries(row).filter(([label]) => label !== "name");
  return h("li", {}, ...apart(h("code", { class: "ros-field", text: row.name }), ...ends.map(([label, nodes]) => h("span", {}, h("span", { class: "ros-muted", text: `${label} ` }),
    h("code", { text: nodes.join(", ") || "no node" })))));
}

/** Puts blanks between words, for screen readers and for copied text. @param {...(Node | null)} words @returns {(Node |
 * string)[]} */
function apart(...words) {
  return words.flatMap((word) => (word ? [word, " "] : []));
}

/** @param {string} label @param {string} text */
function line(label, text) {
  return command(label, h("pre", { "aria-label": label, tabindex: "0", text }), label);
}

export default { render };

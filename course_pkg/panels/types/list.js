/* A list of all types by package, with a search field. The arrow keys choose a type; Enter or a click opens it. */
import { freshId, h, say, setAttribute } from "../kit.js";

/** @typedef {{name: string, srv: string[], msg: string[]}} Package */
/** @typedef {{name: string, half: "srv" | "msg"}} Type */

const WORDS = { srv: ["service type", "service types"], msg: ["message type", "message types"] };

export class TypeList {
  /** @param {(type: Type) => void} picked is called with the type to open */
  constructor(picked) {
    this.picked = picked;
    /** @type {Package[]} */
    this.packages = [];
    /** @type {{type: Type, el: HTMLElement}[]} */
    this.options = [];
    /** @type {Type | null} */
    this.open = null;
    /** @type {Record<"srv" | "msg", Record<string, any>>} */
    this.offered = { srv: {}, msg: {} };
    this.active = -1;
    this.live = true;
    this.#build();
  }

  #build() {
    const [input, list] = [freshId("ros-search"), freshId("ros-types")];
    const keys = (/** @type {KeyboardEvent} */ event) => this.#key(event);
    this.search = /** @type {HTMLInputElement} */ (h("input", { id: input, type: "text", role: "combobox", autocomplete: "off", spellcheck: "false",
      "aria-autocomplete": "list", "aria-expanded": "true", "aria-controls": list, placeholder: "such as bool, or std_srvs", oninput: () => this.draw(), onkeydown: keys }));
    this.kinds = { srv: kind("services", true, () => this.draw()), msg: kind("messages", false, () => this.draw()) };
    this.count = h("p", { class: "ros-muted", role: "status" });
    this.list = h("div", { id: list, class: "ros-types-list", role: "listbox", tabindex: "0", "aria-label": "Types", "data-lm-suppress-shortcuts": "true",
      onkeydown: keys, onclick: (/** @type {Event} */ event) => this.#click(event.target) });
    this.el = h("div", { class: "ros-find" }, h("label", { for: input, text: "Find a type" }), this.search,
      h("div", { class: "ros-kinds", role: "group", "aria-label": "Which types" }, this.kinds.srv.el, this.kinds.msg.el), this.count, this.list);
  }

  /** Shows the types that match the search. */
  draw() {
    const before = this.options[this.active]?.type;
    const words = this.search.value.trim().toLowerCase().split(/\s+/);
    const halves = /** @type {("srv" | "msg")[]} */ (["srv", "msg"]);
    const found = halves.flatMap((half) => this.packages.flatMap(({ name, [half]: shorts }) => shorts.map((short) => ({ name: `${name}/${short}`, half }))))
      .filter(({ name }) => words.every((word) => name.toLowerCase().includes(word)));
    const kept = found.filter(({ half }) => this.kinds[half].input.checked);
    this.options = kept.map((type) => ({ type, el: this.#option(type) }));
    const groups = this.packages.map(({ name }) => [name, this.options.filter(({ type }) => type.name.startsWith(`${name}/`))]);
    this.list.replaceChildren(...groups.filter(([, options]) => options.length).map(([name, options]) => h("div", { role: "group", "aria-label": name },
      h("div", { class: "ros-package", "aria-hidden": "true", text: name }), ...options.map((/** @type {{el: HTMLElement}} */ { el }) => el))));
    say(this.count, this.#counted(kept, found));
    const again = (/** @type {Type | null | undefined} */ type) => this.options.findIndex((each) => alike(each.type, type));
    this.#activate(again(before) >= 0 ? again(before) : this.search.value ? 0 : again(this.open), false);
  }

  /** @param {Type | null} type */
  show(type) {
    this.open = type;
    if (type && !this.kinds[type.half].input.checked) this.kinds[type.half].input.checked = true;
    this.draw();
    this.options[this.active]?.el.scrollIntoView({ block: "nearest" });
  }

  /** @param {boolean} live */
  kernel(live) {
    this.live = live;
    this.draw();
  }

  /** @param {Type[]} kept @param {Type[]} found */
  #counted(kept, found) {
    const hidden = (/** @type {"srv" | "msg"} */ half) => found.length - kept.length > 0 && !this.kinds[half].input.checked
      ? found.filter((each) => each.half === half).length : 0;
    const more = /** @type {("srv" | "msg")[]} */ (["srv", "msg"]).filter(hidden).map((half) => `${hidden(half)} ${WORDS[half][hidden(half) === 1 ? 0 : 1]}`);
    const packages = new Set(kept.map(({ name }) => name.split("/")[0])).size;
    const some = kept.length ? `${kept.length} ${kept.length === 1 ? "type" : "types"} in ${packages} ${packages === 1 ? "package" : "packages"}` : "No type found";
    return some + (more.length && this.search.value.trim() ? `; also ${more.join(" and ")}` : "");
  }

  /** @param {Type} type */
  #option(type) {
    const used = Boolean(this.offered[type.half]?.[type.name]);
    const both = this.kinds.srv.input.checked && this.kinds.msg.input.checked;
    const open = alike(type, this.open);
    return h("div", { id: freshId("ros-type"), role: "option", class: open ? "ros-open" : null, "aria-selected": String(open), "aria-disabled": this.live || open ? null : "true",
      "data-name": type.name, "data-half": type.half }, h("code", { text: type.name.split("/")[1] }),
    both && type.half === "msg" ? h("span", { class: "ros-muted", text: "msg" }) : null, used ? h("span", { class: "ros-used", text: "in use" }) : null);
  }

  /** @param {number} index @param {boolean} scroll */
  #activate(index, scroll) {
    this.options[this.active]?.el.classList.remove("ros-active");
    this.active = this.options[index] ? index : -1;
    const option = this.options[this.active]?.el;
    option?.classList.add("ros-active");
    if (scroll) option?.scrollIntoView({ block: "nearest" });
    for (const each of [this.search, this.list]) setAttribute(each, "aria-activedescendant", option?.id);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const steps = /** @type {Record<string, number>} */ ({ ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10 });
    if (event.key in steps) this.#activate(Math.min(this.options.length - 1, Math.max(0, this.active + steps[event.key])), true);
    else if (event.key === "Enter" && this.active >= 0) this.#pick(this.options[this.active].type);
    else if (event.key === "Escape" && this.search.value) this.#clear();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #clear() {
    this.search.value = "";
    this.draw();
  }

  /** @param {EventTarget | null} target */
  #click(target) {
    const option = /** @type {HTMLElement} */ (target).closest("[role=option]");
    const index = this.options.findIndex(({ el }) => el === option);
    if (index < 0) return;
    this.#activate(index, false);
    this.#pick(this.options[index].type);
  }

  /** @param {Type} type */
  #pick(type) {
    if (this.live) this.picked(type);
  }
}

/** @param {Type | null | undefined} one @param {Type | null | undefined} other */
function alike(one, other) {
  return Boolean(one && other && one.name === other.name && one.half === other.half);
}

/** @param {string} text @param {boolean} checked @param {() => void} changed */
function kind(text, checked, changed) {
  const id = freshId("ros-kind");
  const input = /** @type {HTMLInputElement} */ (h("input", { id, type: "checkbox", checked, onchange: changed }));
  return { input, el: h("label", { for: id, class: "ros-kind" }, input, h("span", { text })) };
}

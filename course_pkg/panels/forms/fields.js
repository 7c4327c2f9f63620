/* A message as a form: controls for the fields of a type. The controls edit the draft, which is a tree of texts. */
import { afterPress, freshId, h, same, say, setAttribute } from "../kit.js";

/** @typedef {{name: string, type: string, kind: string, low?: any, high?: any, length?: number | null,
 *   help?: string, item?: Field, fields?: Field[], default?: any}} Field */
/** @typedef {{input: HTMLInputElement, note: HTMLElement, help: string, touched: boolean, error: string}} Control */

/** The form for one message. `edited` is called after every keystroke. `empty` is the text for a type without fields.
 */
export class FieldsForm {
  /** @param {() => void} edited @param {string} empty */
  constructor(edited, empty) {
    this.edited = edited;
    this.empty = empty;
    this.el = h("div", { class: "ros-fields" });
    /** @type {any} */
    this.draft = {};
    /** @type {Map<string, Control>} */
    this.controls = new Map();
    /** @type {Field[]} */
    this.fields = [];
  }

  /** Builds all controls again.
   * @param {Field[]} fields @param {{name: string, value: any}[]} constants @param {any} draft */
  show(fields, constants, draft) {
    this.fields = fields;
    this.constants = constants;
    this.#build(draft);
  }

  /** Writes a draft into the form. If only texts differ, the controls are not replaced. @param {any} draft */
  fill(draft) {
    if (same(draft, this.draft)) return;
    if (!same(shape(draft), shape(this.draft))) return this.#build(draft);
    this.draft = structuredClone(draft);
    for (const [path, control] of this.controls) write(control.input, read(this.draft, path));
  }

  /** Shows the errors: at all fields if `all` is true, and otherwise at fields that the student has already left.
   * @param {Record<string, string>} errors @param {boolean} all */
  mark(errors, all) {
    for (const [path, control] of this.controls) {
      control.error = errors[path] ?? "";
      control.touched ||= all;
      this.#draw(control);
    }
  }

  /** Moves the keyboard focus to the first field with an error, or to the first field. */
  focus() {
    const controls = [...this.controls.values()];
    (controls.find((control) => control.error) ?? controls[0])?.input.focus();
  }

  /** @param {any} draft */
  #build(draft) {
    this.draft = structuredClone(draft);
    this.controls.clear();
    this.el.replaceChildren(
      ...this.fields.map((field) => this.#field(field, field.name, field.name)),
      ...(this.constants?.length ? [this.#constants()] : []),
      ...(this.fields.length ? [] : [h("p", { class: "ros-muted", text: this.empty })]),
    );
  }

  /** @param {Field} field @param {string} path @param {string} label @returns {HTMLElement} */
  #field(field, path, label) {
    if (field.kind === "array" && typeof read(this.draft, path) !== "string") return this.#array(field, path, label);
    if (field.kind === "message") return this.#group(field, path, label);
    return this.#line(field, path, label);
  }

  /** @param {Field} field @param {string} path @param {string} label */
  #group(field, path, label) {
    return h("fieldset", { class: "ros-group" }, legend(label, field.type), help(field),
      ...(field.fields ?? []).map((inner) => this.#field(inner, `${path}.${inner.name}`, inner.name)));
  }

  /** @param {Field} field @param {string} path @param {string} label */
  #line(field, path, label) {
    const id = freshId("ros-field");
    const note = h("span", { id: `${id}-note`, class: "ros-note" });
    const boolean = field.kind === "bool";
    const choices = this.#choices(field);
    const input = /** @type {HTMLInputElement} */ (h("input", {
      id, type: boolean ? "checkbox" : "text", class: boolean ? "" : "ros-text", autocomplete: "off", autocapitalize: "off",
      spellcheck: "false", "aria-describedby": `${id}-type ${id}-note`, "data-path": path, list: choices?.id,
      inputmode: field.kind === "integer" || field.kind === "float" ? "decimal" : null,
    }));
    const control = { input, note, help: hint(field), touched: false, error: "" };
    write(input, read(this.draft, path));
    input.addEventListener("input", () => this.#set(path, boolean ? (input.checked ? "true" : "false") : input.value));
    input.addEventListener("blur", () => afterPress(input, () => {
      control.touched = true;
      this.#draw(control);
    }));
    this.controls.set(path, control);
    this.#draw(control);
    return h("div", { class: "ros-line" },
      h("label", { for: id }, h("span", { text: label }), h("span", { id: `${id}-type`, class: "ros-muted", text: field.type })),
      h("div", { class: "ros-entry" }, input, field.kind === "time" ? this.#now(path, control) : null, choices), note);
  }

  /** @param {string} path @param {Control} control */
  #now(path, control) {
    return h("button", { type: "button", class: "ros-quiet", text: "Now", "aria-label": `Set ${path} to the time now`, onclick: () => {
      const text = (Date.now() / 1000).toFixed(3);
      control.input.value = text;
      this.#set(path, text);
    } });
  }

  /** @param {Field} field @param {string} path @param {string} label */
  #array(field, path, label) {
    const item = /** @type {Field} */ (field.item);
    const texts = read(this.draft, path);
    const fixed = field.length !== null && field.length !== undefined;
    const elements = texts.map((/** @type {any} */ _, /** @type {number} */ index) => h("li", {},
      this.#field(item, `${path}[${index}]`, `[${index}]`), fixed ? null : this.#remove(path, index)));
    const count = `${texts.length} ${texts.length === 1 ? "element" : "elements"}`;
    return h("fieldset", { class: "ros-group" }, legend(label, `${field.type} · ${fixed ? "always " : ""}${count}`), help(field),
      h("ol", { class: item.kind === "message" ? "ros-tall" : "ros-flat" }, ...elements),
      fixed ? null : h("button", { type: "button", class: "ros-quiet", text: "Add element", "aria-label": `Add element to ${path}`,
        "data-add": path, onclick: () => this.#resize(path, [...texts, blank(item)], texts.length) }));
  }

  /** @param {string} path @param {number} index */
  #remove(path, index) {
    return h("button", { type: "button", class: "ros-quiet", text: "×", title: "Remove", "aria-label": `Remove ${path}[${index}]`,
      onclick: () => this.#resize(path, read(this.draft, path).toSpliced(index, 1), index - 1) });
  }

  /** @param {string} path @param {any[]} texts @param {number} index of the element that gets the keyboard focus */
  #resize(path, texts, index) {
    const draft = structuredClone(this.draft);
    put(draft, path, texts);
    this.#build(draft);
    const inputs = [...this.controls].filter(([key]) => key === `${path}[${index}]` || key.startsWith(`${path}[${index}].`));
    (inputs[0]?.[1].input ?? /** @type {HTMLElement} */ (this.el.querySelector(`[data-add="${path}"]`)))?.focus();
    this.edited();
  }

  /** @param {string} path @param {string} text */
  #set(path, text) {
    put(this.draft, path, text);
    this.edited();
  }

  /** @param {Control} control */
  #draw(control) {
    const wrong = control.touched && control.error !== "";
    setAttribute(control.input, "aria-invalid", wrong ? "true" : null);
    control.note.classList.toggle("ros-wrong", wrong);
    say(control.note, wrong ? control.error : control.help);
  }

  /** Returns a list of the constants that have the type of a field. @param {Field} field */
  #choices(field) {
    const fitting = (this.constants ?? []).filter((constant) => constant.type === field.type);
    if (!fitting.length) return null;
    return h("datalist", { id: freshId("ros-choices") },
      ...fitting.map((constant) => h("option", { value: constant.value, label: constant.name })));
  }

  #constants() {
    const list = this.constants ?? [];
    return h("p", { class: "ros-muted" }, "Constants: ",
      h("code", { text: list.map((constant) => `${constant.name} = ${constant.value}`).join(", ") }));
  }
}

/** @param {string} label @param {string} type */
function legend(label, type) {
  return h("legend", {}, label, " ", h("span", { class: "ros-muted", text: type }));
}

/** @param {Field} field */
function help(field) {
  return field.help ? h("p", { class: "ros-muted", text: field.help }) : null;
}

/** @param {Field} field */
function hint(field) {
  const small = field.kind === "integer" && !/64|32/.test(field.type);
  return [small ? `${field.low} to ${field.high}` : "", field.help ?? ""].filter(Boolean).join(" · ");
}

/** Returns the default texts of a new element. @param {Field} field @returns {any} */
function blank(field) {
  if (field.kind === "array") return Array.from({ length: field.length ?? 0 }, () => blank(/** @type {Field} */ (field.item)));
  if (field.kind === "message") return Object.fromEntries((field.fields ?? []).map((part) => [part.name, blank(part)]));
  return typeof field.default === "string" ? field.default : "0"; // The student types a time in seconds.
}

/** @param {HTMLInputElement} input @param {string} text */
function write(input, text) {
  if (input.type === "checkbox") input.checked = /^(true|1)$/i.test(text);
  else if (input.value !== text) input.value = text;
}

/** Splits a path such as "points[2].x" into its keys. @param {string} path */
const keys = (path) => path.match(/[^.[\]]+/g) ?? [];

/** @param {any} tree @param {string} path @returns {any} */
const read = (tree, path) => keys(path).reduce((branch, key) => branch?.[key], tree);

/** @param {any} tree @param {string} path @param {any} value */
function put(tree, path, value) {
  const steps = keys(path);
  const last = /** @type {string} */ (steps.pop());
  steps.reduce((branch, key) => branch[key], tree)[last] = value;
}

/** Returns a copy of the tree in which all texts are empty. Drafts with the same result need the same
 * controls.
 * @param {any} tree @returns {any} */
function shape(tree) {
  if (Array.isArray(tree)) return tree.map(shape);
  if (tree && typeof tree === "object") return Object.fromEntries(Object.entries(tree).map(([key, value]) => [key, shape(value)]));
  return "";
}

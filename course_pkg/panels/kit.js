/* What the front ends of all panels share. */

/** @typedef {{get(name: string): any, set(name: string, value: any): void, save_changes(): void,
 *   on(name: string, callback: Function): void, send(content: object): void}} Model */

let made = 0;

/** An id that no other element of the page has. @param {string} stem @returns {string} */
export function freshId(stem) {
  made += 1;
  return `${stem}-${made}-${Math.random().toString(36).slice(2, 8)}`;
}

/**
 * Make an element. Keys of `props` that start with "on" listen; `text` is its text; the rest are attributes, where
 * false, null and undefined leave the attribute out.
 * @param {string} tag @param {Record<string, any>} [props] @param {...(Node | string | null)} children
 * @returns {HTMLElement}
 */
export function h(tag, props = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(props)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "text") element.textContent = value;
    else setAttribute(element, key, value);
  }
  // JupyterLab takes keys such as Enter and the arrows for the notebook unless a control asks it not to.
  if (["button", "select", "summary"].includes(tag) || /^(checkbox|radio)$/.test(props.type ?? ""))
    element.setAttribute("data-lm-suppress-shortcuts", "true");
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** @param {Element} element @param {string} name @param {any} value */
export function setAttribute(element, name, value) {
  if (value === false || value === null || value === undefined) element.removeAttribute(name);
  else element.setAttribute(name, value === true ? "" : String(value));
}

/** Set text only where it differs, so that a selection and a live region stay undisturbed.
 * @param {Element} element @param {string} text */
export function say(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Do what may move the page when no press is under way: a button that moved under the pointer hears no click.
 * @param {Element} element @param {() => void} work */
export function afterPress(element, work) {
  if (!element.matches(":root:active *")) return work();
  addEventListener("mouseup", () => setTimeout(work), { once: true, capture: true }); // the click comes between
}

/** Text in which `words` between backticks are code. @param {string} text @returns {(Node | string)[]} */
export function prose(text) {
  return text.split("`").map((part, index) => (index % 2 ? h("code", { text: part }) : part));
}

/** A number as one reads it aloud: up to `digits` significant digits, no exponent between 0.0001 and a million.
 * @param {number} value @param {number} [digits] @returns {string} */
export function numeral(value, digits = 4) {
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e6)) return power(value, digits - 1);
  return String(size >= 10 ** digits ? Math.round(value) : Number(value.toPrecision(digits)));
}

/** 2.5e-7. @param {number} value @param {number} decimals @returns {string} */
export function power(value, decimals) {
  return value === 0 ? "0" : value.toExponential(decimals).replace(/\.?0*e\+?/, "e");
}

/** @param {any} one @param {any} other @returns {boolean} */
export function same(one, other) {
  return JSON.stringify(one) === JSON.stringify(other);
}

/** A button that copies what `read` returns and says so. @param {string} label @param {() => string} read
 * @returns {HTMLElement} */
export function copyButton(label, read) {
  const button = h("button", { type: "button", class: "ros-quiet", "aria-label": `Copy ${label}`, text: "Copy" });
  button.addEventListener("click", async () => {
    const done = await copied(read());
    say(button, done ? "Copied" : "Ctrl+C");
    setTimeout(() => say(button, "Copy"), 1500);
  });
  return button;
}

/** @param {string} text @returns {Promise<boolean>} */
async function copied(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return copiedBySelection(text); // no clipboard without https or localhost
  }
}

/** @param {string} text @returns {boolean} */
function copiedBySelection(text) {
  const focused = /** @type {HTMLElement | null} */ (document.activeElement);
  const area = document.createElement("textarea");
  area.value = text;
  area.style.position = "fixed";
  document.body.append(area);
  area.select();
  const done = document.execCommand("copy");
  area.remove();
  focused?.focus();
  return done;
}

/** Send a message; false when there is nobody to send it to. @param {Model} model @param {object} content */
export function send(model, content) {
  try {
    model.send(content);
    return true;
  } catch {
    return false; // the kernel was shut down, and its connection with it
  }
}

const PATIENCE = 1500; // ms; an idle kernel answers within 50
const HEARTBEAT = 4000; // ms

/**
 * The way to the kernel. A saved page has none, and nothing but silence tells: `changed(live)` hears false when a
 * greeting is not answered in time, and true whenever one is.
 * @param {Model} model @param {AbortSignal} signal @param {(live: boolean) => void} changed
 */
export function kernelLink(model, signal, changed) {
  const view = freshId("view");
  let timer = 0;
  let heart = 0;
  let open = true;
  // JupyterLab says nothing when a kernel is shut down, but from then on it cannot send. A busy kernel is no dead one:
  // here only a message that cannot be sent counts.
  const beat = () => {
    if (!send(model, { kind: "here" })) lose();
  };
  const lose = () => {
    clearInterval(heart);
    changed(false);
  };
  const greet = () => {
    clearTimeout(timer);
    if (send(model, { kind: "hello", view })) timer = setTimeout(lose, PATIENCE);
    else lose();
  };
  const leave = () => {
    clearTimeout(timer);
    clearInterval(heart);
    if (open) send(model, { kind: "bye", view });
    open = false;
  };
  model.on("msg:custom", (/** @type {{kind: string}} */ content) => {
    if (content.kind !== "hello") return;
    clearTimeout(timer);
    clearInterval(heart);
    heart = setInterval(beat, HEARTBEAT);
    changed(true);
  });
  model.on("comm_live_update", greet); // the kernel restarted or went away
  window.addEventListener("pagehide", leave, { signal });
  signal.addEventListener("abort", leave);
  greet();
}

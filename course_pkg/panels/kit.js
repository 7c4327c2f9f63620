/* Functions that the front ends of all panels share. */

/** @typedef {{get(name: string): any, set(name: string, value: any): void, save_changes(): void,
 *   on(name: string, callback: Function): void, send(content: object): void}} Model */

let made = 0;

/** Returns an id that no other element of the page has. @param {string} stem @returns {string} */
export function freshId(stem) {
  made += 1;
  return `${stem}-${made}-${Math.random().toString(36).slice(2, 8)}`;
}

/**
  * Makes an element. A key of `props` that starts with "on" adds an event listener, and `text` sets the text. Every
 * other key is an attribute, which is left out if its value is false, null or undefined.
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
  // JupyterLab uses keys such as Enter and the arrow keys itself, unless the control has this attribute.
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

/** Sets the text only if it differs. Otherwise, a selection would be lost, and a screen reader would read the text again.
 * @param {Element} element @param {string} text */
export function say(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Runs a function, which may move parts of the page, as soon as no mouse button is pressed on the element.
 * If a button moved away during a press, the browser would not report the click.
 * @param {Element} element @param {() => void} work */
export function afterPress(element, work) {
  if (!element.matches(":root:active *")) return work();
  addEventListener("mouseup", () => setTimeout(work), { once: true, capture: true }); // The browser reports the click before the timeout.
}

/** Returns a text as nodes; the parts between backticks are code. @param {string} text @returns {(Node | string)[]} */
export function prose(text) {
  return text.split("`").map((part, index) => (index % 2 ? h("code", { text: part }) : part));
}

/** Returns a number as text: rounded to the given number of significant digits or to a whole number, and
 * without an exponent between 0.0001 and a million.
 * @param {number} value @param {number} [digits] @returns {string} */
export function numeral(value, digits = 4) {
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e6)) return power(value, digits - 1);
  return String(size >= 10 ** digits ? Math.round(value) : Number(value.toPrecision(digits)));
}

/** Returns a number with an exponent, such as "2.5e-7".
 * @param {number} value @param {number} decimals @returns {string} */
export function power(value, decimals) {
  return value === 0 ? "0" : value.toExponential(decimals).replace(/\.?0*e\+?/, "e");
}

/** @param {any} one @param {any} other @returns {boolean} */
export function same(one, other) {
  return JSON.stringify(one) === JSON.stringify(other);
}

/** Returns a button that copies the text that `read` returns, and then shows "Copied".
 * @param {string} label @param {() =>
 * string} read
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
    return copiedBySelection(text); // Browsers offer the clipboard only with https or on localhost.
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

/** Sends a message to the kernel. Returns false if the message cannot be sent. @param {Model} model @param {object} content */
export function send(model, content) {
  try {
    model.send(content);
    return true;
  } catch {
    return false; // The kernel was shut down, and its connection was closed.
  }
}

const ANSWER_TIMEOUT = 1500; // The kernel must answer within this many ms; an idle kernel needs 50 ms.
const HEARTBEAT = 4000; // ms

/**
  * The connection to the kernel. A saved page has no kernel, and no event reports this. So the page sends a greeting.
 * `changed(false)` is called if no answer comes in time, and `changed(true)` after each answer.
 * @param {Model} model @param {AbortSignal} signal @param {(live: boolean) => void} changed
 */
export function kernelLink(model, signal, changed) {
  const view = freshId("view");
  let timer = 0;
  let heart = 0;
  let open = true;
  // JupyterLab sends no event when a kernel is shut down, but after a shutdown no message can be sent. A busy
  // kernel answers late. So this code treats the kernel as lost only if a message cannot be sent.
  const beat = () => {
    if (!send(model, { kind: "here" })) lose();
  };
  const lose = () => {
    clearInterval(heart);
    changed(false);
  };
  const greet = () => {
    clearTimeout(timer);
    if (send(model, { kind: "hello", view })) timer = setTimeout(lose, ANSWER_TIMEOUT);
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
  model.on("comm_live_update", greet); // The kernel was restarted, or its connection was lost.
  window.addEventListener("pagehide", leave, { signal });
  signal.addEventListener("abort", leave);
  greet();
}

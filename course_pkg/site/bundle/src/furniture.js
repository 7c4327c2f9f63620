/* Adds the parts of a page that need a script: links at headings, copy buttons, and scrolling by keyboard. */

export function linkHeadings() {
  for (const heading of document.querySelectorAll("article :is(h2, h3, h4)[id]")) {
    const link = document.createElement("a");
    link.className = "anchor";
    link.href = `#${heading.id}`;
    link.textContent = "#";
    link.setAttribute("aria-label", `Link to “${heading.textContent}”`);
    heading.append(" ", link);
  }
}

export function copyButtons() {
  for (const code of document.querySelectorAll("pre.in, pre.code")) {
    const text = code.textContent ?? "";
    const button = document.createElement("button");
    button.type = "button";
    button.className = "copy";
    button.textContent = "Copy";
    button.setAttribute("aria-label", "Copy this code");
    button.addEventListener("click", async () => {
      button.textContent = (await copied(text, button)) ? "Copied" : "Ctrl+C";
      setTimeout(() => {
        button.textContent = "Copy";
      }, 1500);
    });
    const frame = document.createElement("div");
    frame.className = "copied";
    code.replaceWith(frame);
    frame.append(code, button);
  }
}

async function copied(text, button) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return bySelection(text, button); // A page from a local folder, or a page without https, cannot use the clipboard.
  }
}

function bySelection(text, button) {
  const area = document.createElement("textarea");
  area.value = text;
  area.className = "aside";
  document.body.append(area);
  area.select();
  const done = document.execCommand("copy");
  area.remove();
  button.focus();
  return done;
}

const STOPS = "a[href], button, input, select, textarea, summary, [tabindex]";

/** Make each box with overflowing content reachable by keyboard, and give it a name, so that a reader can scroll it. */
export function scrollable() {
  const names = new Map();
  const watched = new ResizeObserver((entries) => entries.forEach(({ target }) => reach(target, names.get(target))));
  for (const box of document.querySelectorAll("article pre, .wide, .ros-panel *")) {
    if (box.closest(".ros-panel") && !/auto|scroll/.test(getComputedStyle(box).overflow)) continue;
    if (box.closest('[aria-hidden="true"]')) continue; // Another element describes the same content.
    if (box.matches(STOPS) || box.querySelector(STOPS)) continue; // The keyboard already reaches this box.
    names.set(box, `${kindOf(box)} ${names.size + 1}`); // Each region needs a different name.
    watched.observe(box);
  }
}

function reach(box, label) {
  const over = box.scrollWidth > box.clientWidth || box.scrollHeight > box.clientHeight;
  for (const [name, value] of [["tabindex", "0"], ["role", "region"], ["aria-label", label]]) {
    if (over) box.setAttribute(name, value);
    else box.removeAttribute(name);
  }
}

function kindOf(box) {
  if (box.closest(".ros-panel")) return "Part of a panel";
  return box.matches(".in") ? "Code" : box.matches(".out") ? "Output" : box.matches("pre") ? "Example" : "Table";
}

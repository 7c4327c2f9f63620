/* What the parts of panels are called, where a page asks for more than a notebook does. */

export function nameParts() {
  tellApart();
  beginWithWhatIsSeen();
  for (const empty of document.querySelectorAll(".ros-panel th:empty")) empty.replaceWith(document.createElement("td"));
}

/** A notebook may show two panels of a kind; on a page each part that can be jumped to has a name of its own. */
function tellApart() {
  const seen = new Map();
  for (const part of document.querySelectorAll(".ros-panel[aria-label], .ros-panel :is(section, form, [role=region])[aria-label]")) {
    const name = part.getAttribute("aria-label");
    const number = (seen.get(name) ?? 0) + 1;
    seen.set(name, number);
    if (number > 1) part.setAttribute("aria-label", `${name} ${number}`);
  }
}

/** Whoever speaks to a computer says what is written on a button, so its name has to hold that. */
function beginWithWhatIsSeen() {
  for (const button of document.querySelectorAll(".ros-panel :is(button, [role=button])[aria-label]")) {
    const texts = button.matches("button") ? [button] : [...button.querySelectorAll("text")];
    for (const text of texts.slice(1)) text.before(" "); // or its words and those before it are one
    const seen = texts.map((text) => text.textContent.trim()).filter(Boolean).join(" ");
    const name = button.getAttribute("aria-label");
    if (/\w/.test(seen) && !name.toLowerCase().includes(seen.toLowerCase())) button.setAttribute("aria-label", `${seen}: ${name}`);
  }
}

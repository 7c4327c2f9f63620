/* What the parts of panels are called, where a page asks for more than a notebook does. */

/** A notebook may show two panels of a kind; on a page each part that can be jumped to has a name of its own. */
export function nameParts() {
  const seen = new Map();
  for (const part of document.querySelectorAll(".ros-panel[aria-label], .ros-panel :is(section, form, [role=region])[aria-label]")) {
    const name = part.getAttribute("aria-label");
    const number = (seen.get(name) ?? 0) + 1;
    seen.set(name, number);
    if (number > 1) part.setAttribute("aria-label", `${name} ${number}`);
  }
}

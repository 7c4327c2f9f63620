/* Gives the parts of panels unique names. */

/** Add a number to a name that occurs again. A notebook may show two panels of the same type, but the
    landmarks of a page need unique names. */
export function nameParts() {
  const seen = new Map();
  for (const part of document.querySelectorAll(".ros-panel[aria-label], .ros-panel :is(section, form, [role=region])[aria-label]")) {
    const name = part.getAttribute("aria-label");
    const number = (seen.get(name) ?? 0) + 1;
    seen.set(name, number);
    if (number > 1) part.setAttribute("aria-label", `${name} ${number}`);
  }
}

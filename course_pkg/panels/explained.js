/* The explanation that a panel shows below its own error: the cause, and a remedy. */
import { h, prose, setAttribute } from "./kit.js";

/** @typedef {(context: {model: import("./kit.js").Model, el: HTMLElement, signal?: AbortSignal}) => any} Render */

/** Returns a render function that also adds the explanation to the panel. @param {Render} render @returns {Render} */
export function framed(render) {
  return (context) => {
    const end = render(context);
    const panel = context.el.querySelector(".ros-panel");
    if (panel) placeMeaning(panel, context.model);
    return end;
  };
}

/** Puts the explanation below the panel's error or banner, or else at the end of the panel.
 * @param {Element} panel @param {import("./kit.js").Model} model */
function placeMeaning(panel, model) {
  const body = h("div", { class: "ros-meaning" });
  const el = h("details", { class: "ros-explained", hidden: true }, h("summary", { text: "What this error means" }), body);
  const place = panel.querySelector(":scope > .ros-trouble") ?? panel.querySelector(":scope > .ros-banner");
  if (place) place.after(el);
  else panel.append(el);
  const draw = () => {
    const { cause, remedy, taught } = model.get("explained") ?? {};
    setAttribute(el, "hidden", !cause);
    body.replaceChildren(...(cause ? [meaningLine("Cause: ", cause), meaningLine("What to do: ", remedy), ...(taught ? [meaningLine("Taught in: ", taught)] : [])] : []));
  };
  model.on("change:explained", draw);
  draw();
}

/** @param {string} name @param {string} text */
function meaningLine(name, text) {
  return h("p", {}, h("b", { text: name }), ...prose(text));
}

/* What every panel offers below an error of its own: what it means, and what to do about it. */
import { h, prose, setAttribute } from "./kit.js";

/** @typedef {(context: {model: import("./kit.js").Model, el: HTMLElement, signal?: AbortSignal}) => any} Render */

/** Have a panel drawn with that. @param {Render} render @returns {Render} */
export function framed(render) {
  return (context) => {
    const end = render(context);
    const panel = context.el.querySelector(".ros-panel");
    if (panel) placeMeaning(panel, context.model);
    return end;
  };
}

/** Below the place for errors, or the banner, where there is one. @param {Element} panel @param {import("./kit.js").Model} model */
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

/* Draws every panel of the page from the state that it was saved with. There is no kernel, and the panels are told so:
   whatever they send cannot be sent. */

export function drawPanels() {
  const fronts = globalThis.coursePanels ?? {};
  for (const place of document.querySelectorAll("[data-panel]")) draw(place, fronts[place.dataset.panel ?? ""]);
}

function draw(place, front) {
  const state = JSON.parse(place.querySelector("script").textContent);
  const words = place.querySelector("p");
  if (!front) {
    words.textContent = "This page cannot draw the panel that stands here.";
    return;
  }
  place.replaceChildren();
  front.render({ model: saved(state), el: place });
}

/** A model of a widget, as far as the panels use one. */
function saved(state) {
  return {
    get: (name) => state[name],
    set: (name, value) => {
      state[name] = value;
    },
    save_changes() {},
    on() {},
    off() {},
    send() {
      throw new Error("no kernel");
    },
  };
}

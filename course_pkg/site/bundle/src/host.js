/* Draws every panel of the page from the state that it was saved with. There is no kernel, and the panels are told so:
   whatever they send cannot be sent. */

import { nameParts } from "./names.js";

export async function drawPanels() {
  const book = document.body.matches(".book"); // nobody sees it before it is printed, and no frame comes
  for (const packed of document.querySelectorAll("script.states")) {
    const places = packed.parentElement.querySelectorAll("[data-panel]");
    const states = await unpacked(packed.textContent);
    for (const [index, place] of places.entries()) {
      draw(place, states[index]);
      if (!book) await painted(); // each is seen as soon as it is there, and the reader can go on between two
    }
  }
  nameParts();
  toAnchor();
}

/** Go where the address says: what was drawn has moved what is below it. */
export function toAnchor() {
  if (location.hash) document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView({ behavior: "instant" });
}

const NO_FRAMES = 200; // ms; a window that nobody sees is not painted

function painted() {
  return new Promise((resume) => {
    requestAnimationFrame(() => setTimeout(resume));
    setTimeout(resume, NO_FRAMES);
  });
}

/** The states of a page are a third of it, and less than a tenth when they are packed. @param {string} text base64 */
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).json();
}

function draw(place, state) {
  try {
    globalThis.coursePanels[place.dataset.panel].render({ model: saved(state), el: place });
  } catch (error) {
    place.textContent = "This panel could not be drawn.";
    console.error(error); // a panel less must not take the page along
  }
}

/** A model of a widget, as far as the panels use one. */
function saved(state) {
  return {
    get: (name) => state[name],
    set: (name, value) => {
      state[name] = value;
    },
    save_changes() {},
    on() {}, // nothing changes by itself
    off() {},
    send() {
      throw new Error("no kernel");
    },
  };
}

/* Draws every panel of the page from its saved state. There is no kernel, so each `send` of a panel throws an error. */

import { nameParts } from "./names.js";

export async function drawPanels() {
  const book = document.body.matches(".book"); // The book is printed without a window, so it gets no animation frames.
  for (const packed of document.querySelectorAll("script.states")) {
    const places = packed.parentElement.querySelectorAll("[data-panel]");
    const states = await unpacked(packed.textContent);
    for (const [index, place] of places.entries()) {
      draw(place, states[index]);
      if (!book) await painted(); // The browser shows each panel at once, and handles input before the next panel.
    }
  }
  nameParts();
  toAnchor();
}

/** Scroll to the anchor of the address again, because the drawn panels have moved the text below them. */
export function toAnchor() {
  if (location.hash) document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView({ behavior: "instant" });
}

const NO_FRAMES = 200; // the longest wait for a frame in ms, because a hidden window gets no frames

function painted() {
  return new Promise((resume) => {
    requestAnimationFrame(() => setTimeout(resume));
    setTimeout(resume, NO_FRAMES);
  });
}

/** Return the decompressed states. Without compression, the states would be a third of a page's size; with
 * compression, they are less than a tenth.
 * @param {string} text base64 */
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).json();
}

function draw(place, state) {
  try {
    globalThis.coursePanels[place.dataset.panel].render({ model: saved(state), el: place });
  } catch (error) {
    place.textContent = "This panel could not be drawn.";
    console.error(error); // An error in one panel must not stop the other parts of the page.
  }
}

/** Return a replacement for the model of a widget, with the methods that the panels use. */
function saved(state) {
  return {
    get: (name) => state[name],
    set: (name, value) => {
      state[name] = value;
    },
    save_changes() {},
    on() {}, // Without a kernel, no value changes by itself.
    off() {},
    send() {
      throw new Error("no kernel");
    },
  };
}

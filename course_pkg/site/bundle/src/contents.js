/* Marks the current section in the table of contents: the section at the top of the window. */

const NARROW = matchMedia("(max-width: 52rem)"); // In a window of this width, site.css shows the lists above the text.

/** Close the lists in a narrow window, because open lists would push the text out of the window. */
export function foldLists() {
  const fold = () => document.querySelectorAll(":is(.chapters, .contents) details").forEach((list) => {
    list.open = !NARROW.matches;
  });
  NARROW.addEventListener("change", fold);
  fold();
}

export function followContents() {
  const links = [...document.querySelectorAll(".contents a")];
  const sections = links.map((link) => document.getElementById(decodeURIComponent(link.hash.slice(1))));
  if (!links.length) return;
  const mark = () => {
    const passed = sections.findLastIndex((section) => section && section.getBoundingClientRect().top < innerHeight / 4);
    links.forEach((link, index) => {
      if (index === passed) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    });
    reveal(links[passed]);
  };
  let waiting = false;
  addEventListener("scroll", () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      mark();
    });
  }, { passive: true });
  mark();
}

/** Scroll the list so that the current link is visible, if the list is longer than the window. */
function reveal(link) {
  const list = link?.closest(".contents");
  if (!list || list.scrollHeight <= list.clientHeight) return;
  const { top, bottom } = link.getBoundingClientRect();
  const box = list.getBoundingClientRect();
  if (top < box.top) list.scrollTop -= box.top - top + 24;
  else if (bottom > box.bottom) list.scrollTop += bottom - box.bottom + 24;
}

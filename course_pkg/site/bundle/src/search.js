/* Searches all sections of the course. The texts are in a separate script that loads when a search begins,
   because a page from a local folder can load a script, but cannot fetch a file. */
import MiniSearch from "minisearch";

const MOST = 30; // maximum number of results
const AROUND = 70; // number of letters that are shown before and after the found word
const nonce = document.currentScript?.nonce ?? "";
const here = document.currentScript?.src ?? "";

export function search() {
  const dialog = document.querySelector("dialog.search");
  const input = dialog.querySelector("input");
  const results = dialog.querySelector("ol");
  const status = dialog.querySelector("[role=status]");
  const finder = new Finder();
  const open = async () => {
    dialog.showModal();
    input.select();
    await finder.load();
    show();
  };
  const show = () => {
    const words = input.value.trim();
    const found = words ? finder.find(words) : [];
    status.textContent = !words ? `${finder.size} sections. Type a word, such as “timeout”.` : found.length ? `${found.length}${found.length === MOST ? " or more" : ""} found` : `No section contains “${words}”.`;
    results.replaceChildren(...found.map((each) => item(each, () => dialog.close())));
  };
  for (const button of document.querySelectorAll("button.search")) {
    button.hidden = false;
    button.addEventListener("click", open);
  }
  addEventListener("keydown", (event) => {
    const typing = event.target instanceof Element && event.target.closest("input, textarea, select, [contenteditable]");
    if ((event.key === "/" && !typing && !event.ctrlKey && !event.metaKey) || (event.key === "k" && (event.ctrlKey || event.metaKey))) {
      event.preventDefault();
      if (!dialog.open) open();
    }
  });
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  dialog.addEventListener("keydown", (event) => walk(event, dialog, input, results));
  dialog.querySelector("button").addEventListener("click", () => dialog.close());
  input.addEventListener("input", () => finder.size && show());
}

/** Move through the field and the results with the up and down keys. Escape closes the dialog at once,
    because by default, Escape would only clear the search field. */
function walk(event, dialog, input, results) {
  if (event.key === "Escape") {
    event.preventDefault();
    dialog.close();
  }
  const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
  if (!step) return;
  const stops = [input, ...results.querySelectorAll("a")];
  event.preventDefault();
  stops[Math.min(Math.max(stops.indexOf(document.activeElement) + step, 0), stops.length - 1)].focus();
}

class Finder {
  size = 0;

  async load() {
    this.loading ??= loadTexts().then((texts) => this.#index(texts));
    await this.loading;
  }

  #index(texts) {
    this.texts = texts;
    this.index = new MiniSearch({
      fields: ["title", "text"],
      idField: "id",
      searchOptions: { boost: { title: 4 }, prefix: (term) => term.length > 1, fuzzy: (term) => (term.length > 4 ? 0.2 : 0), combineWith: "AND" },
    });
    this.index.addAll(texts.map(([page, url, title, text], id) => ({ id, title: `${title} ${page}`, text })));
    this.size = texts.length;
  }

  find(words) {
    return this.index.search(words).slice(0, MOST).map(({ id, terms }) => {
      const [page, url, title, text] = this.texts[id];
      return { page, url, title, excerpt: excerpt(text, terms) };
    });
  }
}

function loadTexts() {
  return new Promise((resolve) => {
    globalThis.courseTexts = resolve;
    const script = document.createElement("script");
    script.src = new URL("texts.js", here).href;
    script.nonce = nonce;
    document.head.append(script);
  });
}

/** Return the text around the first search term that occurs, as [text before, term, text after]. */
function excerpt(text, terms) {
  const low = text.toLowerCase();
  const places = terms.map((term) => [low.indexOf(term), term.length]).filter(([at]) => at >= 0);
  if (!places.length) return [cut(text, 2 * AROUND), "", ""];
  const [at, length] = places.sort(([one], [other]) => one - other)[0];
  const from = at > AROUND ? text.indexOf(" ", at - AROUND) + 1 : 0;
  return [(from ? "…" : "") + text.slice(Math.min(from, at), at), text.slice(at, at + length), cut(text.slice(at + length), AROUND)];
}

function cut(text, length) {
  return text.length > length ? `${text.slice(0, text.lastIndexOf(" ", length))}…` : text;
}

function item({ page, url, title, excerpt: [before, word, after] }, chosen) {
  const link = document.createElement("a");
  link.href = url;
  link.addEventListener("click", chosen);
  link.append(part("strong", title), part("span", page), part("p", before));
  link.lastChild.append(part("mark", word), after);
  const entry = document.createElement("li");
  entry.append(link);
  return entry;
}

function part(tag, text) {
  const element = document.createElement(tag);
  element.textContent = text;
  return element;
}

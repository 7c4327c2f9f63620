/* Starts all scripts of a page. The panels come first, because the reader waits for them. */
import { foldLists, followContents } from "./contents.js";
import { copyButtons, linkHeadings, scrollable } from "./furniture.js";
import { drawPanels, toAnchor } from "./host.js";
import { letters } from "./letters.js";
import { search } from "./search.js";
import { themeButton } from "./theme.js";

foldLists();
const drawn = drawPanels();
if (document.querySelector("dialog.search")) search();
if (document.querySelector("button.theme")) themeButton(document.querySelector("button.theme"));
drawn.then(() => {
  linkHeadings();
  copyButtons();
  scrollable();
  followContents();
  letters().then(toAnchor); // The panels and the new fonts have moved the text below them.
});

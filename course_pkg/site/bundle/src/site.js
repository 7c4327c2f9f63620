/* Begins what a page does, the panels first: they are what the reader waits for. */
import { foldLists, followContents } from "./contents.js";
import { copyButtons, linkHeadings, scrollable } from "./furniture.js";
import { drawPanels } from "./host.js";
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
});

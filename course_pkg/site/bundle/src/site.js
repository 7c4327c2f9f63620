/* Begins what a page does, the panels first: they are what the reader waits for. */
import { followContents } from "./contents.js";
import { copyButtons, linkHeadings, scrollable } from "./furniture.js";
import { drawPanels } from "./host.js";
import { search } from "./search.js";
import { themeButton } from "./theme.js";

drawPanels();
search();
themeButton(document.querySelector("button.theme"));
linkHeadings();
copyButtons();
scrollable();
followContents();

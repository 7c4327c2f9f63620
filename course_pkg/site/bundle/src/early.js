/* Before anything is drawn: the colours that the reader chose on an earlier page. */
import { chosen, show } from "./theme.js";

show(chosen());

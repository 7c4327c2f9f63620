/* Sets the colours that the reader chose on an earlier page. This script runs before the browser draws the
   page. */
import { chosen, show } from "./theme.js";

show(chosen());

/* Loads the course's fonts. They are as large as all other parts of a page together, so the first panel is drawn before
   they load. */

/** Use the fonts, and resolve when they are loaded. A page without panels uses them from the start. */
export async function letters() {
  const sheet = document.querySelector('link[media="print"]');
  if (!sheet) return;
  sheet.media = "all";
  await document.fonts.ready;
}

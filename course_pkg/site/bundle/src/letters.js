/* Loads the course's fonts. The fonts are as large as all other parts of a page together, so the page
   draws the first panel before it loads the fonts. */

/** Use the fonts; the promise is resolved when the fonts are loaded. A page without panels uses the fonts
    from the start. */
export async function letters() {
  const sheet = document.querySelector('link[media="print"]');
  if (!sheet) return;
  sheet.media = "all";
  await document.fonts.ready;
}

/* The course's letters weigh as much as all the rest of a page, and its first panel is not to wait for them. */

/** Turn to them, and settle when they are there; a page without panels has them from the start. */
export async function letters() {
  const sheet = document.querySelector('link[media="print"]');
  if (!sheet) return;
  sheet.media = "all";
  await document.fonts.ready;
}

/* The page uses light colours, dark colours, or the setting of the system. A page from a local folder may
   have no storage; then the next page does not know the reader's choice. */

const KEY = "course-theme";
export const THEMES = ["system", "light", "dark"];

/** @returns {string} */
export function chosen() {
  try {
    const kept = localStorage.getItem(KEY);
    return kept && THEMES.includes(kept) ? kept : "system";
  } catch {
    return "system";
  }
}

/** @param {string} theme */
export function show(theme) {
  if (theme === "system") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
}

/** @param {string} theme */
function keep(theme) {
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // Without storage, the choice applies only to this page.
  }
}

/** Make each click on the button select the next theme. @param {HTMLButtonElement} button */
export function themeButton(button) {
  let theme = chosen();
  const say = () => {
    button.textContent = { system: "Auto", light: "Light", dark: "Dark" }[theme] ?? "";
    button.setAttribute("aria-label", theme === "system" ? "Auto: the colours of the system" : `${button.textContent} colours`);
  };
  button.addEventListener("click", () => {
    theme = THEMES[(THEMES.indexOf(theme) + 1) % THEMES.length];
    show(theme);
    keep(theme);
    say();
  });
  button.hidden = false;
  say();
}

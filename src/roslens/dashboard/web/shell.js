// Light or dark, and the help window.

import { onKey } from "./keys.js";

function isDark() {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
}

function label(button) {
  button.textContent = isDark() ? "Light" : "Dark";
  button.title = `Show the pages ${isDark() ? "light" : "dark"} (d)`;
}

/** Let the button, and its key, turn light and dark. */
export function startTheme() {
  const button = document.querySelector('[data-do="theme"]');
  label(button);
  const turn = () => {
    const theme = isDark() ? "light" : "dark";
    document.documentElement.dataset.theme = theme;
    try {
      localStorage.setItem("roslens.theme", theme);
    } catch (refused) {
      // The choice then holds for this page only.
    }
    label(button);
  };
  button.addEventListener("click", turn);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => label(button));
  onKey("d", turn);
}

/** Bring the page that is shown into sight where the navigation scrolls. */
export function showPlace() {
  const nav = document.querySelector(".top nav");
  const here = nav?.querySelector("[aria-current]");
  // With the first picture: to ask for places before would lay out the page twice.
  if (here) requestAnimationFrame(() => { nav.scrollLeft = here.offsetLeft - nav.offsetLeft - (nav.clientWidth - here.offsetWidth) / 2; });
}

function startHelp() {
  const shown = document.getElementById("help-window");
  const open = (event) => {
    event.preventDefault();
    shown.showModal();
  };
  // Pages of one report, as a study or evidence, have the window and no link to it.
  document.querySelector('[data-do="help"]')?.addEventListener("click", open);
  document.querySelector('[data-do="close-help"]').addEventListener("click", () => shown.close());
  shown.addEventListener("click", (event) => event.target === shown && shown.close());
  shown.addEventListener("keydown", (event) => event.key === "?" && shown.close());
  onKey("?", open);
}

export function startShell() {
  startTheme();
  showPlace();
  startHelp();
}

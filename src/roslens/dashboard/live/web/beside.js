// What pages that are read and used without JavaScript have of it: light or dark, and the place in the navigation.

import { startKeys } from "../keys.js";
import { showPlace, startTheme } from "../shell.js";

startTheme();
showPlace();
startKeys();

for (const all of document.querySelectorAll("[data-all]")) {
  const boxes = () => [...all.form.querySelectorAll(`[name="${all.dataset.all}"]`)];
  const words = () => { all.textContent = boxes().every((one) => one.checked) ? "Choose none" : "Choose all"; };
  all.addEventListener("click", () => {
    const every = boxes();
    const wanted = !every.every((one) => one.checked);
    for (const one of every) one.checked = wanted;
    words();
  });
  all.form.addEventListener("change", words);
  words();
}

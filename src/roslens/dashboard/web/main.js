// Everything here improves pages that already work without it.

import { medium, onReturn } from "./address.js";
import { startChips } from "./chips.js";
import { startFilters, startFindingKeys } from "./findings.js";
import { improveFurther } from "./improvements.js";
import { onKey, startKeys } from "./keys.js";
import { startSearch } from "./search.js";
import { startSections } from "./sections.js";
import { startShell } from "./shell.js";
import { startSource } from "./source.js";
import { startTables } from "./tables.js";
import { startTrend } from "./trend.js";

function improve(root) {
  const chips = startChips(root);
  startTables(root);
  startFilters(root, replace);
  startSource(root);
  startTrend(root);
  improveFurther(root, chips);
}

let awaited = "";
let here = location.pathname + location.search;

/** Load another address of this page in place, so that the reader stays where he is; "back" undoes it. */
async function replace(address, enter = true) {
  // Enter in a field both changes it and submits; and a late answer must not undo a newer choice.
  if (address === awaited) return;
  awaited = address;
  let text;
  try {
    text = await (await fetch(address)).text();
  } catch {
    // The server is gone: following the address lets the browser say so.
    location.assign(address);
    return;
  }
  if (address !== awaited) return;
  awaited = "";
  const page = new DOMParser().parseFromString(text, "text/html");
  const focused = document.activeElement?.id;
  const main = document.adoptNode(page.querySelector("main"));
  document.querySelector("main").replaceWith(main);
  document.title = page.title;
  if (enter && address !== here) history.pushState(null, "", address);
  here = location.pathname + location.search;
  improve(main);
  if (focused) document.getElementById(focused)?.focus();
}

startShell();
startKeys();
startSearch();
startFindingKeys();
onKey("Escape", () => {
  const current = document.querySelector(".finding.current");
  current?.classList.remove("current");
  return Boolean(current);
});
if (medium === "served" && document.querySelector("form[data-filters]")) {
  onReturn(() => {
    const address = location.pathname + location.search;
    if (address !== here) replace(address, false);
  });
}
// A page of one report is a file, too, and has no sections to choose from.
if (medium === "file" && document.querySelector(".paged > section")) startSections(improve);
else improve(document.querySelector("main"));

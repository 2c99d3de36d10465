// A single file shows one of its sections at a time, chosen by the fragment.

import { section } from "./address.js";

const PARENTS = { "packages/": "packages", "rules/": "rules", "metrics/": "metrics" };

/** Under which word of the navigation a section is found. */
function parentOf(name) {
  const [kind, system] = name.split("/");
  if (["computation", "nodes", "topics"].includes(kind)) {
    const own = `computation/${system}`;
    return document.querySelector(`[data-nav="${CSS.escape(own)}"]`) ? own : "computation";
  }
  const parent = Object.entries(PARENTS).find(([start]) => name.startsWith(start));
  return parent ? parent[1] : name;
}

export function startSections(improve) {
  const sections = new Map([...document.querySelectorAll(".paged > section")].map((element) => [element.id, element]));
  const improved = new Set();
  let shown = false;
  const show = () => {
    const asked = section();
    const place = sections.has(asked) ? null : document.getElementById(asked);
    const owner = place?.closest(".paged > section");
    // A place outside of the sections (the target of "Skip to content") leaves the section that is shown.
    if (place && !owner && shown) return;
    const name = sections.has(asked) ? asked : owner ? owner.id : sections.keys().next().value;
    // Other parameters of the same section are for what is in it.
    if (shown && !place && sections.get(name).classList.contains("current")) return;
    shown = true;
    for (const [id, element] of sections) element.classList.toggle("current", id === name);
    const parent = parentOf(name);
    for (const link of document.querySelectorAll("[data-nav]")) {
      if (link.dataset.nav === parent) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
    scrollTo(0, 0);
    if (!improved.has(name)) {
      improved.add(name);
      improve(sections.get(name));
    }
    if (owner) place.scrollIntoView({ block: "center" });
  };
  addEventListener("hashchange", show);
  show();
}

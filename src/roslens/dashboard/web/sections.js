// A single file shows one of its sections at a time, chosen by the fragment.

import { section } from "./address.js";

const PARENTS = { "packages/": "packages", "rules/": "rules", "metrics/": "metrics" };

export function startSections(improve) {
  const sections = new Map([...document.querySelectorAll(".paged > section")].map((element) => [element.id, element]));
  const improved = new Set();
  const show = () => {
    const name = sections.has(section()) ? section() : "overview";
    for (const [id, element] of sections) element.classList.toggle("current", id === name);
    const parent = Object.entries(PARENTS).find(([start]) => name.startsWith(start));
    for (const link of document.querySelectorAll("[data-nav]")) {
      if (link.dataset.nav === (parent ? parent[1] : name)) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
    if (!improved.has(name)) {
      improved.add(name);
      improve(sections.get(name));
    }
    scrollTo(0, 0);
  };
  addEventListener("hashchange", show);
  show();
}

// The name of an entity, wherever it stands, leads to what is known of it: one place for a name.

import { make } from "../dom.js";

/** A link that chooses an entity on this page; plain text where there is none. */
export function nameOf(entity, text = entity) {
  const name = make("bdi", { class: "name", text });
  return entity ? make("a", { class: "entity", href: `?select=${encodeURIComponent(entity)}`, "data-select": entity }, name) : name;
}

/** Call `chose` with the entity of a link that was clicked; with a key held down the browser opens it elsewhere. */
export function followNames(chose) {
  document.addEventListener("click", (event) => {
    const link = event.target.closest?.("[data-select]");
    if (!link || event.ctrlKey || event.metaKey || event.shiftKey || event.button) return;
    event.preventDefault();
    chose(link.dataset.select);
  });
}

// The way from what runs to what was read of its source, where the pages of a run are served beside.

import { make } from "../dom.js";

const WITH_PAGE = new Set(["node", "topic", "service", "action", "connection", "parameter"]);

/** The link to the page of an entity, in a list of its own; an empty one where there is no such page. */
export function toSource(entity, text) {
  if (!("beside" in document.body.dataset) || !WITH_PAGE.has(entity.split(":", 1)[0])) return [];
  return [make("a", { class: "go", href: `/entity?id=${encodeURIComponent(entity)}`, text })];
}

// Keys of the whole page; parts of it add their own.

import { typing } from "./dom.js";

const actions = new Map();
const PLACES = { o: "overview", g: "graph", p: "packages", f: "findings", m: "metrics", r: "rules", c: "computation" };
let going = 0;

/** Call `action` for a key pressed outside of fields; it returns false where the key means nothing right now. */
export function onKey(key, action) {
  actions.set(key, [...(actions.get(key) || []), action]);
}

export function startKeys() {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (typing(event) || document.querySelector("dialog[open]")) return;
    if (going && event.timeStamp - going < 1500 && PLACES[event.key]) {
      going = 0;
      document.querySelector(`[data-nav="${PLACES[event.key]}"]`)?.click();
      event.preventDefault();
      return;
    }
    going = 0;
    if (event.key === "g") {
      going = event.timeStamp;
      return;
    }
    for (const action of actions.get(event.key) || []) {
      if (action(event) !== false) {
        event.preventDefault();
        return;
      }
    }
  });
}

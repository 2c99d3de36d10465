// What a page shows lives in its address: the query, or in a single file what follows "?" in the fragment.

export const medium = document.body.dataset.medium;
const inFragment = medium === "file";

/** The section that a single file shows. */
export function section() {
  return decodeURIComponent(location.hash.slice(1).split("?")[0]);
}

/** The parameters of the page. */
export function parameters() {
  return new URLSearchParams(inFragment ? location.hash.split("?")[1] || "" : location.search);
}

let entered = false;

/** Like `setParameters`, but "back" undoes it. What one action changes is one entry of the history. */
export function enterParameters(changes) {
  setParameters(changes, true);
}

/** Set parameters; an empty value takes one away. The page is not loaded again. */
export function setParameters(changes, enter = false) {
  const now = parameters();
  const held = Object.entries(changes).every(([name, value]) => (now.get(name) || "") === (value || ""));
  // To write the same address again takes a browser milliseconds.
  if (held) return;
  for (const [name, value] of Object.entries(changes)) {
    now.delete(name);
    if (value) now.set(name, value);
  }
  const query = now.toString() ? `?${now}` : "";
  const address = inFragment ? `#${location.hash.slice(1).split("?")[0]}${query}` : `${location.pathname}${query}${location.hash}`;
  if (enter && !entered) {
    entered = true;
    setTimeout(() => (entered = false), 0);
    history.pushState(null, "", address);
  } else history.replaceState(null, "", address);
  if (medium === "served") {
    for (const twin of document.querySelectorAll(".twins a")) twin.search = query;
  }
}

/** Call `action` when the reader has gone back or forth to other parameters of this page. */
export function onReturn(action) {
  // In one file the sections are changed first: their listener is older.
  addEventListener(inFragment ? "hashchange" : "popstate", action);
}

/** An address with further parameters, whichever way this medium writes them. */
export function withParameters(href, changes) {
  const [path, ...rest] = inFragment ? [href] : href.split("#");
  const [bare, query] = path.split("?");
  const found = new URLSearchParams(query || "");
  for (const [name, value] of Object.entries(changes)) if (value) found.set(name, value);
  const text = found.toString() ? `${bare}?${found}` : bare;
  return rest.length ? `${text}#${rest.join("#")}` : text;
}

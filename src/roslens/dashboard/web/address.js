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

/** Set parameters; an empty value takes one away. The page is not loaded again. */
export function setParameters(changes) {
  const now = parameters();
  const held = Object.entries(changes).every(([name, value]) => (now.get(name) || "") === (value || ""));
  // To write the same address again takes a browser milliseconds.
  if (held) return;
  for (const [name, value] of Object.entries(changes)) {
    now.delete(name);
    if (value) now.set(name, value);
  }
  const query = now.toString() ? `?${now}` : "";
  if (inFragment) history.replaceState(null, "", `#${location.hash.slice(1).split("?")[0]}${query}`);
  else history.replaceState(null, "", `${location.pathname}${query}${location.hash}`);
  if (medium === "served") {
    for (const twin of document.querySelectorAll(".twins a")) twin.search = query;
  }
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

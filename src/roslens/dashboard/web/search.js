// The search field: matches while typing, from the server, from the folder's index, or from inside the file.

import { medium, parameters } from "./address.js";
import { make, settled } from "./dom.js";
import { onKey } from "./keys.js";

const MOST = 12;
const FIRST = ["package", "file"];

function rank(needle, name) {
  const folded = name.toLocaleLowerCase();
  if (folded === needle || folded === `/${needle}`) return 0;
  if (folded.startsWith(needle)) return 1;
  return folded.slice(folded.lastIndexOf("/") + 1).startsWith(needle) ? 2 : 3;
}

function best(entries, text, most) {
  const needle = text.toLocaleLowerCase();
  const found = entries.filter(([, name, more]) => `${name} ${more}`.toLocaleLowerCase().includes(needle));
  // Among whole names and beginnings packages come first, then files, as search.py has it.
  const kindOf = ([kind]) => (FIRST.includes(kind) ? FIRST.indexOf(kind) : FIRST.length);
  const own = ([kind, name]) => FIRST.includes(kind) && name.slice(name.lastIndexOf("/") + 1).toLocaleLowerCase().includes(needle);
  const order = (entry) => (own(entry) ? Math.min(1, rank(needle, entry[1])) : rank(needle, entry[1]));
  found.sort((a, b) => order(a) - order(b) || kindOf(a) - kindOf(b) || a[1].length - b[1].length);
  return found.slice(0, most).map(([kind, name, more, href]) => ({ kind, name, more, href }));
}

async function fromServer(text) {
  const answer = await fetch(`/search?q=${encodeURIComponent(text)}`);
  const page = new DOMParser().parseFromString(await answer.text(), "text/html");
  return [...page.querySelectorAll("#results tbody tr")].slice(0, MOST).map((row) => ({
    kind: row.cells[0].textContent.trim(),
    name: row.cells[1].textContent.trim(),
    more: row.cells[2].textContent.trim(),
    href: row.cells[1].querySelector("a")?.getAttribute("href") || "",
  }));
}

let index = null;

/** The index of a folder is a script, because a page on disk may not fetch. */
function folderIndex() {
  const address = document.body.dataset.index;
  const root = address.slice(0, address.length - "web/search-index.js".length);
  index ??= new Promise((resolve) => {
    const script = make("script", { src: address });
    script.addEventListener("load", () => resolve(window.roslensIndex.map(([kind, name, more, path]) => [kind, name, more, root + path])));
    script.addEventListener("error", () => resolve([]));
    document.head.append(script);
  });
  return index;
}

function fileIndex() {
  index ??= JSON.parse(document.getElementById("search-index").textContent);
  return index;
}

async function matches(text, most = MOST) {
  if (medium === "served") return fromServer(text);
  return best(medium === "folder" ? await folderIndex() : fileIndex(), text, most);
}

function item(match) {
  return make("li", { role: "option", "aria-selected": "false" }, make("a", { href: match.href, tabindex: "-1" }, make("small", { text: match.kind }), make("span", {}, match.name, match.more ? make("small", { text: ` ${match.more}` }) : "")));
}

export function startSearch() {
  const form = document.querySelector("form.search");
  if (!form) return;
  const input = form.querySelector("input");
  const list = make("ul", { class: "found", role: "listbox", id: "search-found", "aria-label": "Matches", hidden: true });
  form.append(list);
  input.setAttribute("role", "combobox");
  input.setAttribute("aria-controls", list.id);
  const close = () => {
    list.hidden = true;
    input.setAttribute("aria-expanded", "false");
  };
  close();
  const show = settled(async () => {
    const text = input.value.trim();
    if (!text) return close();
    const found = await matches(text);
    if (input.value.trim() !== text || document.activeElement !== input) return close();
    list.replaceChildren(...found.map(item));
    if (!found.length) list.append(make("li", { class: "quiet", text: "Nothing has this in its name." }));
    list.hidden = false;
    input.setAttribute("aria-expanded", "true");
    return undefined;
  }, 120);
  input.addEventListener("input", show);
  input.addEventListener("blur", () => setTimeout(close, 150));
  input.addEventListener("keydown", (event) => {
    const options = [...list.querySelectorAll("[role=option]")];
    const now = options.findIndex((option) => option.getAttribute("aria-selected") === "true");
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      const next = options[Math.max(0, Math.min(options.length - 1, now + (event.key === "ArrowDown" ? 1 : -1)))];
      for (const option of options) option.setAttribute("aria-selected", String(option === next));
      next?.scrollIntoView({ block: "nearest" });
      event.preventDefault();
    } else if (event.key === "Escape") {
      close();
      input.blur();
    } else if (event.key === "Enter" && !list.hidden && now >= 0) {
      event.preventDefault();
      close();
      options[now].querySelector("a").click();
    }
  });
  form.addEventListener("submit", async (event) => {
    if (medium !== "file") return;
    event.preventDefault();
    const [first] = input.value.trim() ? await matches(input.value.trim(), 1) : [];
    if (first) location.href = first.href;
    input.blur();
  });
  onKey("/", () => {
    input.focus();
    input.select();
  });
  showPage();
}

/** The results page of a folder is filled here. */
async function showPage() {
  const target = document.getElementById("search-results");
  const text = parameters().get("q");
  if (medium !== "folder" || !target || !text) return;
  document.querySelector("h1").textContent = `Search for “${text}”`;
  document.getElementById("q").value = text;
  const found = await matches(text, 200);
  const rows = found.map((match) =>
    make("tr", {}, make("td", { text: match.kind }), make("td", {}, make("a", { href: match.href, text: match.name })), make("td", { text: match.more })),
  );
  target.replaceChildren(
    found.length ? make("table", {}, make("tbody", {}, ...rows)) : make("p", { class: "empty", text: "Nothing has this in its name." }),
  );
}

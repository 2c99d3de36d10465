// Tables sort in place when all their rows are here; the links in their heads do the same by address otherwise.

import { parameters, setParameters } from "./address.js";
import { settled } from "./dom.js";

function valueOf(row, place) {
  const cell = row.cells[place];
  if (!cell) return null;
  const text = (cell.dataset.v ?? cell.textContent).trim();
  if (!cell.classList.contains("num")) return text.toLocaleLowerCase();
  const value = Number.parseFloat(text.replaceAll(",", "").replace(/^[^\d.-]+/, ""));
  return Number.isNaN(value) ? null : value;
}

function compare(first, second) {
  if (typeof first === "number") return first - second;
  return first < second ? -1 : first > second ? 1 : 0;
}

/** Order the rows of a table by a column; what has no value comes last either way. */
export function sortTable(table, key, falling) {
  const heads = [...table.tHead.rows[0].cells];
  const place = heads.findIndex((head) => head.firstElementChild?.dataset.sort === key);
  if (place < 0) return;
  const rows = [...table.tBodies[0].rows].map((row, index) => ({ row, index, value: valueOf(row, place) }));
  rows.sort((a, b) => {
    if (a.value === null || b.value === null) return (a.value === null) - (b.value === null) || a.index - b.index;
    return (falling ? compare(b.value, a.value) : compare(a.value, b.value)) || a.index - b.index;
  });
  table.tBodies[0].append(...rows.map((entry) => entry.row));
  for (const head of heads) head.setAttribute("aria-sort", "none");
  heads[place].setAttribute("aria-sort", falling ? "descending" : "ascending");
}

function enhance(section) {
  const table = section.querySelector("table");
  if (!table?.tHead || Number(table.dataset.total) > table.tBodies[0].rows.length) return;
  const name = section.dataset.param;
  const wanted = parameters().get(name);
  if (wanted) sortTable(table, wanted.replace(/^-/, ""), wanted.startsWith("-"));
  table.tHead.addEventListener("click", (event) => {
    const link = event.target.closest("a[data-sort]");
    if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    const head = link.closest("th");
    const order = head.getAttribute("aria-sort");
    const falling = order === "none" ? head.classList.contains("num") : order === "ascending";
    sortTable(table, link.dataset.sort, falling);
    setParameters({ [name]: (falling ? "-" : "") + link.dataset.sort });
  });
}

function enhanceRowFilter(input) {
  const section = document.getElementById(input.dataset.rows) || input.closest("main, section").querySelector(`[id$="${input.dataset.rows}"]`);
  const show = () => {
    const needle = input.value.trim().toLocaleLowerCase();
    for (const row of section.querySelectorAll("tbody tr")) row.hidden = !row.textContent.toLocaleLowerCase().includes(needle);
    setParameters({ text: input.value.trim() });
  };
  input.value = parameters().get("text") || "";
  if (input.value) show();
  input.addEventListener("input", settled(show, 120));
}

export function startTables(root) {
  for (const section of root.querySelectorAll("section.table")) enhance(section);
  for (const input of root.querySelectorAll("input[data-rows]")) enhanceRowFilter(input);
}

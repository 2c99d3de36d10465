// Lists of findings: filters that need no new page, and keys to walk through them.

import { enterParameters, medium, onReturn, parameters, setParameters } from "./address.js";
import { figure, settled } from "./dom.js";
import { onKey } from "./keys.js";

const FIELDS = ["severity", "consequence", "role", "include", "exclude", "text", "group", "columns"];

function visible() {
  return [...document.querySelectorAll("main .finding")].filter((finding) => finding.checkVisibility());
}

const foldable = () => visible().flatMap((finding) => [...finding.querySelectorAll(":scope > details")]);

function go(step) {
  const all = visible();
  if (!all.length) return false;
  const now = all.findIndex((finding) => finding.classList.contains("current"));
  const next = now < 0 ? (step > 0 ? 0 : all.length - 1) : Math.min(all.length - 1, Math.max(0, now + step));
  for (const finding of all) finding.classList.toggle("current", finding === all[next]);
  const target = all[next].querySelector("summary") || all[next];
  target.focus({ preventScroll: true });
  all[next].scrollIntoView({ block: "nearest" });
  return true;
}

function toggleAll() {
  const all = foldable();
  if (!all.length) return false;
  const open = all.some((details) => !details.open);
  for (const details of all) details.open = open;
  for (const button of document.querySelectorAll('[data-do="toggle-all"]')) button.textContent = open ? "Close all" : "Open all";
  return true;
}

function openPlace() {
  const current = document.querySelector(".finding.current");
  const link = current?.querySelector(".where a.place, .where .line a") || current?.querySelector(".more a.place, a");
  if (!link) return false;
  link.click();
  return true;
}

/** Keys and the button work on whatever list is shown, so they are set up once. */
export function startFindingKeys() {
  onKey("j", () => go(1));
  onKey("k", () => go(-1));
  onKey("e", toggleAll);
  onKey("o", openPlace);
  document.addEventListener("click", (event) => {
    if (event.target.closest?.('[data-do="toggle-all"]')) toggleAll();
  });
  addEventListener("beforeprint", () => {
    for (const details of foldable()) details.open = true;
  });
}

const split = (text) => text.toLocaleLowerCase().split(",").map((part) => part.trim()).filter(Boolean);

/** The same filter as on the server: severity, consequence, role, any tag included, no tag excluded, text. */
function accepts(finding, wanted) {
  const data = finding.dataset;
  const tags = (data.tags || "").split(" ");
  const include = split(wanted.include || "");
  const exclude = split(wanted.exclude || "");
  if (wanted.severity && data.severity !== wanted.severity) return false;
  if (wanted.consequence && data.consequence !== wanted.consequence) return false;
  if (wanted.role && data.role !== wanted.role && data.gate !== wanted.role) return false;
  if (wanted.rule && data.rule !== wanted.rule) return false;
  if (include.length && !include.some((tag) => tags.includes(tag))) return false;
  if (exclude.some((tag) => tags.includes(tag))) return false;
  const needle = (wanted.text || "").trim().toLocaleLowerCase();
  return !needle || `${finding.textContent}\n${data.rule}`.toLocaleLowerCase().includes(needle);
}

/** Hide what does not match; say how many are left. */
function hideOthers(root, wanted) {
  let shown = 0;
  for (const finding of root.querySelectorAll(".finding")) {
    finding.hidden = !accepts(finding, wanted);
    if (!finding.hidden) shown += 1;
  }
  for (const group of root.querySelectorAll(".group")) group.hidden = !group.querySelector(".finding:not([hidden])");
  for (const margin of root.querySelectorAll(".margin")) margin.hidden = !margin.querySelector(".finding:not([hidden])");
  const section = root.querySelector("#findings, .findings") || root;
  const count = section.querySelector(".bar-line .count");
  const all = section.querySelectorAll(".finding").length;
  const total = Number(section.dataset.total || all);
  if (count && !section.classList.contains("source-page")) {
    count.dataset.whole ??= count.textContent;
    count.textContent = shown < total ? `${figure(shown)} of ${figure(total)} shown` : count.dataset.whole;
  }
  for (const none of section.querySelectorAll("[data-none]")) none.hidden = shown > 0 || all === 0;
}

function fieldsOf(form) {
  const found = {};
  for (const [name, value] of new FormData(form)) found[name] = value;
  return found;
}

/** Filter a form's page. `replace` loads an address into the page (served); without it rows are hidden (files). */
export function startFilters(root, replace) {
  for (const form of root.querySelectorAll("form[data-filters]")) {
    if (medium === "served") {
      const send = () => {
        const query = new URLSearchParams();
        for (const [name, value] of new FormData(form)) if (value) query.set(name, value);
        for (const [name, value] of parameters()) if (name.startsWith("sort") || name === "line") query.set(name, value);
        replace(`${form.getAttribute("action")}${query.toString() ? `?${query}` : ""}`);
      };
      form.addEventListener("change", send);
      form.addEventListener("submit", (event) => {
        event.preventDefault();
        send();
      });
    } else {
      const now = parameters();
      for (const name of FIELDS) if (form.elements[name] && now.get(name)) form.elements[name].value = now.get(name);
      const apply = (keep = enterParameters) => {
        const wanted = fieldsOf(form);
        hideOthers(root, { ...Object.fromEntries(parameters()), ...wanted });
        keep(wanted);
      };
      onReturn(() => {
        if (!root.isConnected || !root.checkVisibility()) return;
        const then = parameters();
        for (const name of FIELDS) if (form.elements[name]) form.elements[name].value = then.get(name) || "";
        hideOthers(root, Object.fromEntries(then));
      });
      if (FIELDS.some((name) => now.get(name)) || now.get("rule")) hideOthers(root, Object.fromEntries(now));
      form.addEventListener("change", () => apply());
      form.addEventListener("input", settled(() => apply(setParameters), 150));
      form.addEventListener("submit", (event) => {
        event.preventDefault();
        apply();
      });
      for (const link of form.querySelectorAll("a.clear")) link.addEventListener("click", () => form.reset());
    }
  }
}

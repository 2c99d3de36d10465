// Hosts, nodes, topics and connections as a table that folds. Rows exist only while they are shown, and only what has
// changed is written, so that thousands of rows cost little. Of a long table values are written where somebody can see
// them, a screen around what is shown; further off they wait until that comes near.

import { make } from "../dom.js";
import { mark } from "./states.js";

const OPEN_TOPICS = 40;
const OPEN_NODES = 300;
const SHORT = 150;
const ROW_HEIGHT = 28;
const BESIDE = 5;
const OBSERVED = { inside: "counted inside the node", protocol: "reported by the middleware", tap: "received by a tap", recording: "from the recording", agent: "sampled on its host", scripted: "scripted" };
const BAD = new Set(["suspended", "unknown", "low", "high", "absent"]);

export class Tree {
  /** `chose` is called with the id of the entity of the row that was chosen by hand, or with "". */
  constructor(table, parts, chose) {
    Object.assign(this, { table, chose }, parts);
    this.body = table.querySelector("tbody");
    this.head = table.querySelector("thead tr");
    this.body.replaceChildren();
    this.lines = new Map();
    this.opened = new Map();
    this.rows = [];
    this.shown = [];
    this.order = [];
    this.columns = "";
    this.text = "";
    this.worse = false;
    this.chosen = "";
    this.waiting = false;
    this.sparks = Boolean(document.getElementById("time"));
    this.body.addEventListener("click", (event) => this.click(event));
    for (const name of ["scroll", "resize"]) addEventListener(name, () => this.soon(), { passive: true });
    addEventListener("beforeprint", () => this.fill(0, Infinity));
  }

  filter(text, worse) {
    this.text = text.trim().toLowerCase();
    this.worse = worse;
    this.draw();
  }

  update(snapshot) {
    const before = this.rows;
    this.rows = snapshot.rows;
    const columns = JSON.stringify(snapshot.columns);
    if (columns !== this.columns) {
      this.columns = columns;
      this.keys = snapshot.columns.map((column) => column[0]);
      this.head.replaceChildren(make("th", { scope: "col", text: "Name" }), make("th", { scope: "col", text: "State" }), ...(this.sparks ? [make("th", { scope: "col", class: "spark-head", text: "2 min" })] : []),
        ...snapshot.columns.map((column) => make("th", { scope: "col", class: "num", text: column[1] })));
      this.lines.clear();
      this.order = [];
      this.body.replaceChildren();
    }
    const size = this.rows.length;
    for (let at = 0; at < size; at += 1) {
      const row = this.rows[at];
      if (row.key === before[at]?.key) {
        // Looking up a text that was looked up before is faster: its hash is known.
        row.key = before[at].key;
        continue;
      }
      // Decided when a row is first seen, so that nothing folds by itself later.
      if (!this.opened.has(row.key)) this.opened.set(row.key, row.kind === "host" || (row.kind === "topic" ? size <= OPEN_TOPICS : size <= OPEN_NODES));
    }
    if (this.opened.size > 4 * size + 1000) {
      const there = new Set(this.rows.map((row) => row.key));
      for (const key of this.opened.keys()) if (!there.has(key)) this.opened.delete(key);
    }
    this.draw();
  }

  /** The rows to show: not folded away, and matching or above what matches. */
  select() {
    const { rows, text } = this;
    const filtered = Boolean(text) || this.worse;
    const wanted = new Uint8Array(rows.length);
    const above = [];
    const found = [];
    for (let at = 0; at < rows.length; at += 1) {
      const row = rows[at];
      above.length = row.depth;
      const matches = (!this.worse || BAD.has(row.worst || "unjudged")) && (!text || row.entity.toLowerCase().includes(text) || row.name.toLowerCase().includes(text));
      if (matches) {
        wanted[at] = 1;
        for (const place of above) wanted[place] = 1;
      }
      above.push(at);
    }
    let folded = Infinity;
    for (let at = 0; at < rows.length; at += 1) {
      const row = rows[at];
      if (row.depth > folded || !wanted[at]) continue;
      folded = Infinity;
      const parent = at + 1 < rows.length && rows[at + 1].depth > row.depth;
      const open = parent && (Boolean(text) || this.opened.get(row.key));
      if (parent && !open) folded = row.depth;
      found.push({ row, parent, open });
    }
    this.total = rows.length;
    this.matching = filtered ? wanted.reduce((sum, one) => sum + one, 0) : rows.length;
    return found;
  }

  draw() {
    if (!this.keys) return;
    // Before anything is written: to ask for places afterwards would lay out the page twice.
    const [first, last] = this.near();
    const before = this.shown;
    this.shown = this.select();
    if (this.order.length !== this.shown.length || !this.shown.every((one, at) => one.row.key === before[at].row.key)) this.arrange();
    for (let at = 0; at < this.shown.length; at += 1) {
      this.write(this.order[at], this.shown[at]);
      if (at >= first && at < last) this.values(this.order[at], this.shown[at].row);
    }
    if (!this.lines.has(this.chosen)) this.reach(this.shown[0]?.row.key);
    const all = this.matching === this.total;
    this.count.textContent = all ? `${this.total.toLocaleString("en-US")} rows` : `${this.matching.toLocaleString("en-US")} of ${this.total.toLocaleString("en-US")} rows`;
    this.empty.hidden = this.shown.length > 0;
    this.empty.textContent = !this.total ? "Nothing was seen yet." : this.worse && !this.text ? "Nothing is worse than ok." : "Nothing matches the filter.";
  }

  /** Put an element for each row to show where it belongs. */
  arrange() {
    const keys = new Set(this.shown.map((one) => one.row.key));
    for (const [key, line] of this.lines) {
      if (keys.has(key)) continue;
      line.element.remove();
      this.lines.delete(key);
    }
    let next = this.body.firstChild;
    this.order = this.shown.map(({ row }) => {
      let line = this.lines.get(row.key);
      if (!line) {
        line = this.build(row);
        this.lines.set(row.key, line);
      }
      if (line.element === next) next = next.nextSibling;
      else this.body.insertBefore(line.element, next);
      return line;
    });
    this.soon();
  }

  build(row) {
    const name = make("bdi", { text: row.name, title: row.entity });
    const below = make("span", { class: "below" });
    const cell = make("td", { class: "name" }, make("span", { class: "step" }), make("button", { type: "button", class: "fold", tabindex: "-1", "aria-label": "Fold" }), name, below);
    const state = make("span", { class: "mark" });
    const cells = this.keys.map(() => make("td", { class: "num" }, ""));
    const element = make("tr", { role: "row", "data-key": row.key, "data-kind": row.kind, "data-entity": row.entity, "aria-level": row.depth + 1, tabindex: "-1" },
      cell, make("td", { class: "state" }, state), ...(this.sparks ? [make("td", { class: "spark-cell" })] : []), ...cells);
    return { element, state, below, cells, is: "", open: null, texts: [], observer: null, kind: "" };
  }

  write(line, { row, parent, open }) {
    const { element } = line;
    if (line.is !== row.state) {
      line.is = row.state;
      mark(line.state, row.state);
    }
    const below = row.below || "";
    if (line.below.textContent !== below) line.below.textContent = below;
    const chosen = row.key === this.chosen && this.marked;
    const kind = `d${row.depth} ${row.state}${parent ? "" : " leaf"}${chosen ? " chosen" : ""}`;
    if (line.kind !== kind) {
      line.kind = kind;
      element.className = kind;
      element.setAttribute("aria-selected", chosen ? "true" : "false");
    }
    const unfolded = parent ? open : null;
    if (line.open !== unfolded) {
      line.open = unfolded;
      if (unfolded === null) element.removeAttribute("aria-expanded");
      else element.setAttribute("aria-expanded", unfolded);
    }
    if (line.observer !== (row.observer || "")) {
      line.observer = row.observer || "";
      element.title = OBSERVED[line.observer] || "";
    }
  }

  /** Write the values of a row. */
  values(line, row) {
    for (let at = 0; at < this.keys.length; at += 1) {
      const text = row.shown?.[this.keys[at]] || "";
      if (line.texts[at] === text) continue;
      line.texts[at] = text;
      // Writing into the text that is there costs a fraction of putting a new one in its place.
      line.cells[at].firstChild.data = text;
    }
  }

  /** The places of the rows that are within a screen of what can be seen: from the first to before the last. */
  near() {
    const size = this.shown.length;
    if (size <= SHORT) return [0, Infinity];
    const box = this.body.getBoundingClientRect();
    const height = box.height / size || ROW_HEIGHT;
    return [Math.floor((-box.top - innerHeight) / height), Math.ceil((2 * innerHeight - box.top) / height)];
  }

  /** Write values that have come near, once before the next picture. */
  soon() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.fill(...this.near());
    });
  }

  /** The entities of the rows around what can be seen, at most so many. */
  seen(most) {
    const [first, last] = this.near();
    const from = Math.max(first, 0);
    return [...new Set(this.shown.slice(from, Math.min(last, this.shown.length)).map((one) => one.row.entity))].slice(0, most);
  }

  /** The keys of the rows that can be seen, and of a few beside them. */
  keysSeen() {
    const size = this.shown.length;
    if (!size) return [];
    const box = this.body.getBoundingClientRect();
    const height = box.height / size || ROW_HEIGHT;
    const from = Math.max(0, Math.floor(-box.top / height) - BESIDE);
    return this.shown.slice(from, Math.max(0, Math.ceil((innerHeight - box.top) / height) + BESIDE)).map((one) => one.row.key);
  }

  /** Show how rows went; `line` makes a picture of values. */
  spark(values, line) {
    this.shown.forEach(({ row }, at) => {
      const found = values[row.entity];
      if (found) this.order[at]?.element.querySelector(".spark-cell")?.replaceChildren(line(found));
    });
  }

  fill(first, last) {
    const end = Math.min(last, this.shown.length);
    for (let at = Math.max(first, 0); at < end; at += 1) this.values(this.order[at], this.shown[at].row);
  }

  click(event) {
    const line = event.target.closest("tr");
    if (!line) return;
    if (event.target.closest(".fold")) this.fold(line.dataset.key);
    else this.choose(line.dataset.key, true);
  }

  fold(key, open = !this.opened.get(key)) {
    this.opened.set(key, open);
    this.draw();
  }

  /** Make a row the one that the Tab key reaches. */
  reach(key) {
    this.lines.get(this.reached)?.element.setAttribute("tabindex", "-1");
    this.reached = key;
    this.lines.get(key)?.element.setAttribute("tabindex", "0");
  }

  choose(key, byHand) {
    this.chosen = key;
    this.marked = Boolean(key);
    this.draw();
    const line = this.lines.get(key);
    if (line) {
      this.reach(key);
      line.element.scrollIntoView({ block: "nearest" });
      if (byHand) line.element.focus({ preventScroll: true });
    }
    if (byHand) this.chose(key ? this.rows.find((row) => row.key === key)?.entity || "" : "");
  }

  /** Bring the chosen row into view. */
  reveal() {
    this.lines.get(this.chosen)?.element.scrollIntoView({ block: "nearest" });
  }

  /** Choose the first row of an entity and open what it is in; false where there is none. */
  show(entity) {
    const at = this.rows.findIndex((row) => row.entity === entity);
    if (at < 0) {
      this.choose("", false);
      return false;
    }
    let { depth } = this.rows[at];
    for (let place = at - 1; place >= 0 && depth > 0; place -= 1) {
      if (this.rows[place].depth >= depth) continue;
      depth = this.rows[place].depth;
      this.opened.set(this.rows[place].key, true);
    }
    this.choose(this.rows[at].key, false);
    return this.lines.has(this.rows[at].key);
  }

  /** Go some rows on. */
  step(by) {
    if (!this.shown.length) return false;
    const at = this.shown.findIndex((one) => one.row.key === this.chosen);
    const next = at < 0 ? (by > 0 ? 0 : this.shown.length - 1) : Math.max(0, Math.min(this.shown.length - 1, at + by));
    this.choose(this.shown[next].row.key, true);
    return true;
  }

  /** Open or close the chosen row; a closed one goes to what it is in. */
  turn(open) {
    const at = this.shown.findIndex((one) => one.row.key === this.chosen);
    if (at < 0) return false;
    const { row, parent, open: isOpen } = this.shown[at];
    if (parent && isOpen !== open) {
      this.fold(row.key, open);
    } else if (!open) {
      const above = this.shown.slice(0, at).reverse().find((one) => one.row.depth < row.depth);
      if (above) this.choose(above.row.key, true);
    } else this.step(1);
    return true;
  }
}

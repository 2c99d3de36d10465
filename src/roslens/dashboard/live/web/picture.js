// The graph: nodes as boxes, topics as diamonds, or as lines between nodes. Places and lines come from the server, which
// has them from where the pages of the source have them; only what has changed is drawn again.

import { draw } from "../dom.js";
import { Camera } from "../graph/camera.js";
import { READABLE } from "../graph/names.js";
import { sign, span, word } from "./states.js";
import { crowd } from "./words.js";

/** Below this zoom lines have no words; below the other one they say the rate alone. */
const FAR = 0.55;
const NEAR = 0.85;
const MANY = 60;
/** The mark of a topic stands at the left end of its room. */
const MARK = 20;
const DIAMOND = 8;
const NAMED = 40;
/** So far beyond the edge a line has words that reach into the picture. */
const MARGIN = 100;
/** A picture of which no name could be read begins with the part of it that is worst, at this zoom. */
const LEGIBLE = 0.9;
/** So much room it has beside what is shown first, for the signs of states. */
const ASIDE = 14;
const GRAVE = ["absent", "high", "low", "unknown"];

export class Picture {
  /** `chose` is called with the id of an entity that was clicked, or with "". */
  constructor(canvas, parts, chose) {
    Object.assign(this, { canvas, chose }, parts);
    this.items = new Map();
    this.lines = new Map();
    this.version = -1;
    this.selected = "";
    this.boxes = [];
    this.grown = false;
    this.left = false;
    this.camera = new Camera(canvas, this.svg, this.scene, () => this.zoomed(), true);
    canvas.addEventListener("pointerdown", () => { this.left = true; });
    canvas.addEventListener("wheel", (event) => { this.left ||= event.defaultPrevented; });
    canvas.addEventListener("click", (event) => this.click(event));
    canvas.addEventListener("keydown", (event) => this.key(event));
    this.seen = true;
    new IntersectionObserver((found) => { this.seen = found.at(-1).isIntersecting; }).observe(canvas);
    new ResizeObserver(() => this.left || this.open()).observe(canvas);
  }

  /** Show all of it. */
  fit() {
    this.left = false;
    this.whole = true;
    this.open();
  }

  /** Show all of it, or where it begins; the picture is no higher than it needs to be. */
  open() {
    if (!this.size) return;
    const scale = Math.min(1.25, this.canvas.clientWidth / this.size.width);
    const height = Math.round(Math.max(this.items.size > MANY ? 280 : 150, Math.min(innerHeight * 0.5, this.size.height * scale + 52)));
    if (Math.abs(this.canvas.clientHeight - height) > 2) this.canvas.style.height = `${height}px`;
    this.camera.fit({ x: 0, y: 0, ...this.size });
    if (!this.whole && this.camera.k < READABLE) this.begin();
  }

  /** Show the first cause of what is wrong, else what is worst, else what most is joined to, where names can be read. */
  begin() {
    const joined = new Map();
    for (const one of this.lines.values()) for (const end of [one.start, one.end]) joined.set(end, (joined.get(end) || 0) + 1);
    const rank = ([key, { is }]) => [GRAVE.includes(is) ? GRAVE.length - GRAVE.indexOf(is) : 0, joined.get(key) || 0];
    const first = [...this.items].reduce((a, b) => { const [x, y] = [rank(a), rank(b)]; return y[0] > x[0] || (y[0] === x[0] && y[1] > x[1]) ? b : a; });
    const room = this.camera.size();
    const { k, x, y } = this.around(this.placeOf(this.foremost) ? this.foremost : first[0], room);
    const within = (at, size, long) => (size < long ? size / 2 : Math.max(long / 2, Math.min(size - long / 2, at)));
    this.camera.showAt(k, within(x, this.size.width, room.width / k), within(y, this.size.height, room.height / k));
    // From now on it moves as the reader moves it.
    this.left = true;
  }

  /** Zoom and middle that show an entity with all it is joined to, else with what it hears from, else alone. */
  around(entity, room) {
    const lines = [...this.lines.values()];
    const heard = lines.filter(({ end }) => end === entity).map(({ start }) => start);
    const told = lines.filter(({ start }) => start === entity).map(({ end }) => end);
    let found;
    for (const others of [[...heard, ...told], heard, []]) {
      const boxes = this.boxes.filter((one) => one.entity === entity || others.includes(one.entity));
      const [left, right] = [Math.min(...boxes.map(({ x, w }) => x - w / 2)), Math.max(...boxes.map(({ x, w }) => x + w / 2))];
      const [top, bottom] = [Math.min(...boxes.map(({ y, h }) => y - h / 2)), Math.max(...boxes.map(({ y, h }) => y + h / 2))];
      const k = Math.min(LEGIBLE, (room.width - 2 * ASIDE) / (right - left), (room.height - 2 * ASIDE) / (bottom - top));
      found = { k: Math.max(k, READABLE), x: (left + right) / 2, y: (top + bottom) / 2 };
      if (k >= READABLE) break;
    }
    return found;
  }

  zoomed() {
    this.svg.classList.toggle("far", this.camera.k < FAR);
    this.svg.classList.toggle("near-by", this.camera.k >= NEAR);
    this.svg.style.setProperty("--zoom", String(Math.max(1, this.camera.k)));
    this.spread();
  }

  /** Show the words of lines that have room, what is wrong and what belongs to the selection first. */
  spread() {
    this.grown = false;
    const { k } = this.camera;
    if (k < FAR) return;
    const weight = (one) => (GRAVE.includes(one.is) ? 2 + GRAVE.length - GRAVE.indexOf(one.is) : 0) + (this.selected && one.near ? 10 : 0);
    const lines = [...this.lines.values()].map((one) => [weight(one), one]).sort((a, b) => b[0] - a[0]).map(([, one]) => one);
    crowd(lines, this.boxes, k, k >= NEAR);
  }

  zoom(factor) {
    this.left = true;
    this.camera.zoom(factor);
  }

  update({ picture, alerts = [] }) {
    this.foremost = alerts[0]?.entity;
    const items = picture.items || [];
    const links = picture.links || [];
    const moved = picture.version !== this.version;
    this.version = picture.version;
    const there = new Set();
    for (const item of items) {
      there.add(item.entity);
      let shown = this.items.get(item.entity);
      if (!shown) {
        shown = this.box(item);
        this.items.set(item.entity, shown);
        this.layers.items.append(shown.element);
      }
      this.write(shown, item, moved);
    }
    sweep(this.items, there);
    this.boxes = items;
    this.links = links.map((link) => [items[link.start], items[link.end], link]);
    if (moved) this.frame(picture.boxes || []);
    this.trace(moved);
    this.leftOut.textContent = picture.left_out || "";
    if (moved) {
      this.size = { width: picture.width || 1, height: picture.height || 1 };
      if (!this.left) this.open();
    }
    if (this.selected) this.light();
  }

  /** Boxes of hosts and namespaces, behind everything. */
  frame(boxes) {
    this.layers.boxes.replaceChildren(
      ...boxes.map((box) =>
        draw("g", { class: `d${Math.min(box.depth, 2)}` },
          draw("rect", { x: box.x, y: box.y, width: box.width, height: box.height, rx: 8 }),
          draw("text", { x: box.x + 7, y: box.y + 14, text: box.title })),
      ),
    );
  }

  box(item) {
    const element = draw("g", { class: "item", tabindex: "-1", role: "button", "data-entity": item.entity });
    const title = draw("title", {});
    const text = draw("text", { "dominant-baseline": "central", text: item.label });
    const room = draw("rect", { x: -item.w / 2, y: -item.h / 2, width: item.w, height: item.h, rx: item.kind === "node" ? 6 : 0 });
    element.append(title, room);
    if (item.kind === "node") {
      element.append(text);
    } else {
      const x = DIAMOND + 1 - item.w / 2;
      text.setAttribute("x", MARK - item.w / 2);
      element.append(draw("path", { class: "diamond", d: `M${x} ${-DIAMOND}l${DIAMOND} ${DIAMOND}l${-DIAMOND} ${DIAMOND}l${-DIAMOND} ${-DIAMOND}Z` }), text);
    }
    return { element, title, is: "", glyph: null };
  }

  write(shown, item, moved) {
    const { element } = shown;
    if (moved) element.setAttribute("transform", `translate(${item.x} ${item.y})`);
    const state = item.state || "unjudged";
    if (shown.is === state) return;
    shown.is = state;
    element.classList.remove("unjudged", "ok", "suspended", "unknown", "low", "high", "absent");
    element.classList.add(`is-${item.kind}`, state);
    element.setAttribute("aria-label", `${item.kind} ${item.name}, ${word(state)}`);
    shown.title.textContent = `${item.name}: ${word(state)}`;
    shown.glyph?.remove();
    shown.glyph = null;
    if (state === "ok" || state === "unjudged") return;
    shown.glyph = sign(state, "", { x: -item.w / 2 - 7, y: -item.h / 2 - 7, width: 13, height: 13 });
    element.append(shown.glyph);
  }

  trace(moved) {
    const there = new Set();
    const rates = new Map();
    for (const [, end, link] of this.links) if (end.kind === "topic") rates.set(end.entity, link.rate || "");
    for (const [start, end, link] of this.links) {
      const key = `${start.entity}\n${end.entity}`;
      there.add(key);
      let shown = this.lines.get(key);
      if (!shown) {
        shown = line(start.entity, end.entity);
        this.lines.set(key, shown);
        this.layers.lines.append(shown.element);
        place(shown, link, end);
      } else if (moved) place(shown, link, end);
      shown.by = link.by || [];
      const state = link.state || "unjudged";
      const now = [state, link.rate, link.latency, link.bandwidth, link.age, link.lag, rates.get(start.entity), shown.by.length].join("\t");
      if (shown.now === now) continue;
      shown.now = now;
      if (shown.is !== state) {
        if (shown.is) shown.element.classList.remove(shown.is);
        shown.element.classList.add(state);
        shown.is = state;
      }
      // What arrives as fast as it is sent needs no second label.
      const rate = start.kind === "topic" && rates.get(start.entity) === link.rate ? "" : link.rate || "";
      const named = shown.by.length > 1 ? `${shown.by.length} topics` : shown.by.length ? `${nameOf(shown.by[0])} ${rate}` : rate;
      const more = [link.age !== undefined && link.age !== null && `age ${span(link.age)}`, start.kind === "topic" ? "" : link.bandwidth].filter(Boolean).join(" · ");
      this.grown = say(shown, named.trim(), more) || this.grown;
      const figures = [link.rate, link.latency && `latency ${link.latency}`, link.age !== undefined && link.age !== null && `age ${span(link.age)}`, link.bandwidth];
      const topics = shown.by.slice(0, NAMED).map((one) => one.slice("topic:".length));
      shown.title.textContent = [[`${start.name} → ${end.name}: ${word(state)}`, ...figures].filter(Boolean).join(", "), ...topics].join("\n");
    }
    sweep(this.lines, there);
    if (moved || this.grown) this.spread();
  }

  /** The places of the lines whose words can be read now, at most so many. */
  wordsSeen(most) {
    if (!this.seen || this.camera.k < FAR || !this.links) return [];
    const room = this.camera.size();
    const { k, x, y } = this.camera;
    const found = [];
    for (let at = 0; at < this.links.length && found.length < most; at += 1) {
      const [start, end, { word: [wordX, wordY] = [0, 0] }] = this.links[at];
      if (this.lines.get(`${start.entity}\n${end.entity}`)?.room === "crowded") continue;
      const [left, top] = [x + k * wordX, y + k * wordY];
      if (left > -MARGIN && left < room.width + MARGIN && top > -MARGIN && top < room.height + MARGIN) found.push(at);
    }
    return found;
  }

  select(entity, reveal) {
    this.selected = this.drawnAs(entity);
    for (const [key, shown] of this.items) shown.element.classList.toggle("selected", key === this.selected);
    this.svg.classList.toggle("dimmed", Boolean(this.selected));
    if (!this.selected) {
      this.spread();
      return;
    }
    this.light();
    const place = this.placeOf(this.selected) || this.placeOf([...this.lines.values()].find((one) => one.by.includes(this.selected))?.start);
    if (reveal && place) this.camera.reveal(place[0], place[1], 0.25);
  }

  placeOf(entity) {
    return this.items.get(entity)?.element.getAttribute("transform").match(/-?[\d.]+/g).map(Number);
  }

  /** A connection is shown by its topic; a topic that is no item, by the lines that stand for it. */
  drawnAs(entity) {
    if (!entity) return "";
    const shown = entity.startsWith("connection:") ? `topic:${entity.split(" > ")[1] || ""}` : entity;
    return this.items.has(shown) || [...this.lines.values()].some((one) => one.by.includes(shown)) ? shown : "";
  }

  /** Keep bright what the selected part hears from and speaks to: its topics and who is at their other ends. */
  light() {
    const near = new Set([this.selected]);
    const lit = new Set();
    for (const one of this.lines.values()) {
      if (!one.by.includes(this.selected)) continue;
      lit.add(one);
      near.add(one.start).add(one.end);
    }
    for (const [from, to] of [["start", "end"], ["end", "start"]]) {
      let edge = new Set([this.selected]);
      for (let step = 0; step < (this.selected.startsWith("node:") ? 2 : 1); step += 1) {
        const next = new Set();
        for (const one of this.lines.values()) {
          if (!edge.has(one[from])) continue;
          lit.add(one);
          near.add(one[to]);
          if (one[to].startsWith("topic:")) next.add(one[to]);
        }
        edge = next;
      }
    }
    this.bright(near, lit);
  }

  /** Keep only these items and lines bright. */
  bright(near, lit) {
    for (const [key, shown] of this.items) shown.element.classList.toggle("near", near.has(key));
    let changed = false;
    for (const one of this.lines.values()) {
      changed ||= one.near !== lit.has(one);
      one.near = lit.has(one);
      one.element.classList.toggle("near", one.near);
    }
    if (changed) this.spread();
  }

  click(event) {
    const item = event.target.closest(".item");
    this.chose(item ? item.dataset.entity : "");
  }

  key(event) {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!way || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const places = [...this.items].map(([key, shown]) => [key, ...shown.element.getAttribute("transform").match(/-?[\d.]+/g).map(Number)]);
    const here = places.find(([key]) => key === this.selected);
    const ahead = (x, y) => (x - here[1]) * way[0] + (y - here[2]) * way[1];
    const aside = (x, y) => Math.abs((x - here[1]) * way[1]) + Math.abs((y - here[2]) * way[0]);
    const cost = ([, x, y]) => (here ? ahead(x, y) + 2 * aside(x, y) : x + y);
    const candidates = here ? places.filter(([, x, y]) => ahead(x, y) > 1) : places;
    const next = candidates.reduce((one, other) => (one && cost(one) <= cost(other) ? one : other), null);
    if (next) this.chose(next[0]);
  }
}

function sweep(shown, there) {
  for (const [key, one] of shown) {
    if (there.has(key)) continue;
    one.element.remove();
    shown.delete(key);
  }
}

const nameOf = (topic) => topic.slice("topic:".length);

function line(start, end) {
  const [path, text, title] = [draw("path", {}), draw("text", {}, draw("tspan", {}), draw("tspan", { class: "more" })), draw("title", {})];
  return { element: draw("g", {}, title, path, text), title, path, text, now: "", is: "", by: [], start, end, at: [0, 0], letters: [0, 0], toTopic: false, near: false, room: "" };
}

/** Words about a line to a topic end before its mark, the others stand on the line. */
function place(shown, link, end) {
  shown.path.setAttribute("d", link.path);
  shown.element.classList.toggle("to-topic", end.kind === "topic");
  const [x, y] = (shown.at = link.word || [0, 0]);
  shown.toTopic = end.kind === "topic";
  [...shown.text.children].forEach((part, at) => {
    part.setAttribute("x", x);
    part.setAttribute("y", y - 4 + 16 * at);
  });
}

/** Write words at a line; return whether they need more room than any there before. */
function say(shown, text, more) {
  const [first, second] = shown.text.children;
  if (first.textContent !== text) first.textContent = text;
  if (second.textContent !== more) second.textContent = more;
  // Room for one letter more, so that a rate that wavers does not come and go.
  const letters = [text, more].map((one, at) => Math.max(shown.letters[at], one.length + one.length % 2));
  const grown = letters.some((count, at) => count > shown.letters[at]);
  shown.letters = letters;
  return grown;
}

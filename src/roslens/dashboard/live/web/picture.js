// The graph: nodes as boxes, topics as diamonds. Places come from the server; only what has changed is drawn again.

import { draw } from "../dom.js";
import { Camera } from "../graph/camera.js";
import { sign, word } from "./states.js";

const BOX = { width: 156, height: 32 };
const DIAMOND = 8;
const FAR = 0.55;
const MANY = 60;
const LETTERS = { node: 21, topic: 25 };

export class Picture {
  /** `chose` is called with the id of an entity that was clicked, or with "". */
  constructor(canvas, parts, chose) {
    Object.assign(this, { canvas, chose }, parts);
    this.items = new Map();
    this.lines = new Map();
    this.version = -1;
    this.selected = "";
    this.left = false;
    this.camera = new Camera(canvas, this.svg, this.scene, () => this.svg.classList.toggle("far", this.camera.k < FAR));
    for (const name of ["wheel", "pointerdown"]) canvas.addEventListener(name, () => { this.left = true; });
    canvas.addEventListener("click", (event) => this.click(event));
    canvas.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.left || this.fit()).observe(canvas);
  }

  /** Show all of it; the picture is no higher than it needs to be. */
  fit() {
    this.left = false;
    if (!this.size) return;
    const scale = Math.min(1.25, this.canvas.clientWidth / this.size.width);
    const height = Math.round(Math.max(this.items.size > MANY ? 280 : 150, Math.min(innerHeight * 0.5, this.size.height * scale + 52)));
    if (Math.abs(this.canvas.clientHeight - height) > 2) this.canvas.style.height = `${height}px`;
    this.camera.fit({ x: 0, y: 0, ...this.size });
  }

  zoom(factor) {
    this.left = true;
    this.camera.zoom(factor);
  }

  update({ picture }) {
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
    this.links = links.map((link) => [items[link.start], items[link.end], link]);
    this.trace(moved);
    this.leftOut.textContent = picture.left_out || "";
    if (moved) {
      this.size = { width: picture.width || 1, height: picture.height || 1 };
      if (!this.left) this.fit();
    }
    if (this.selected) this.light();
  }

  box(item) {
    const element = draw("g", { class: "item", tabindex: "-1", role: "button", "data-entity": item.entity });
    const name = item.also ? `${item.name} + ${item.also.length}` : item.name;
    const text = draw("text", { "dominant-baseline": "central" });
    const title = draw("title", {});
    const most = LETTERS[item.kind];
    text.textContent = name.length > most ? `…${name.slice(1 - most)}` : name;
    if (item.kind === "node") {
      element.append(title, draw("rect", { x: -BOX.width / 2, y: -BOX.height / 2, width: BOX.width, height: BOX.height, rx: 5 }), text);
    } else {
      text.setAttribute("y", -18);
      element.append(title, draw("path", { class: "diamond", d: `M0 ${-DIAMOND}L${DIAMOND} 0L0 ${DIAMOND}L${-DIAMOND} 0Z` }), text);
    }
    return { element, title, is: "", glyph: null, also: "" };
  }

  write(shown, item, moved) {
    const { element } = shown;
    if (moved) element.setAttribute("transform", `translate(${item.x} ${item.y})`);
    const state = item.state || "unjudged";
    const also = (item.also || []).join("\n");
    if (shown.is === state && shown.also === also) return;
    shown.is = state;
    shown.also = also;
    element.classList.remove("unjudged", "ok", "suspended", "unknown", "low", "high", "absent");
    element.classList.add(`is-${item.kind}`, state);
    element.setAttribute("aria-label", `${item.kind} ${item.name}, ${word(state)}`);
    shown.title.textContent = [`${item.name}: ${word(state)}`, also].filter(Boolean).join("\n").slice(0, 2000);
    shown.glyph?.remove();
    shown.glyph = null;
    if (state === "ok" || state === "unjudged") return;
    const place = item.kind === "node" ? { x: -BOX.width / 2 - 6, y: -BOX.height / 2 - 6 } : { x: DIAMOND + 3, y: -6 };
    shown.glyph = sign(state, "", { ...place, width: 12, height: 12 });
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
        const path = draw("path", {});
        const text = draw("text", {});
        const title = draw("title", {});
        shown = { element: draw("g", {}, title, path, text), title, path, text, about: "", is: "", label: "", start: start.entity, end: end.entity };
        this.lines.set(key, shown);
        this.layers.lines.append(shown.element);
        place(shown, start, end, link);
      } else if (moved) place(shown, start, end, link);
      const state = link.state || "unjudged";
      if (shown.is === state && shown.rate === link.rate && shown.latency === link.latency && shown.sent === rates.get(start.entity)) continue;
      shown.rate = link.rate;
      shown.latency = link.latency;
      shown.sent = rates.get(start.entity);
      if (shown.is !== state) {
        if (shown.is) shown.element.classList.remove(shown.is);
        shown.element.classList.add(state);
        shown.is = state;
      }
      // What arrives as fast as it is sent needs no second label.
      const rate = end.kind === "node" && rates.get(start.entity) === link.rate ? "" : link.rate || "";
      if (shown.label !== rate) {
        shown.label = rate;
        shown.text.textContent = rate;
      }
      const about = [`${start.name} → ${end.name}: ${word(state)}`, link.rate, link.latency && `latency ${link.latency}`].filter(Boolean).join(", ");
      if (shown.about !== about) {
        shown.about = about;
        shown.title.textContent = about;
      }
    }
    sweep(this.lines, there);
  }

  select(entity, reveal) {
    this.selected = this.items.has(entity) ? entity : this.groupOf(entity);
    for (const [key, shown] of this.items) shown.element.classList.toggle("selected", key === this.selected);
    this.svg.classList.toggle("dimmed", Boolean(this.selected));
    if (!this.selected) return;
    this.light();
    const place = this.items.get(this.selected).element.getAttribute("transform").match(/-?[\d.]+/g).map(Number);
    if (reveal) this.camera.reveal(place[0], place[1]);
  }

  /** A connection is shown by its topic, a topic that is drawn with others by those. */
  groupOf(entity) {
    if (!entity) return "";
    const topic = entity.startsWith("connection:") ? `topic:${entity.split(" > ")[1] || ""}` : entity;
    if (this.items.has(topic)) return topic;
    for (const [key, shown] of this.items) if (shown.also.split("\n").includes(topic)) return key;
    return "";
  }

  /** Keep bright what the selected part hears from and speaks to: its topics and who is at their other ends. */
  light() {
    const near = new Set([this.selected]);
    const lit = new Set();
    for (const [from, to] of [["start", "end"], ["end", "start"]]) {
      let edge = new Set([this.selected]);
      for (let step = 0; step < (this.selected.startsWith("node:") ? 2 : 1); step += 1) {
        const next = new Set();
        for (const line of this.lines.values()) {
          if (!edge.has(line[from])) continue;
          lit.add(line);
          near.add(line[to]);
          next.add(line[to]);
        }
        edge = next;
      }
    }
    for (const [key, shown] of this.items) shown.element.classList.toggle("near", near.has(key));
    for (const line of this.lines.values()) line.element.classList.toggle("near", lit.has(line));
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

function half(item) {
  return item.kind === "node" ? BOX.width / 2 : DIAMOND;
}

function place(shown, start, end, link) {
  const points = [[start.x + half(start), start.y], ...(link.via || []), [end.x - half(end), end.y]];
  const back = points[0][0] >= points[points.length - 1][0];
  let d = `M${points[0][0]} ${points[0][1]}`;
  const pieces = [];
  for (let at = 1; at < points.length; at += 1) {
    const [[x1, y1], [x2, y2]] = [points[at - 1], points[at]];
    const bend = back ? 70 : (x2 - x1) / 2;
    const sag = back ? 56 : 0;
    const piece = [x1, y1, x1 + bend, y1 + sag, x2 - bend, y2 + sag, x2, y2];
    d += `C${piece.slice(2).map((one) => one.toFixed(1)).join(" ")}`;
    pieces.push(piece);
  }
  shown.path.setAttribute("d", d);
  // Labels stand close to the topic, below the line, where its name is not.
  const [piece, t] = end.kind === "topic" ? [pieces[pieces.length - 1], 0.7] : [pieces[0], 0.34];
  const mix = (a, b, c, d2) => (1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t ** 2 * c + t ** 3 * d2;
  shown.text.setAttribute("x", mix(piece[0], piece[2], piece[4], piece[6]).toFixed(1));
  shown.text.setAttribute("y", (mix(piece[1], piece[3], piece[5], piece[7]) + 14).toFixed(1));
}

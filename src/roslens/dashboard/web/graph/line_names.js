// Lines between nodes say by which topics they are: a name, or how many there are, and the worst of what is wrong with one.

import { draw, figure } from "../dom.js";
import { Levels } from "./levels.js";
import { READABLE } from "./names.js";

/** With more lines than this only those at the selection have their names. */
const MOST = 240;
const WIDTH = 6.2;
const HEIGHT = 13;
/** So far from each other the same name may stand twice where several lines run on one part. */
const APART = 300;
const PLACES = [0.5, 0.38, 0.62, 0.28, 0.72];
const SEVERITIES = ["error", "warning"];

export class LineNames {
  constructor(view) {
    this.view = view;
    this.group = draw("g", { class: "line-names" });
    this.reach = draw("g", { class: "reach" });
    view.scene.titles.before(this.reach);
    view.svg.querySelector(".nodes").before(this.group);
    this.drawn = null;
  }

  /** The line of an element of the picture: its name, its mark, or the room in which a pointer reaches it. */
  lineOf(element) {
    const number = element.closest?.("[data-line]")?.dataset.line;
    return number === undefined ? null : this.view.shown[number];
  }

  show() {
    const { view } = this;
    const lines = view.settings.lines ? view.shown : [];
    const near = (one) => view.selected < 0 || [one.source, one.target, ...one.by].includes(view.selected);
    const readable = view.camera.k >= READABLE;
    const named = readable && (lines.length <= MOST || view.selected >= 0) ? lines.filter(near) : [];
    const state = [lines, lines.length, readable, view.selected];
    if (this.drawn && state.every((part, place) => part === this.drawn[place])) return;
    if (!this.drawn || this.drawn[0] !== lines) this.reach.replaceChildren(...lines.map((one, number) => draw("path", { d: one.path, "data-line": number })));
    this.drawn = state;
    const levels = new Levels(named.map((one) => one.path));
    const taken = [...view.places].map(([number, { x, y }]) => boxOf(x, y, view.graph.nodes[number].w, view.graph.nodes[number].h));
    const parts = [];
    const said = [];
    lines.forEach((one, number) => {
      const worst = SEVERITIES.find((severity) => one.by.some((other) => view.graph.nodes[other].severity === severity));
      let name = named.includes(one) ? this.textOf(one) : "";
      if (!worst && !name) return;
      let place = roomFor(one.path, name.length * WIDTH + (worst ? 18 : 0), taken, name ? levels : null);
      // Several lines on one part, all of the same name, say it once.
      if (name && place?.shared && said.some((other) => other.name === name && Math.abs(other.y - place.y) < HEIGHT / 2 && Math.abs(other.x - place.x) < APART)) {
        if (!worst) return;
        name = "";
        place = roomFor(one.path, 18, taken, null);
      }
      if (!place) return;
      taken.push(place.box);
      said.push({ name, ...place });
      parts.push(this.part(number, place, name, worst));
    });
    this.group.replaceChildren(...parts);
  }

  textOf(one) {
    if (one.by.length === 1) return this.view.graph.nodes[one.by[0]].label;
    const kinds = new Set(one.by.map((number) => this.view.graph.nodes[number].kind));
    return `${figure(one.by.length)} ${kinds.size === 1 ? `${[...kinds][0]}s` : "names"}`;
  }

  part(number, { x, y, box }, name, worst) {
    const found = draw("g", { "data-line": number, transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})` });
    if (worst) {
      const left = name ? box.left - x : -7;
      found.append(draw("svg", { class: `glyph ${worst}`, x: left.toFixed(1), y: -7, width: 14, height: 14, viewBox: "0 0 16 16" }, draw("use", { href: `#g-${worst}` })));
    }
    if (name) found.append(draw("text", { x: worst ? 9 : 0, y: 0, text: name }));
    return found;
  }
}

const boxOf = (x, y, width, height) => ({ left: x - width / 2, right: x + width / 2, top: y - height / 2, bottom: y + height / 2 });

/** A place on the line where nothing else stands: on a level part that is its own, if there is one. */
function roomFor(path, width, taken, levels) {
  for (const { x, y, shared } of levels ? levels.places(path, width) : []) {
    const box = boxOf(x, y, width, HEIGHT);
    if (free(box, taken)) return { x, y, box, shared };
  }
  const measured = draw("path", { d: path });
  const long = measured.getTotalLength();
  for (const share of PLACES) {
    const { x, y } = measured.getPointAtLength(long * share);
    const box = boxOf(x, y, Math.max(width, 14), HEIGHT);
    if (free(box, taken)) return { x, y, box };
  }
  return null;
}

const free = (box, taken) => !taken.some((other) => other.left < box.right && box.left < other.right && other.top < box.bottom && box.top < other.bottom);

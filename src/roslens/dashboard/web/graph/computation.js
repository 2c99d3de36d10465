// The computation graph: nodes, and topics as marks of their own or as lines between nodes.

import { enterParameters, setParameters } from "../address.js";
import { draw, figure, settled } from "../dom.js";
import { onKey } from "../keys.js";
import { dependentsOf, around } from "./focus.js";
import { closeUp, line, stepsFrom } from "./lanes.js";
import { showNames } from "./names.js";
import { visibleOf } from "./noise.js";
import { LineNames } from "./line_names.js";
import { Minimap } from "./minimap.js";
import { startPictureFiles } from "./picture_file.js";
import { keepTitles } from "./titles.js";
import { wayBetween } from "./way.js";
import { TellingStage } from "./computation_panel.js";

const split = (text) => (text || "").split(",").map((part) => part.trim()).filter(Boolean);
const same = (a, b) => a.length === b.length && a.every((one, place) => one === b[place]);

// Of a topic, service or action the mark stands at the left end of its room; far away only the mark is drawn.
const MARK = 20;
const SHAPE = {
  left: (node) => node.w / 2,
  right: (node) => (node.kind === "node" ? node.w / 2 : MARK - node.w / 2),
  down: (node) => node.h / 2,
  centre: (node) => (node.kind === "node" ? 0 : MARK / 2 - 1 - node.w / 2),
  beside: (node) => node.kind === "node",
  put(element, node, where, shift) {
    const text = element.lastElementChild;
    const classes = element.classList;
    const inside = where === "home";
    const beside = where === "right" ? 1 : where === "left" ? -1 : 0;
    classes.toggle("outside", !inside);
    classes.toggle("above", where === "above");
    classes.toggle("rightward", beside > 0);
    classes.toggle("leftward", beside < 0);
    const x = inside ? (node.kind === "node" ? 0 : MARK - node.w / 2) : beside ? (beside * node.w) / 2 : this.centre(node) + shift;
    text.setAttribute("x", x.toFixed(1));
    text.setAttribute("y", inside || beside ? "0" : String((where === "above" ? -1 : 1) * (node.h / 2 + 2)));
  },
};

class ComputationView extends TellingStage {
  constructor(root, data) {
    super(root, data, "elements");
    data.wires.forEach((wire, place) => (wire.ends = data.ends[place]));
    this.scene = Object.fromEntries(["boxes", "wires", "titles"].map((name) => [name, this.svg.querySelector(`.${name}`)]));
    this.lineNames = new LineNames(this);
    this.minimap = new Minimap(this);
    startPictureFiles(root, this);
    this.shown = [];
    this.drawnAs = null;
    this.start();
    this.scene.wires.addEventListener("pointerover", (event) => event.target.tagName === "path" && this.titleLine(event.target));
    const find = this.form.elements.find;
    find.addEventListener("input", settled(() => this.find(find.value), 120));
    find.addEventListener("keydown", (event) => event.key === "Enter" && this.nextFound());
    onKey("l", () => (this.root.checkVisibility() ? this.openLine() : false));
    if (find.value) this.find(find.value, false);
  }

  showStart() {
    this.placed = true;
    super.showStart();
  }

  showTable(shown, remember = true) {
    super.showTable(shown, remember);
    this.fillTables();
  }

  /** The tables show what the filters and the focus leave. */
  fillTables() {
    if (!this.visible || !this.root.classList.contains("as-table")) return;
    const ends = new Set(this.joined.filter((wire) => this.visible.has(wire.source) || this.visible.has(wire.target)).flatMap((wire) => wire.ends));
    const tables = [[this.rows.nodes, this.visible], [this.rows.endpoints, ends]];
    for (const [rows, kept] of tables) {
      if (!rows.size) continue;
      for (const [number, row] of rows) row.hidden = !kept.has(number);
      const shown = [...rows.keys()].filter((number) => kept.has(number)).length;
      const [first] = rows.values();
      first.closest(".table").querySelector(".count").textContent = shown < rows.size ? `${figure(shown)} of ${figure(rows.size)} shown` : figure(shown);
    }
  }

  readAddress(now) {
    super.readAddress(now);
    const wanted = now.get("topics");
    this.settings = {
      lines: wanted === "lines" || wanted === "marks" ? wanted === "lines" : this.graph.many,
      noise: now.getAll("noise").length ? split(now.getAll("noise").join(",")).filter((one) => this.graph.presets.includes(one)).sort() : this.graph.default,
      hide: split(now.get("hide")),
    };
    const form = this.form.elements;
    form.topics.value = this.settings.lines ? "lines" : "marks";
    for (const box of this.form.querySelectorAll('[name="noise"]')) box.checked = this.settings.noise.includes(box.value);
    form.hide.value = this.settings.hide.join(",");
    form.find.value = now.get("find") || "";
    this.settings.bad = Boolean(now.get("bad"));
    form.bad.checked = this.settings.bad;
    form.to.value = now.get("to") || "";
  }

  readForm() {
    const noise = [...this.form.querySelectorAll('[name="noise"]')].filter((box) => box.checked).map((box) => box.value);
    this.settings = { lines: this.form.elements.topics.value === "lines", noise: [...noise].sort(), hide: split(this.form.elements.hide.value), bad: this.form.elements.bad.checked };
    enterParameters({
      bad: this.settings.bad ? "1" : "",
      to: this.form.elements.to.value.trim(),
      topics: this.settings.lines === this.graph.many ? "" : this.settings.lines ? "lines" : "marks",
      noise: same(this.settings.noise, this.graph.default) ? "" : noise.join(",") || "none",
      hide: this.settings.hide.join(","),
    });
    this.placeNodes();
    this.select(this.selected, false);
    this.find(this.form.elements.find.value);
    this.fit();
  }

  /** What is visible and drawn under the filters, in the focus, with topics as marks or as lines. */
  placeNodes() {
    const { nodes } = this.graph;
    const { lines, noise, hide } = this.settings;
    const allowed = visibleOf(this.graph, new Set(noise), hide);
    const implicit = noise.includes("implicit");
    this.joined = this.graph.wires.filter((wire) => allowed.has(wire.source) && allowed.has(wire.target) && !(wire.implicit && implicit));
    const all = lines ? this.flows(allowed) : this.joined;
    const ends = new Set([...allowed].filter((number) => !lines || nodes[number].kind === "node"));
    nodes.forEach((node) => (node.needs = []));
    for (const one of all) nodes[one.source].needs.push(one.target);
    this.dependents = dependentsOf(nodes);
    if (this.settings.bad) this.keepBad(ends, nodes);
    if (this.focus >= 0 && !ends.has(this.focus)) this.focus = -1;
    this.total = ends.size;
    this.visible = this.focus < 0 ? ends : around(nodes, this.dependents, this.focus, this.hops);
    this.lines = all.filter((one) => this.visible.has(one.source) && this.visible.has(one.target));
    this.draw();
    this.lineNames.show();
    this.fillTables();
    this.showCrumbs();
  }

  /** Of what is shown keep what something is wrong with, and what that is joined to. */
  keepBad(ends, nodes) {
    const bad = (number) => Boolean(nodes[number].severity);
    const kept = new Set([...ends].filter((number) => bad(number) || [...nodes[number].needs, ...this.dependents[number]].some(bad)));
    if (this.settings.lines) for (const one of this.flows(new Set(this.graph.nodes.keys()))) if (one.by.some(bad)) kept.add(one.source).add(one.target);
    for (const number of [...ends]) if (!kept.has(number)) ends.delete(number);
  }

  /** The way from what is selected to what the field names, in the panel and in the picture. */
  way() {
    const wanted = this.form.elements.to.value.trim();
    const to = wanted ? this.graph.nodes.findIndex((node) => node.name === wanted) : -1;
    return to >= 0 && this.selected >= 0 && this.visible.has(to) ? { to, way: wayBetween(this.graph.nodes, this.visible, this.selected, to) } : null;
  }

  select(number, remember = true) {
    super.select(number, remember);
    const on = new Set(this.way()?.way || []);
    this.elements.forEach((element, place) => element.classList.toggle("on-way", on.has(place)));
  }

  /** Flows from node to node by way of what is allowed. */
  flows(allowed) {
    const given = new Map();
    for (const wire of this.joined) if (this.graph.nodes[wire.target].kind !== "node") given.set(wire.target, [...(given.get(wire.target) || []), wire]);
    const found = new Map();
    for (const take of this.joined) {
      for (const give of given.get(take.source) || []) {
        if (give.source === take.target || !allowed.has(give.source)) continue;
        const key = `${give.source} ${take.target}`;
        const flow = found.get(key) || { source: give.source, target: take.target, by: [], conditional: true, resolved: false };
        flow.by.push(take.source);
        flow.conditional &&= Boolean(give.conditional || take.conditional);
        flow.resolved ||= give.resolved !== false && take.resolved !== false;
        found.set(key, flow);
      }
    }
    return [...found.values()];
  }

  draw() {
    const { nodes, drawn } = this.graph;
    const { lines, noise, hide } = this.settings;
    const ready = this.focus < 0 && !this.settings.bad && same(noise, drawn.noise) && same(hide, drawn.hide);
    const from = lines ? this.graph.lines : this.graph.topics;
    let boxes;
    if (ready) {
      this.places = new Map(Object.entries(from.places).map(([number, [x, y]]) => [Number(number), { x, y }]));
      this.extent = { x: 0, y: 0, width: from.width, height: from.height };
      const own = lines ? this.graph.flows : this.graph.wires;
      this.shown = from.lines.map(([number, path]) => ({ ...own[number], path }));
      boxes = from.boxes;
    } else {
      const close = closeUp(nodes, this.visible, this.graph.lanes, this.column());
      this.places = close.places;
      this.extent = { x: 0, y: 0, width: close.width, height: close.height };
      this.shown = this.lines.map((one) => ({ ...one, path: line(close.places.get(one.source), close.places.get(one.target), nodes[one.source], nodes[one.target]) }));
      boxes = close.boxes;
    }
    this.boxes = boxes;
    this.titles = boxes.filter((box) => !box.depth).map((box) => ({ x: box.x + 7, y: box.y + 3, width: 7.6 * box.title.length }));
    const giving = new Set(this.shown.map((one) => one.source));
    this.elements.forEach((element, number) => element.classList.toggle("last", !giving.has(number)));
    const as = ready ? `${lines}` : "";
    if (this.drawnAs === null && ready && lines === drawn.lines) {
      // The page came with this picture.
      this.drawnAs = as;
      return;
    }
    if (as && as === this.drawnAs) return;
    this.drawnAs = as;
    this.elements.forEach((element, number) => {
      const place = this.places.get(number);
      element.toggleAttribute("hidden", !place);
      if (place) element.setAttribute("transform", `translate(${place.x.toFixed(1)} ${place.y.toFixed(1)})`);
    });
    this.scene.boxes.replaceChildren(
      ...boxes.map((box) =>
        draw("g", { class: `box d${Math.min(box.depth, 2)}` }, draw("rect", { x: box.x, y: box.y, width: box.width, height: box.height, rx: 8 })),
      ),
    );
    this.scene.titles.replaceChildren(...boxes.map((box) => draw("text", { class: `d${Math.min(box.depth, 2)}`, x: box.x + 7, y: box.y + 3, text: box.title })));
    this.scene.wires.setAttribute("class", `wires${this.shown.length > 200 ? " many" : ""}`);
    this.scene.wires.replaceChildren(...this.shown.map((one) => this.path(one)));
  }

  /** In which column an element stands: by flow, in a focus as seen from it. */
  column() {
    const { nodes } = this.graph;
    const by = this.settings.lines ? "tier" : "column";
    if (this.focus < 0) return (place) => nodes[place][by];
    const steps = stepsFrom(nodes, this.dependents, this.focus);
    return (place) => steps.get(place);
  }

  path(one, more = "") {
    const style = [one.conditional && "conditional", one.resolved === false && "unresolved", more].filter(Boolean).join(" ");
    return draw("path", { class: style, d: one.path });
  }

  /** A line between nodes tells by which topics it is, from when somebody points at it. */
  titleLine(path) {
    const by = this.shown[[...this.scene.wires.children].indexOf(path)]?.by;
    if (by?.length && !path.firstChild) path.append(draw("title", { text: by.map((one) => this.graph.nodes[one].name).join("\n") }));
  }

  recolour() {}

  /** Every box holds its name from the start: the small map says what else there is. */
  opensNear() {
    return true;
  }

  box() {
    return this.extent;
  }

  /** Between nodes, topics are lines: what is drawn of one is its lines. */
  selectable(number) {
    return super.selectable(number) || this.linesBy(number).length > 0;
  }

  linesBy(number) {
    return this.settings.lines ? this.shown.filter((one) => one.by?.includes(number)) : [];
  }

  neighbours(number) {
    if (this.visible.has(number)) return super.neighbours(number);
    return this.linesBy(number).flatMap((one) => [one.source, one.target]);
  }

  linksOf(number) {
    if (!this.visible.has(number)) return this.linesBy(number).map((one) => this.path(one, "gives"));
    return this.shown.filter((one) => one.source === number || one.target === number).map((one) => this.path(one, one.source === number ? "gives" : "takes"));
  }

  /** A line between nodes is selected as what it stands for. */
  clicked(event) {
    const one = this.lineNames.lineOf(event.target);
    if (!one) super.clicked(event);
    else if (one.by.length === 1) this.select(one.by[0]);
    else {
      this.select(-1);
      this.tell(this.describeLine(one));
    }
  }

  nameNodes() {
    if (!this.placed) return;
    this.lineNames.show();
    this.minimap.show();
    keepTitles([...this.scene.titles.children], this.boxes, this.camera);
    const near = this.selected < 0 ? [] : [this.selected, ...this.neighbours(this.selected)];
    const weight = (number) => (this.graph.nodes[number].kind === "node" ? 1000 : 0) + this.graph.nodes[number].needs.length + this.dependents[number].length;
    const rest = this.selected < 0 ? [...this.visible].sort((a, b) => weight(b) - weight(a)) : [];
    const order = [...new Set([...near, ...(this.found || []).filter((number) => this.visible.has(number)), ...rest])];
    showNames(this.svg, this.elements, this.graph.nodes, order, this.places, this.camera, SHAPE, this.titles);
  }

  /** Give every box its name, as where the picture has the size in which it was laid out. */
  nameAll() {
    showNames(this.svg, this.elements, this.graph.nodes, [], this.places, { k: 1 }, SHAPE, this.titles);
  }

  find(text, remember = true) {
    const needle = text.trim().toLocaleLowerCase();
    this.found = needle ? [...this.visible].filter((number) => this.graph.nodes[number].name.toLocaleLowerCase().includes(needle)) : [];
    const found = new Set(this.found);
    this.canvas.classList.toggle("graph-find", Boolean(needle));
    this.elements.forEach((element, number) => element.classList.toggle("found", found.has(number)));
    if (remember) setParameters({ find: text.trim() });
    if (this.selected < 0) this.select(-1, false);
    else this.nameNodes();
  }

  nextFound() {
    if (!this.found.length) return;
    this.select(this.found[(this.found.indexOf(this.selected) + 1) % this.found.length]);
  }
}

export function startComputation(root) {
  const data = root.querySelector('[id$="graph-data"]');
  if (root.querySelector('[id$="graph-svg"]')) new ComputationView(root, JSON.parse(data.textContent));
}

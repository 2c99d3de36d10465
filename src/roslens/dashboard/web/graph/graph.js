// The package graph: the picture that the server drew, with colours, selection, focus and zoom that follow the reader.
// Everything that the reader chooses is in the address.

import { parameters, setParameters } from "../address.js";
import { draw, figure, make } from "../dom.js";
import { onKey } from "../keys.js";
import { sortTable } from "../tables.js";
import { Camera } from "./camera.js";
import { colourOf, tagCounts, wantedRules } from "./counts.js";
import { curve } from "./curves.js";
import { around, closeUp, dependentsOf, reducedEdges } from "./focus.js";
import { showNames } from "./names.js";
import { showSelected } from "./panel.js";
import { legendOf, rampOf, stepOf } from "./ramp.js";

const split = (text) => (text || "").split(",").map((part) => part.trim()).filter(Boolean);

class GraphView {
  constructor(root, chips) {
    this.root = root;
    this.chips = chips;
    this.canvas = root.querySelector("#graph-canvas");
    this.svg = root.querySelector("#graph-svg");
    this.form = root.querySelector("#graph-form");
    this.graph = JSON.parse(root.querySelector("#graph-data").textContent);
    this.elements = [...this.svg.querySelectorAll("#nodes .node")];
    this.edges = [...this.svg.querySelectorAll("#scene > .edges")];
    this.drawnEdges = this.edges.map((edge) => edge.getAttribute("d"));
    this.dependents = dependentsOf(this.graph.nodes);
    this.places = new Map();
    this.selected = -1;
    this.focus = -1;
    this.hops = 1;
    this.active = -1;
    this.readAddress();
    this.camera = new Camera(this.canvas, this.svg, this.svg.querySelector("#scene"), () => this.cameraChanged());
    this.listen();
    this.placeNodes();
    this.recolour();
    this.select(this.selected, false);
    this.showStart();
    this.ready = true;
  }

  readAddress() {
    const now = parameters();
    const number = (id) => this.graph.nodes.findIndex((node) => node.id === id);
    this.settings = {
      colour: now.get("colour") || "findings",
      include: split(now.get("include")),
      exclude: split(now.get("exclude")),
      own: Boolean(now.get("own")),
    };
    this.form.elements.colour.value = this.settings.colour;
    if (!this.form.elements.colour.value) this.form.elements.colour.value = this.settings.colour = "findings";
    this.form.elements.own.checked = this.settings.own;
    this.chips.get("include").set(this.settings.include);
    this.chips.get("exclude").set(this.settings.exclude);
    if (now.get("focus")) this.focus = number(now.get("focus"));
    this.hops = Math.max(1, Math.min(9, Number.parseInt(now.get("hops") || "1", 10) || 1));
    if (now.get("select")) this.selected = number(now.get("select"));
    this.showTable(Boolean(now.get("table")), false);
    this.showPanel(now.get("panel") !== "0", false);
  }

  showStart() {
    const [k, x, y] = (parameters().get("view") || "").split(",").map(Number);
    if (k > 0 && Number.isFinite(x) && Number.isFinite(y)) {
      const { width, height } = this.camera.size();
      Object.assign(this.camera, { k, x: width / 2 - k * x, y: height / 2 - k * y });
      this.camera.redraw();
    } else this.fit();
  }

  listen() {
    const actions = {
      "zoom-in": () => this.camera.zoom(1.4),
      "zoom-out": () => this.camera.zoom(1 / 1.4),
      "zoom-all": () => this.fit(),
      table: () => this.showTable(!this.root.classList.contains("as-table")),
      panel: () => this.showPanel(this.root.querySelector("#graph-view").classList.contains("panel-closed")),
    };
    for (const [name, action] of Object.entries(actions)) this.form.querySelector(`[data-do="${name}"]`).addEventListener("click", action);
    this.form.addEventListener("change", () => this.readForm());
    this.form.addEventListener("submit", (event) => event.preventDefault());
    this.canvas.tabIndex = 0;
    for (const element of this.elements) element.tabIndex = -1;
    this.canvas.addEventListener("click", (event) => this.clicked(event));
    this.canvas.addEventListener("dblclick", (event) => this.doubleClicked(event));
    this.canvas.addEventListener("dragstart", (event) => event.preventDefault());
    this.canvas.addEventListener("keydown", (event) => this.pressed(event));
    let width = this.canvas.clientWidth;
    new ResizeObserver(() => {
      if (!width && this.canvas.clientWidth) this.showStart();
      width = this.canvas.clientWidth;
    }).observe(this.canvas);
    const here = (action) => (event) => (this.root.checkVisibility() ? action(event) : false);
    onKey("t", here(actions.table));
    onKey("s", here(actions.panel));
    onKey("+", here(actions["zoom-in"]));
    onKey("=", here(actions["zoom-in"]));
    onKey("-", here(actions["zoom-out"]));
    onKey("0", here(actions["zoom-all"]));
    onKey("f", here(() => this.focusKey()));
    onKey("Escape", here(() => this.escape()));
    onKey("o", here(() => this.openSelected()));
  }

  openSelected() {
    if (this.selected < 0) return false;
    location.href = this.elements[this.selected].getAttribute("href");
    return true;
  }

  readForm() {
    const form = this.form.elements;
    this.settings = { colour: form.colour.value, include: split(form.include.value), exclude: split(form.exclude.value), own: form.own.checked };
    setParameters({
      colour: this.settings.colour === "findings" ? "" : this.settings.colour,
      include: this.settings.include.join(","),
      exclude: this.settings.exclude.join(","),
      own: this.settings.own ? "1" : "",
    });
    this.recolour();
    this.select(this.selected, false);
  }

  /** Colours, legend, table and tag counts for what is visible under the filters. */
  recolour() {
    this.colour = colourOf(this.graph, this.settings);
    this.rules = wantedRules(this.graph, this.settings.include, this.settings.exclude);
    const ramp = rampOf([...this.visible].map((place) => this.colour.values[place]), this.colour.better, this.colour.decimals);
    const counts = new Map();
    this.elements.forEach((element, place) => {
      const step = stepOf(ramp, this.colour.values[place]);
      element.setAttribute("class", element.getAttribute("class").replace(/\bs[0-5n]\b/, `s${step}`));
      const disc = element.firstElementChild;
      if (step === "n") disc.setAttribute("fill", "url(#hatch)");
      else disc.removeAttribute("fill");
      element.setAttribute("aria-label", `${this.graph.nodes[place].id}: ${this.textOf(place)} ${this.colour.title.toLocaleLowerCase()}`);
      if (this.visible.has(place)) counts.set(step, (counts.get(step) || 0) + 1);
    });
    this.showLegend(ramp, counts);
    this.fillTable();
    const tags = tagCounts(this.graph, this.visible, this.settings.own);
    for (const chips of this.chips.values()) chips.counts = tags;
    this.nameNodes();
  }

  textOf(place) {
    return figure(this.colour.values[place], this.colour.decimals);
  }

  showLegend(ramp, counts) {
    const unit = this.colour.unit ? ` [${this.colour.unit}]` : "";
    const among = `relative to the ${figure(this.visible.size)} package${this.visible.size === 1 ? "" : "s"} shown`;
    this.root.querySelector("#legend-title").textContent = `${this.colour.title}${unit}, ${among}${ramp.falling ? "; darker is lower" : ""}`;
    const steps = legendOf(ramp);
    if (counts.has("n")) steps.push(["n", "not measured"]);
    this.root.querySelector("#legend-steps").replaceChildren(
      ...steps.map(([step, text]) => {
        const disc = draw("circle", { cx: 8, cy: 8, r: 6.5, fill: step === "n" ? "url(#hatch)" : null });
        const count = counts.get(step) || 0;
        return make(
          "li",
          {},
          draw("svg", { class: `swatch node s${step}`, viewBox: "0 0 16 16", "aria-hidden": "true" }, disc),
          make("span", { text }),
          make("small", { text: `${figure(count)} package${count === 1 ? "" : "s"}` }),
        );
      }),
    );
  }

  fillTable() {
    const table = this.root.querySelector("#graph-table table");
    if (!table) return;
    const most = Math.max(0, ...[...this.visible].map((place) => this.colour.values[place] ?? 0));
    const head = table.tHead.rows[0].cells[1];
    head.querySelector("a").textContent = this.colour.title;
    for (const row of table.tBodies[0].rows) {
      const place = Number(row.dataset.id);
      const value = this.colour.values[place];
      row.hidden = !this.visible.has(place);
      const cell = row.cells[1];
      const bar = draw("svg", { class: "bar", "aria-hidden": "true" }, draw("rect", { height: "100%", width: `${most > 0 && value > 0 ? Math.max(1.5, (100 * value) / most) : 0}%` }));
      cell.replaceChildren(bar, figure(value, this.colour.decimals));
      if (value === null) delete cell.dataset.v;
      else cell.dataset.v = value;
    }
    const order = parameters().get("sort");
    sortTable(table, (order || "-value").replace(/^-/, ""), !order || order.startsWith("-"));
  }

  /** Where everything stands: the whole graph, or the focus closed up. */
  placeNodes() {
    const nodes = this.graph.nodes;
    const all = nodes.map((_, place) => place);
    this.visible = this.focus < 0 ? new Set(all) : around(nodes, this.dependents, this.focus, this.hops);
    this.places = this.focus < 0 ? new Map(all.map((place) => [place, nodes[place]])) : closeUp(nodes, this.visible);
    this.elements.forEach((element, number) => {
      const place = this.places.get(number);
      element.toggleAttribute("hidden", !place);
      if (place) element.setAttribute("transform", `translate(${place.x.toFixed(1)} ${place.y.toFixed(1)})`);
    });
    this.svg.querySelector(".heads").toggleAttribute("hidden", this.focus >= 0);
    if (this.focus < 0) this.edges.forEach((edge, place) => edge.setAttribute("d", this.drawnEdges[place]));
    else {
      const drawn = this.visible.size <= 300 ? reducedEdges(nodes, this.visible) : [];
      this.edges[0].setAttribute("d", drawn.map(([from, to]) => this.curve(from, to, drawn.length <= 300)).join(""));
      this.edges[1].setAttribute("d", "");
    }
    this.showCrumbs();
  }

  curve(from, to, around = false) {
    const ends = [this.places.get(to), this.places.get(from)];
    const radii = [this.graph.nodes[to].r, this.graph.nodes[from].r];
    const others = around ? [...this.places].filter(([number]) => number !== from && number !== to) : [];
    return curve(ends, radii, others.map(([number, place]) => ({ x: place.x, y: place.y, r: this.graph.nodes[number].r })));
  }

  /** The box around what is visible. */
  box() {
    if (this.focus < 0) return { x: 0, y: 0, width: this.graph.width, height: this.graph.height };
    const found = [...this.places.values()];
    const xs = found.map((place) => place.x);
    const ys = found.map((place) => place.y);
    const [x, y] = [Math.min(...xs) - 90, Math.min(...ys) - 40];
    return { x, y, width: Math.max(...xs) + 90 - x, height: Math.max(...ys) + 60 - y };
  }

  fit() {
    this.camera.fit(this.box());
    setParameters({ view: "" });
  }

  cameraChanged() {
    this.nameNodes();
    if (!this.ready) return;
    const { width, height } = this.camera.size();
    const { k, x, y } = this.camera;
    setParameters({ view: [k.toFixed(3), ((width / 2 - x) / k).toFixed(0), ((height / 2 - y) / k).toFixed(0)].join(",") });
  }

  nameNodes() {
    if (!this.camera || !this.colour) return;
    const near = this.selected < 0 ? [] : [this.selected, ...this.graph.nodes[this.selected].needs, ...this.dependents[this.selected]];
    const values = this.colour.values;
    const falling = this.colour.better === "higher" ? -1 : 1;
    const rest = [...this.visible].sort((a, b) => falling * ((values[b] ?? -1) - (values[a] ?? -1)) || (this.graph.nodes[b].loc || 0) - (this.graph.nodes[a].loc || 0));
    const order = [...new Set([...near, ...(this.selected < 0 ? rest : [])])];
    showNames(this.svg, this.elements, this.graph.nodes, order, this.places, this.camera);
  }

  select(number, remember = true) {
    this.selected = number >= 0 && this.visible.has(number) ? number : -1;
    const node = this.graph.nodes[this.selected];
    const near = new Set(node ? [...node.needs, ...this.dependents[this.selected]] : []);
    this.canvas.classList.toggle("graph-dim", Boolean(node));
    this.elements.forEach((element, place) => {
      element.classList.toggle("selected", place === this.selected);
      element.classList.toggle("near", near.has(place));
      if (place === this.selected) element.setAttribute("aria-current", "true");
      else element.removeAttribute("aria-current");
    });
    const links = [];
    if (node) {
      for (const other of node.needs) if (this.visible.has(other)) links.push(draw("path", { class: "needs", d: this.curve(this.selected, other, true) }));
      for (const other of this.dependents[this.selected]) if (this.visible.has(other)) links.push(draw("path", { class: "needed-by", d: this.curve(other, this.selected, true) }));
    }
    this.svg.querySelector("#links").replaceChildren(...links);
    showSelected(this.root.querySelector("#graph-selected"), this, this.selected);
    this.nameNodes();
    if (!remember) return;
    this.active = this.selected >= 0 ? this.selected : this.active;
    setParameters({ select: node ? node.id : "" });
    if (node) this.camera.reveal(this.places.get(this.selected).x, this.places.get(this.selected).y);
  }

  focusOn(number, hops = 1) {
    this.focus = number;
    this.hops = hops;
    setParameters({ focus: number < 0 ? "" : this.graph.nodes[number].id, hops: number < 0 || hops === 1 ? "" : String(hops) });
    this.placeNodes();
    this.recolour();
    this.select(number < 0 ? this.selected : number);
    this.fit();
  }

  focusKey() {
    const target = this.selected >= 0 ? this.selected : this.active;
    if (this.focus >= 0 && (target === this.focus || target < 0)) this.focusOn(this.focus, Math.min(9, this.hops + 1));
    else if (target >= 0) this.focusOn(target);
    else return false;
    return true;
  }

  escape() {
    if (this.selected >= 0) this.select(-1);
    else if (this.focus >= 0) this.focusOn(-1);
    else return false;
    return true;
  }

  showCrumbs() {
    const crumbs = this.root.querySelector("#graph-crumbs");
    crumbs.hidden = this.focus < 0;
    if (this.focus < 0) return;
    const button = (text, label, action, off) => make("button", { type: "button", class: "plain", "aria-label": label, text, onclick: action, disabled: off });
    crumbs.replaceChildren(
      button("All packages", "Clear the focus", () => this.focusOn(-1)),
      "/",
      make("strong", { text: this.graph.nodes[this.focus].id }),
      make("span", { class: "quiet", text: `and what is at most ${this.hops} step${this.hops === 1 ? "" : "s"} away: ${figure(this.visible.size)} of ${figure(this.graph.nodes.length)} packages` }),
      button("Fewer", "One step fewer", () => this.focusOn(this.focus, this.hops - 1), this.hops === 1),
      button("More", "One step more", () => this.focusOn(this.focus, this.hops + 1), this.hops === 9),
      button("Clear", "Clear the focus", () => this.focusOn(-1)),
    );
  }

  clicked(event) {
    const element = event.target.closest?.(".node");
    if (element) {
      if (event.ctrlKey || event.metaKey || event.shiftKey) return;
      event.preventDefault();
      this.select(Number(element.dataset.n));
      this.canvas.focus({ preventScroll: true });
    } else if (this.selected >= 0) this.select(-1);
  }

  doubleClicked(event) {
    const element = event.target.closest?.(".node");
    if (element) this.focusOn(Number(element.dataset.n));
    else this.camera.zoom(1.6);
  }

  pressed(event) {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (step && event.shiftKey) this.camera.pan(-80 * step[0], -80 * step[1]);
    else if (step) this.move(step);
    else if (event.key === "Enter" && this.active >= 0) this.select(this.active);
    else return;
    event.preventDefault();
  }

  /** Go to the nearest visible node in a direction; what lies aside counts double. */
  move([dx, dy]) {
    const here = this.places.get(this.active);
    let [best, least] = [-1, Infinity];
    for (const [number, place] of this.places) {
      if (number === this.active) continue;
      const [x, y] = here ? [place.x - here.x, place.y - here.y] : [place.x, place.y];
      const along = x * dx + y * dy;
      const aside = Math.abs(x * dy) + Math.abs(y * dx);
      const score = here ? along + 2 * aside : x + y;
      if ((!here || along > 1) && score < least) [best, least] = [number, score];
    }
    if (best < 0) return;
    this.active = best;
    this.elements.forEach((element, number) => (element.tabIndex = number === best ? 0 : -1));
    this.elements[best].focus({ preventScroll: true });
    this.camera.reveal(this.places.get(best).x, this.places.get(best).y);
  }

  showTable(shown, remember = true) {
    this.root.classList.toggle("as-table", shown);
    this.form.querySelector('[data-do="table"]').setAttribute("aria-pressed", String(shown));
    if (remember) setParameters({ table: shown ? "1" : "" });
  }

  showPanel(shown, remember = true) {
    this.root.querySelector("#graph-view").classList.toggle("panel-closed", !shown);
    this.form.querySelector('[data-do="panel"]').setAttribute("aria-expanded", String(shown));
    if (remember) setParameters({ panel: shown ? "" : "0" });
  }
}

export function startGraph(root, chips) {
  if (root.querySelector("#graph-svg")) new GraphView(root, chips);
}

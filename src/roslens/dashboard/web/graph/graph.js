// The package graph: the picture that the server drew, with colours that follow the reader.

import { enterParameters, parameters } from "../address.js";
import { draw, figure, make } from "../dom.js";
import { sortTable, startTables } from "../tables.js";
import { colourOf, tagCounts, wantedRules } from "./counts.js";
import { curve } from "./curves.js";
import { around, closeUp, dependentsOf, reducedEdges } from "./focus.js";
import { showNames } from "./names.js";
import { contentOf } from "./panel.js";
import { legendOf, rampOf, stepOf } from "./ramp.js";
import { Stage } from "./stage.js";

const split = (text) => (text || "").split(",").map((part) => part.trim()).filter(Boolean);

class GraphView extends Stage {
  constructor(root, chips) {
    super(root, JSON.parse(root.querySelector("#graph-data").textContent), "packages");
    this.chips = chips;
    this.edges = [...this.svg.querySelectorAll("#scene > .edges")];
    this.drawnEdges = this.edges.map((edge) => edge.getAttribute("d"));
    this.dependents = dependentsOf(this.graph.nodes);
    this.start();
  }

  readAddress(now) {
    super.readAddress(now);
    this.settings = {
      colour: now.get("colour") || "findings",
      include: split(now.get("include")),
      exclude: split(now.get("exclude")),
      own: !now.get("aside"),
    };
    this.form.elements.colour.value = this.settings.colour;
    if (!this.form.elements.colour.value) this.form.elements.colour.value = this.settings.colour = "findings";
    this.form.elements.aside.checked = !this.settings.own;
    this.chips.get("include").set(this.settings.include);
    this.chips.get("exclude").set(this.settings.exclude);
  }

  readForm() {
    const form = this.form.elements;
    this.settings = { colour: form.colour.value, include: split(form.include.value), exclude: split(form.exclude.value), own: !form.aside.checked };
    enterParameters({
      colour: this.settings.colour === "findings" ? "" : this.settings.colour,
      include: this.settings.include.join(","),
      exclude: this.settings.exclude.join(","),
      aside: this.settings.own ? "" : "1",
    });
    this.recolour();
    this.select(this.selected, false);
  }

  /** Colours, legend, table and tag counts for what is visible under the filters. */
  recolour() {
    this.colour = colourOf(this.graph, this.settings);
    this.rules = wantedRules(this.graph, this.settings.include, this.settings.exclude);
    const ramp = rampOf([...this.visible].map((place) => this.colour.values[place]), this.colour.better, this.colour.decimals);
    this.ramp = ramp;
    const counts = new Map();
    this.elements.forEach((element, place) => {
      const step = stepOf(ramp, this.colour.values[place]);
      write(element, "class", element.getAttribute("class").replace(/\bs[0-5n]\b/, `s${step}`));
      const disc = element.firstElementChild;
      if (step === "n") disc.setAttribute("fill", "url(#hatch)");
      else if (disc.hasAttribute("fill")) disc.removeAttribute("fill");
      write(element, "aria-label", `${this.graph.nodes[place].id}: ${this.textOf(place)} ${this.colour.title.toLocaleLowerCase()}`);
      if (this.visible.has(place)) counts.set(step, (counts.get(step) || 0) + 1);
    });
    this.showLegend(ramp, counts);
    this.fillTable();
    const tags = tagCounts(this.graph, this.visible, this.settings.own);
    for (const chips of this.chips.values()) chips.counts = tags;
    this.nameNodes();
  }

  /** The darkest first, whatever stands around the others. */
  weight(place) {
    return 6 ** (Number(stepOf(this.ramp, this.colour.values[place])) || 0);
  }

  textOf(place) {
    return figure(this.colour.values[place], this.colour.decimals);
  }

  showLegend(ramp, counts) {
    const unit = this.colour.unit ? ` [${this.colour.unit}]` : "";
    const among = `relative to the ${figure(this.visible.size)} package${this.visible.size === 1 ? "" : "s"} shown`;
    this.root.querySelector("#legend-title").textContent = `${this.colour.title}${unit}, ${among}${ramp.falling ? "; darker is lower" : ""}`;
    const { colour, include, exclude, own } = this.settings;
    this.root.querySelector("#legend-unfiltered").hidden = !(colour.startsWith("metric:") && (include.length || exclude.length || !own));
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

  showTable(shown, remember = true) {
    if (shown) this.unfoldTable();
    super.showTable(shown, remember);
    if (this.tableIsOld) this.fillTable();
  }

  /** A table of thousands of rows is text until somebody looks at it. */
  unfoldTable() {
    const folded = this.root.querySelector("#graph-table > noscript");
    if (!folded) return;
    const section = folded.parentElement;
    // A page that was fetched is parsed as if there were no scripts.
    if (folded.firstElementChild) folded.replaceWith(...folded.childNodes);
    else section.innerHTML = folded.textContent;
    startTables(section);
  }

  /** Thousands of rows are written when somebody looks at them. */
  fillTable() {
    const table = this.root.querySelector("#graph-table table");
    if (!table) return;
    this.tableIsOld = !this.root.classList.contains("as-table");
    if (this.tableIsOld) return;
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
      if (place) write(element, "transform", `translate(${place.x.toFixed(1)} ${place.y.toFixed(1)})`);
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

  /** Lines from and to a node, drawn over the others. */
  linksOf(number) {
    const links = [];
    for (const other of this.graph.nodes[number].needs) if (this.visible.has(other)) links.push(draw("path", { class: "needs", d: this.curve(number, other, true) }));
    for (const other of this.dependents[number]) if (this.visible.has(other)) links.push(draw("path", { class: "needed-by", d: this.curve(other, number, true) }));
    return links;
  }

  describe(number) {
    return contentOf(this, number);
  }

  nameNodes() {
    if (!this.camera || !this.colour) return;
    const near = this.selected < 0 ? [] : [this.selected, ...this.neighbours(this.selected)];
    const values = this.colour.values;
    const falling = this.colour.better === "higher" ? -1 : 1;
    const rest = [...this.visible].sort((a, b) => falling * ((values[b] ?? -1) - (values[a] ?? -1)) || (this.graph.nodes[b].loc || 0) - (this.graph.nodes[a].loc || 0));
    const order = [...new Set([...near, ...(this.selected < 0 ? rest : [])])];
    showNames(this.svg, this.elements, this.graph.nodes, order, this.places, this.camera);
  }
}

/** What stands there already costs nothing, as most of thousands does when a page is opened. */
function write(element, name, value) {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}

export function startGraph(root, chips) {
  if (root.querySelector("#graph-svg")) new GraphView(root, chips);
}

// What every graph of the pages can do: zoom, pan, select, focus on what is near, go by arrows, show its table and panel.
// Everything that the reader chooses is in the address. A graph says by its own methods what it draws:
// `recolour`, `placeNodes`, `linksOf`, `box`, `nameNodes`, `describe`.

import { enterParameters, onReturn, parameters, setParameters } from "../address.js";
import { figure, make } from "../dom.js";
import { onKey } from "../keys.js";
import { Camera } from "./camera.js";
import { READABLE } from "./names.js";

/** Narrower pictures, in pixels, begin with a part of what is there, at a zoom at which its names can be read. */
const SMALL = 600;
const LEGIBLE = 0.9;
const MOST_WEIGHED = 300;

export class Stage {
  /** `what` are the words for one and many; `nodes` have an `id` and what they `needs`. */
  constructor(root, graph, what) {
    this.root = root;
    this.graph = graph;
    this.what = what;
    this.canvas = this.part("canvas");
    this.svg = this.part("svg");
    this.form = this.part("form");
    this.elements = [...this.svg.querySelectorAll(".nodes > .node")];
    this.places = new Map();
    this.selected = -1;
    this.focus = -1;
    this.hops = 1;
    this.active = -1;
  }

  /** A part of the page by its name; a single file puts the section before it. */
  part(name) {
    return this.root.querySelector(`[id="graph-${name}"], [id$=":graph-${name}"]`);
  }

  get nodes() {
    return this.graph.nodes;
  }

  start() {
    this.readAddress(parameters());
    // Until it is known which names fit, none is laid out.
    this.svg.classList.add("no-names");
    this.camera = new Camera(this.canvas, this.svg, this.svg.querySelector(".scene"), () => this.cameraChanged());
    this.listen();
    this.placeNodes();
    this.recolour();
    this.select(this.selected, false);
  }

  readAddress(now) {
    const number = (id) => this.nodes.findIndex((node) => node.id === id);
    if (now.get("focus")) this.focus = number(now.get("focus"));
    this.hops = Math.max(1, Math.min(9, Number.parseInt(now.get("hops") || "1", 10) || 1));
    if (now.get("select")) this.selected = number(now.get("select"));
    this.showTable(Boolean(now.get("table")), false);
    this.showPanel(now.get("panel") !== "0", false);
  }

  /** Show what the address says, after the reader went back or forth in it. */
  restore() {
    if (!this.root.checkVisibility() || !this.ready) return;
    this.focus = -1;
    this.selected = -1;
    this.readAddress(parameters());
    this.placeNodes();
    this.recolour();
    this.select(this.selected, false);
    this.showStart();
  }

  showStart() {
    const [k, x, y] = (parameters().get("view") || "").split(",").map(Number);
    if (k > 0 && Number.isFinite(x) && Number.isFinite(y)) {
      this.camera.showAt(k, x, y);
    } else this.startView();
  }

  /** Whether a picture whose names could not be read begins with a part of it. */
  opensNear(width) {
    return width < SMALL;
  }

  /** How much it matters that a node is in sight at the start. */
  weight(number) {
    return 1 + this.neighbours(number).length;
  }

  /** All of the picture; where the screen is too small for that, the part of it where most is. */
  startView() {
    this.fit();
    const { width, height } = this.camera.size();
    if (!this.opensNear(width) || this.camera.k >= READABLE || !this.places.size) return;
    const [across, down] = [width / LEGIBLE, height / LEGIBLE];
    const near = (a, b) => Math.abs(a.x - b.x) < 0.45 * across && Math.abs(a.y - b.y) < 0.45 * down;
    const spots = [...this.places].map(([number, { x, y }]) => ({ x, y, weight: this.weight(number) }));
    spots.sort((a, b) => b.weight - a.weight).splice(MOST_WEIGHED);
    const total = (spot) => spots.reduce((sum, other) => sum + (near(spot, other) ? other.weight : 0), 0);
    const best = spots.map((spot) => ({ spot, weight: total(spot) })).reduce((a, b) => (b.weight > a.weight ? b : a)).spot;
    const box = this.box();
    // At the ends of the picture nothing is shown beyond it.
    const middle = (at, from, size, room) => (size < room ? from + size / 2 : Math.max(from + room / 2, Math.min(from + size - room / 2, at)));
    this.camera.showAt(LEGIBLE, middle(best.x, box.x, box.width, across), middle(best.y, box.y, box.height, down));
  }

  listen() {
    const actions = {
      "zoom-in": () => this.camera.zoom(1.4),
      "zoom-out": () => this.camera.zoom(1 / 1.4),
      "zoom-all": () => this.fit(),
      table: () => this.showTable(!this.root.classList.contains("as-table")),
      panel: () => this.showPanel(this.part("view").classList.contains("panel-closed")),
    };
    for (const [name, action] of Object.entries(actions)) this.root.querySelector(`.buttons [data-do="${name}"]`).addEventListener("click", action);
    this.form.addEventListener("change", () => this.readForm());
    this.form.addEventListener("submit", (event) => event.preventDefault());
    this.canvas.tabIndex = 0;
    for (const element of this.elements) element.tabIndex = -1;
    this.canvas.addEventListener("click", (event) => this.clicked(event));
    this.canvas.addEventListener("dblclick", (event) => this.doubleClicked(event));
    this.canvas.addEventListener("dragstart", (event) => event.preventDefault());
    this.canvas.addEventListener("keydown", (event) => this.pressed(event));
    // The observer tells the first size too, before anything is painted; to ask for it here would lay the page out twice.
    let before = 0;
    new ResizeObserver(() => {
      const { width } = this.camera.resized();
      if (!before && width) this.showStart();
      before = width;
      this.ready = true;
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
    onReturn(() => this.restore());
  }

  openSelected() {
    const href = this.selected < 0 ? null : this.elements[this.selected].getAttribute("href");
    if (!href) return false;
    location.href = href;
    return true;
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

  /** Numbers of the nodes joined to one. */
  neighbours(number) {
    return [...this.nodes[number].needs, ...this.dependents[number]];
  }

  /** Whether a node can be selected; a graph may tell of more than it draws. */
  selectable(number) {
    return this.visible.has(number);
  }

  select(number, remember = true) {
    this.selected = number >= 0 && this.selectable(number) ? number : -1;
    const node = this.nodes[this.selected];
    const near = new Set(node ? this.neighbours(this.selected) : []);
    this.canvas.classList.toggle("graph-dim", Boolean(node));
    this.elements.forEach((element, place) => {
      element.classList.toggle("selected", place === this.selected);
      element.classList.toggle("near", near.has(place));
      if (place === this.selected) element.setAttribute("aria-current", "true");
      else element.removeAttribute("aria-current");
    });
    this.svg.querySelector(".links").replaceChildren(...(node ? this.linksOf(this.selected) : []));
    this.tell(this.describe(this.selected));
    this.nameNodes();
    if (!remember) return;
    this.active = this.selected >= 0 ? this.selected : this.active;
    enterParameters({ select: node ? node.id : "" });
    const place = node && this.places.get(this.selected);
    if (place) this.camera.reveal(place.x, place.y);
  }

  /** Fill the panel. Whoever chose something in it by keys goes on from there. */
  tell(parts) {
    const panel = this.part("selected");
    const inside = panel.contains(document.activeElement);
    panel.replaceChildren(...parts.filter((part) => part !== null));
    const heading = panel.querySelector("h2");
    if (!inside || !heading) return;
    heading.tabIndex = -1;
    heading.focus({ preventScroll: true });
  }

  focusOn(number, hops = 1) {
    this.focus = number;
    this.hops = hops;
    enterParameters({ focus: number < 0 ? "" : this.nodes[number].id, hops: number < 0 || hops === 1 ? "" : String(hops) });
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
    const crumbs = this.part("crumbs");
    const pressed = crumbs.contains(document.activeElement) ? document.activeElement.getAttribute("aria-label") : "";
    crumbs.hidden = this.focus < 0;
    if (this.focus < 0) {
      if (pressed) this.canvas.focus({ preventScroll: true });
      return;
    }
    const button = (text, label, action, off) => make("button", { type: "button", class: "plain", "aria-label": label, text, onclick: action, disabled: off });
    crumbs.replaceChildren(
      button(`All ${this.what}`, "Clear the focus", () => this.focusOn(-1)),
      "/",
      make("strong", { text: this.nodes[this.focus].name || this.nodes[this.focus].id }),
      make("span", { class: "quiet", text: `and what is at most ${this.hops} step${this.hops === 1 ? "" : "s"} away: ${figure(this.visible.size)} of ${figure(this.total ?? this.nodes.length)} ${this.what}` }),
      button("Fewer", "One step fewer", () => this.focusOn(this.focus, this.hops - 1), this.hops === 1),
      button("More", "One step more", () => this.focusOn(this.focus, this.hops + 1), this.hops === 9),
      button("Clear", "Clear the focus", () => this.focusOn(-1)),
    );
    if (pressed) (crumbs.querySelector(`[aria-label="${pressed}"]:enabled`) || crumbs.querySelector("button")).focus({ preventScroll: true });
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
    const table = this.root.querySelector(".graph-table");
    const held = (shown ? this.part("view") : table)?.contains(document.activeElement);
    this.root.classList.toggle("as-table", shown);
    // What was hidden cannot keep the focus: it goes to what has come in its place.
    if (held) (shown ? table?.querySelector(".scroll") : this.canvas)?.focus({ preventScroll: true });
    this.form.querySelector('[data-do="table"]').setAttribute("aria-pressed", String(shown));
    if (remember) setParameters({ table: shown ? "1" : "" });
  }

  showPanel(shown, remember = true) {
    this.part("view").classList.toggle("panel-closed", !shown);
    this.form.querySelector('[data-do="panel"]').setAttribute("aria-expanded", String(shown));
    if (remember) setParameters({ panel: shown ? "" : "0" });
  }
}

// The side panel of the computation graph: what is wrong, what is joined to what is selected, and the lines that make it.

import { figure, glyph, make } from "../dom.js";
import { Stage } from "./stage.js";

const counted = (count, what) => `${figure(count)} ${what}${count === 1 ? "" : "s"}`;
const MOST = 40;
const cellOf = (row, key) => row.cells[[...row.closest("table").tHead.rows[0].cells].findIndex((head) => head.dataset.key === key)];
const textOf = (row, key) => cellOf(row, key)?.textContent.trim() || "";

export class TellingStage extends Stage {
  /** Rows of a table by the number of their node or endpoint, read when they are first asked for. */
  get rows() {
    const of = (name) => new Map([...this.root.querySelectorAll(`.table[id$="${name}"] tbody tr[data-id]`)].map((row) => [Number(row.dataset.id), row]));
    this.read ||= { nodes: of("nodes"), endpoints: of("endpoints"), sure: of("findings"), doubted: of("doubts") };
    return this.read;
  }

  openLine() {
    const link = this.part("selected").querySelector("a.place");
    if (link) link.click();
    return Boolean(link);
  }

  describe(number) {
    return number < 0 ? this.describeAll() : this.describeOne(number);
  }

  pick(number, more = "") {
    return make("li", {}, make("button", { type: "button", class: "pick", text: this.graph.nodes[number].name, onclick: () => this.select(number) }), more ? make("span", { class: "quiet", text: more }) : null);
  }

  describeAll() {
    const nodes = [...this.visible].filter((number) => this.graph.nodes[number].kind === "node").length;
    const searched = this.canvas.classList.contains("graph-find");
    return [
      make("h2", { text: `${counted(nodes, "node")}${this.settings.lines ? "" : ` and ${figure(this.visible.size - nodes)} topics, services and actions`}` }),
      make("p", { class: "quiet", text: "Select an element to see its ends, how sure they are and the lines that make them." }),
      ...(searched ? this.listFound() : this.listFindings()),
      ...this.listNodes(searched ? this.found : []),
    ];
  }

  listFound() {
    return [
      make("h3", { text: `Found (${figure(this.found.length)})` }),
      this.found.length ? make("ul", {}, ...this.found.slice(0, MOST).map((one) => this.pick(one, this.graph.nodes[one].severity || this.graph.nodes[one].kind))) : make("p", { class: "quiet", text: "None among those shown." }),
    ];
  }

  /** Every finding, whatever is drawn; of one element where a number is given. */
  listFindings(number = -1) {
    const about = (rows) => [...rows].filter(([place]) => number < 0 || this.graph.about[place].includes(number));
    const [sure, doubted] = [about(this.rows.sure), about(this.rows.doubted)];
    if (!sure.length && !doubted.length) return number < 0 ? [make("h3", { text: "Findings" }), make("p", { class: "quiet", text: "None." })] : [];
    const list = (found) => [
      make("ul", { class: "reported" }, ...found.slice(0, MOST).map(([place, row]) => this.findingItem(place, row, number))),
      found.length > MOST ? make("p", { class: "quiet", text: `${MOST} of ${figure(found.length)} shown; the table below has all.` }) : null,
    ].filter(Boolean);
    return [
      make("h3", { text: `Findings (${figure(sure.length)})` }),
      ...(sure.length ? list(sure) : []),
      doubted.length ? make("details", { open: number >= 0 }, make("summary", { text: `${figure(doubted.length)} more in doubt` }), ...list(doubted)) : null,
    ];
  }

  findingItem(place, row, number) {
    const about = this.graph.about[place].filter((one) => one !== number);
    const where = cellOf(row, "place");
    return make(
      "li",
      {},
      make("div", {}, glyph(textOf(row, "severity")), " ", ...this.copied(cellOf(row, "message"))),
      make("div", { class: "quiet" }, ...about.slice(0, 4).flatMap((one) => [this.elementLink(one), " "]), ...(where?.textContent.trim() ? this.copied(where) : [])),
    );
  }

  /** What selects an element; one that is left out has a page still. */
  elementLink(number) {
    const { name } = this.graph.nodes[number];
    if (this.selectable(number)) return make("button", { type: "button", class: "pick", text: name, onclick: () => this.select(number) });
    const href = this.elements[number].getAttribute("href");
    return href ? make("a", { href, text: name, title: "left out of the picture" }) : make("span", { text: name });
  }

  /** All nodes that are shown, those first that most is joined to; who looks for others finds them by name. */
  listNodes(listed) {
    const joined = (number) => this.graph.nodes[number].needs.length + this.dependents[number].length;
    const left = [...this.visible].filter((number) => this.graph.nodes[number].kind === "node" && !listed.includes(number)).sort((a, b) => joined(b) - joined(a));
    if (!left.length) return [];
    return [
      make("h3", { text: listed.length ? `Other nodes (${figure(left.length)})` : `Nodes (${figure(left.length)})` }),
      make("ul", {}, ...left.slice(0, MOST).map((one) => this.pick(one))),
      left.length > MOST ? make("p", { class: "quiet", text: `${MOST} of ${figure(left.length)} shown, those that most is joined to; find others by name.` }) : null,
    ];
  }

  describeOne(number) {
    const node = this.graph.nodes[number];
    const isNode = node.kind === "node";
    const href = this.elements[number].getAttribute("href");
    const row = this.rows.nodes.get(number);
    return [
      make("h2", { text: node.name }),
      make("p", { class: "quiet", text: [isNode && row ? textOf(row, "kind") : node.kind, node.sure === "certain" ? "" : node.sure].filter(Boolean).join(", ") }),
      ...(isNode && row ? [this.placeOf("Started at ", cellOf(row, "started")), this.placeOf("Defined at ", cellOf(row, "defined")), this.placeOf("Only if ", cellOf(row, "conditions"))] : []),
      make(
        "div",
        { class: "actions" },
        href ? make("a", { href, text: "Open its page" }) : null,
        this.visible.has(number) ? make("button", { type: "button", class: "pick", text: "Focus on it", onclick: () => this.focusOn(number) }) : null,
        make("button", { type: "button", class: "pick", text: "Clear", onclick: () => this.select(-1) }),
      ),
      ...this.listWay(),
      ...this.listFindings(number),
      ...this.endsOf(number, isNode),
    ];
  }

  /** A line between two nodes: the topics, services and actions by which something flows. */
  describeLine(one) {
    return [
      make("h2", { text: `${this.graph.nodes[one.source].name} to ${this.graph.nodes[one.target].name}` }),
      make("h3", { text: `By ${one.by.length === 1 ? "one name" : `${figure(one.by.length)} names`}` }),
      make("ul", {}, ...one.by.map((number) => this.pick(number, this.graph.nodes[number].severity || this.graph.nodes[number].kind))),
    ];
  }

  listWay() {
    const found = this.way();
    if (!found) return [];
    const { name } = this.graph.nodes[found.to];
    const text = found.way.length ? `Way to ${name} (${counted(found.way.length - 1, "step")})` : `No way leads along the arrows to ${name}`;
    return [make("h3", { text }), make("ol", { class: "way" }, ...found.way.map((one) => this.pick(one, this.graph.nodes[one].kind)))];
  }

  placeOf(title, cell) {
    return cell?.textContent.trim() ? make("p", { class: "where" }, title, ...this.copied(cell)) : null;
  }

  copied(cell) {
    return [...cell.cloneNode(true).childNodes].map((part) => {
      if (part.tagName === "A") part.classList.add("place");
      return part;
    });
  }

  /** The endpoints of a node or at a topic, by what they do, from the rows of the table. */
  endsOf(number, isNode) {
    const groups = new Map();
    this.graph.wires.forEach((wire) => {
      if (wire.source !== number && wire.target !== number) return;
      if (wire.implicit && this.settings.noise.includes("implicit")) return;
      const other = wire.source === number ? wire.target : wire.source;
      for (const end of wire.ends) {
        const row = this.rows.endpoints.get(end);
        const does = row ? textOf(row, "does") : "";
        groups.set(does, [...(groups.get(does) || []), this.endItem(other, row)]);
      }
    });
    const found = [...groups].sort(([a], [b]) => (a < b ? -1 : 1));
    if (!found.length) return [make("p", { class: "quiet", text: "Nothing is joined to it." })];
    return found.flatMap(([does, items]) => [
      make("h3", { text: `${isNode ? does.charAt(0).toLocaleUpperCase() + does.slice(1) : `Who ${does}`} (${items.length})` }),
      make("ul", { class: "ends" }, ...items.slice(0, MOST)),
      items.length > MOST ? make("p", { class: "quiet", text: `${MOST} of ${items.length} shown; its page has all` }) : null,
    ]);
  }

  endItem(other, row) {
    const item = this.pick(other);
    if (!row) return item;
    const [type, qos, conditions, sure] = ["type", "qos", "conditions", "sure"].map((key) => textOf(row, key));
    const lines = [[type, qos].filter(Boolean).join(" · "), conditions && `only if ${conditions}`, sure !== "certain" && sure].filter(Boolean);
    item.append(make("div", { class: "quiet" }, ...lines.map((one) => make("div", { text: one })), make("div", { class: "where" }, ...this.copied(cellOf(row, "place")))));
    return item;
  }
}

// Draws what is wrong and why, as the server does in causes.html.

import { draw, make } from "../dom.js";
import { nameOf } from "./entity.js";

const cut = (text, most) => (text.length > most ? `${text.slice(0, most - 1)}…` : text);

/** Keeps the graph of causes of a page. */
export class Causes {
  constructor(section) {
    this.section = section;
    this.said = "";
  }

  update(snapshot) {
    const { boxes = [], lines = [], width = 0, height = 0, left_out: left = "" } = snapshot.causes || {};
    const said = JSON.stringify([boxes, lines, left]);
    if (said === this.said) return;
    this.said = said;
    this.section.hidden = boxes.length === 0;
    const svg = this.section.querySelector("svg");
    for (const [name, value] of [["width", width], ["height", height], ["viewBox", `0 0 ${width} ${height}`]]) svg.setAttribute(name, value);
    svg.replaceChildren(...lines.map(line), ...lines.map(words), ...boxes.map(box));
    this.section.querySelector("ul").replaceChildren(...lines.map((one) => lineOf(one, boxes)));
    const more = this.section.querySelector("p");
    more.hidden = !left;
    more.textContent = left;
  }
}

function line(one) {
  return draw("g", { class: "tie" }, draw("title", { text: one.evidence }), draw("path", { d: one.path }));
}

// Above all lines, of which none goes through them.
function words(one) {
  return draw("g", { class: "why" }, draw("title", { text: one.evidence }),
    draw("text", { x: one.x, y: one.y, text: `← ${one.relation}` }),
    draw("text", { class: "shows", x: one.x, y: one.y + 18, text: cut(one.evidence, 25) }));
}

function box(one) {
  const state = one.state === "unjudged" ? "not judged" : one.state;
  return draw("g", { class: `cause ${one.state}${one.first ? " first" : ""}`, "data-select": one.entity }, draw("title", { text: one.entity }),
    draw("rect", { x: one.x, y: one.y, width: 200, height: 34, rx: 5 }),
    draw("text", { x: one.x + 10, y: one.y + 15, text: cut(one.name, 26) }),
    draw("text", { class: "is", x: one.x + 10, y: one.y + 28, text: `${one.kind}, ${state}${one.first ? ", first cause" : ""}` }));
}

function lineOf(one, boxes) {
  const parts = [nameOf(boxes[one.effect].entity), ` ${one.relation} `, nameOf(boxes[one.cause].entity)];
  if (one.evidence) parts.push(": ", make("bdi", { text: one.evidence }));
  return make("li", {}, ...parts);
}

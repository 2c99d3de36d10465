// The way along the arrows from what is chosen to another part of the picture, and how old data is at its end.

import { setParameters, parameters } from "../address.js";
import { make, settled } from "../dom.js";
import { wayBetween } from "../graph/way.js";
import { span } from "./states.js";

const nameOf = (entity) => entity.slice(entity.indexOf(":") + 1);

export class Way {
  /** `picture` is asked for its links; `input` names the end, `said` tells the way, `names` are offered. */
  constructor({ input, said, names }, picture) {
    Object.assign(this, { input, said, names, picture, offered: "" });
    input.value = parameters().get("to") || "";
    input.addEventListener("input", settled(() => {
      setParameters({ to: input.value.trim() });
      this.show();
    }, 120));
  }

  /** Tell the way as it is now. */
  show() {
    const { picture } = this;
    const names = [...picture.items.keys()].map(nameOf);
    if (names.join("\n") !== this.offered) {
      this.offered = names.join("\n");
      this.names.replaceChildren(...names.map((name) => make("option", { value: name })));
    }
    const wanted = this.input.value.trim();
    const found = wanted && picture.items.has(picture.selected) ? this.find(picture.selected, wanted) : null;
    picture.svg.classList.toggle("on-way", Boolean(found?.hops.length));
    if (found?.hops.length) picture.bright(new Set(found.stops), new Set(found.hops.map(([start, end]) => picture.lines.get(`${start.entity}\n${end.entity}`))));
    const text = !wanted ? "" : !picture.selected ? "Choose where it begins." : found ? described(nameOf(picture.selected), wanted, found) : `${wanted} is not in the picture.`;
    if (this.said.textContent !== text) this.said.textContent = text;
  }

  /** The stops of the shortest way and the links between them; null where the end is not drawn. */
  find(from, wanted) {
    const keys = [...this.picture.items.keys()];
    const end = keys.findIndex((key) => nameOf(key) === wanted);
    if (end < 0) return null;
    const number = new Map(keys.map((key, place) => [key, place]));
    const nodes = keys.map(() => ({ needs: [] }));
    const between = new Map();
    for (const link of this.picture.links) {
      nodes[number.get(link[0].entity)].needs.push(number.get(link[1].entity));
      between.set(`${link[0].entity}\n${link[1].entity}`, link);
    }
    const way = wayBetween(nodes, new Set(nodes.keys()), number.get(from), end).map((place) => keys[place]);
    return { stops: way, hops: way.slice(1).map((stop, place) => between.get(`${way[place]}\n${stop}`)) };
  }
}

/** Each time something is received, data has become older by the age of that connection. */
function described(from, to, { hops }) {
  if (!hops.length) return from === to ? "It begins there." : `No way leads along the arrows from ${from} to ${to}.`;
  const received = hops.filter(([, end]) => end.entity.startsWith("node:"));
  const parts = received.map(([start, , link]) => {
    const by = link.by?.length ? link.by.map(nameOf).join(", ") : nameOf(start.entity);
    const [value, what] = known(link.age) ? [link.age, "age"] : known(link.lag) ? [link.lag, "latency"] : [null, ""];
    return { value, text: value === null ? `${by}: no age known` : `${by}: ${what} ${span(value)}` };
  });
  const sum = parts.reduce((total, { value }) => total + (value || 0), 0);
  const lacking = parts.filter(({ value }) => value === null).length;
  const words = parts.length === 0 ? "" : lacking === parts.length ? "how old data is there is not known" : `data is ${lacking ? "at least " : ""}${span(sum)} old there, what nodes take to answer left out`;
  return [`${hops.length} step${hops.length === 1 ? "" : "s"} from ${from} to ${to}`, parts.map(({ text }) => text).join(", "), words].filter(Boolean).join("; ");
}

const known = (value) => value !== undefined && value !== null;

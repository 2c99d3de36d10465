// The latest changes and what could not be observed.

import { make } from "../dom.js";
import { nameOf } from "./entity.js";
import { sign } from "./states.js";

export class Happened {
  constructor(happened, failures, none) {
    Object.assign(this, { happened, failures, none });
    this.shown = ["", ""];
  }

  update(snapshot) {
    this.fill(0, this.happened, snapshot.happened, (one) => [
      make("button", { type: "button", class: "plain when", "data-time": one.time, title: "Show this moment", text: one.when.trim() }), one.state ? sign(one.state) : "", " ",
      nameOf(one.entity, one.name), ` ${one.what} `, make("bdi", { class: "quiet", text: one.detail || "" }),
    ]);
    this.fill(1, this.failures, snapshot.failures, (one) => [make("bdi", { text: one })]);
  }

  fill(place, list, entries, parts) {
    const form = JSON.stringify(entries);
    if (form === this.shown[place]) return;
    this.shown[place] = form;
    list.replaceChildren(...entries.map((one) => make("li", {}, ...parts(one))));
    this.none[place].hidden = entries.length > 0;
  }
}

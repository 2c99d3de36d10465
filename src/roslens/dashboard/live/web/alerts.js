// What is wrong: first causes, and folded under each what follows from it.

import { make } from "../dom.js";
import { toSource } from "./source.js";
import { duration, sign } from "./states.js";

const MOST = 100;
const QUIET_MS = 5000;

export class Alerts {
  /** `select` is called with the id of an entity that was clicked. */
  constructor(element, said, select) {
    Object.assign(this, { element, said, select });
    this.shown = new Map();
    this.known = null;
    this.spoken = -Infinity;
    this.waiting = [];
    element.replaceChildren();
    this.rest = make("p", { class: "cut", hidden: true });
    setInterval(() => this.speak(), 1000);
  }

  update(snapshot) {
    const alerts = snapshot.alerts.slice(0, MOST);
    const left = new Set(this.shown.keys());
    let next = this.element.firstChild;
    for (const alert of alerts) {
      left.delete(alert.key);
      let shown = this.shown.get(alert.key);
      const form = JSON.stringify(alert);
      if (!shown || shown.form !== form) {
        const fresh = this.build(alert, form, shown?.element.querySelector("details")?.open);
        if (shown) {
          if (next === shown.element) next = fresh.element;
          shown.element.replaceWith(fresh.element);
        }
        shown = fresh;
        this.shown.set(alert.key, shown);
      }
      for (const [time, since, when] of shown.times) {
        const text = snapshot.live ? `for ${duration(snapshot.time - since)}` : `since ${when.trim()}`;
        if (time.textContent !== text) time.textContent = text;
      }
      if (shown.element === next) next = next.nextSibling;
      else this.element.insertBefore(shown.element, next);
    }
    for (const key of left) {
      this.shown.get(key).element.remove();
      this.shown.delete(key);
    }
    const more = snapshot.alerts.length - alerts.length;
    this.rest.hidden = more <= 0;
    if (more > 0) {
      this.rest.textContent = `${more} more; the table has them all.`;
      this.element.append(this.rest);
    } else this.rest.remove();
    this.announce(alerts);
  }

  build(alert, form, open) {
    const times = [];
    const parts = [this.line(alert, times)];
    const follows = alert.follows || [];
    if (follows.length) {
      const lines = follows.slice(0, MOST).map((one) => this.line(one, times));
      parts.push(make("details", { class: "follows", open: open || false },
        make("summary", { text: follows.length === 1 ? "1 follows from it" : `${follows.length} follow from it` }), ...lines));
    }
    return { element: make("div", { class: "cause" }, ...parts), times, form };
  }

  line(alert, times) {
    const time = make("time", { title: `since ${alert.when.trim()}` });
    times.push([time, alert.since, alert.when]);
    const name = make("a", { class: "name", href: "#tree", title: `${alert.kind} ${alert.name}`, "data-entity": alert.entity,
      onclick: (event) => { event.preventDefault(); this.select(alert.entity); } }, make("bdi", { text: alert.name }));
    const about = [alert.evidence, alert.group && `group ${alert.group}`, alert.where && `expected in ${alert.where}`];
    return make("div", { class: `alert${alert.severity === "error" ? " grave" : ""}` },
      make("span", { class: "mark" }, sign(alert.state, alert.severity), alert.state),
      name,
      make("span", { class: "says", title: about.filter(Boolean).join("\n") }, make("bdi", { text: alert.sentence })),
      make("span", { class: "since" }, time, " ", ...toSource(alert.entity, "source")));
  }

  /** Remember what is new, to be said to who cannot see it. */
  announce(alerts) {
    const keys = new Set(alerts.map((alert) => alert.key));
    if (this.known) this.waiting.push(...alerts.filter((alert) => !this.known.has(alert.key)).map((alert) => alert.name));
    this.known = keys;
    this.speak();
  }

  speak() {
    if (!this.waiting.length || performance.now() - this.spoken < QUIET_MS) return;
    this.spoken = performance.now();
    const names = this.waiting.splice(0);
    this.said.textContent = `New: ${names.slice(0, 3).join(", ")}${names.length > 3 ? ` and ${names.length - 3} more` : ""}`;
  }
}

// What is wrong: first causes, and folded under each what follows from it.

import { make } from "../dom.js";
import { toSource } from "./source.js";
import { duration, sign } from "./states.js";

const MOST = 100;
const QUIET_MS = 5000;

export class Alerts {
  /** `select` is called with the id of an entity that was clicked. */
  constructor(element, muted, said, select) {
    Object.assign(this, { element, muted, said, select, may: element.dataset.may === "handle" });
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
    const more = (snapshot.wrong || 0) - alerts.length;
    this.rest.hidden = more <= 0;
    this.silenced(snapshot.muted || []);
    if (more > 0) {
      this.rest.textContent = `${more.toLocaleString("en-US")} more; the table has them all.`;
      this.element.append(this.rest);
    } else this.rest.remove();
    this.announce(alerts);
  }

  /** What somebody wants to hear nothing of for a while: it is no less wrong. */
  silenced(alerts) {
    const form = JSON.stringify(alerts.map((one) => [one.key, one.message, one.until]));
    if (form === this.mutedForm) return;
    this.mutedForm = form;
    this.muted.hidden = !alerts.length;
    this.muted.querySelector("summary").textContent = `${alerts.length} muted`;
    this.muted.querySelector("div").replaceChildren(...alerts.map((one) => this.line(one, [])));
  }

  /** What may be done with an alert, by who may. */
  tools(alert) {
    if (!this.may || alert.cause) return [];
    const button = (text, how, seconds, title) => make("button", { type: "button", class: "plain", text, title, onclick: () => this.handle(alert.key, how, seconds) });
    if (alert.handled) return [button("Undo", "undo", 0, `No longer ${alert.handled}`)];
    const length = make("select", { "aria-label": `Mute ${alert.name} for`, onchange: (event) => event.target.value && this.handle(alert.key, "mute", event.target.value) },
      ...[["", "Mute…"], [600, "10 min"], [3600, "1 h"], [28_800, "8 h"], [86_400, "1 day"]].map(([value, text]) => make("option", { value, text })));
    return [button("Acknowledge", "acknowledge", 0, "Mark it as being taken care of"), length];
  }

  async handle(key, how, seconds) {
    try {
      const answer = await fetch("handle", { method: "POST", body: new URLSearchParams({ key, how, for: seconds }), redirect: "manual" });
      if (answer.type !== "opaqueredirect") this.said.textContent = (await answer.text()).trim();
    } catch {
      // The page says by itself that nothing is heard of the monitor.
    }
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
      make("span", { class: "says", title: about.filter(Boolean).join("\n") }, make("bdi", { text: alert.message }), alert.why ? make("span", { class: "why-line" }, "why: ", make("bdi", { text: alert.why })) : "", alert.handled ? make("span", { class: "noted", text: ` ${alert.handled} by ${alert.by}${alert.until ? ` until ${alert.until}` : ""}` }) : ""),
      make("span", { class: "since" }, ...this.tools(alert), time, " ", ...toSource(alert.entity, "source")));
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

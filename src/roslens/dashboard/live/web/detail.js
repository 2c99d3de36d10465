// All that is known of what was chosen: what constraints say of it, and every signal.

import { make } from "../dom.js";
import { sign, word } from "./states.js";

export class Detail {
  /** `close` is called when the panel was closed by hand. */
  constructor(element, close) {
    this.element = element;
    this.close = close;
    this.entity = "";
    this.asked = "";
  }

  show(entity) {
    if (this.entity === entity) return;
    this.entity = entity;
    this.asked = "";
    if (!entity) this.element.hidden = true;
    else this.ask();
  }

  /** Ask anew where there is a newer snapshot. */
  update(snapshot) {
    if (this.entity && this.asked !== snapshot.when) this.ask(snapshot.when);
  }

  async ask(when = "") {
    const { entity } = this;
    this.asked = when;
    try {
      const answer = await fetch(`detail.json?at=${encodeURIComponent(entity)}`);
      if (entity !== this.entity) return;
      if (answer.status === 200) this.draw(await answer.json());
      else this.element.hidden = true;
    } catch {
      // The page says by itself that nothing is heard of the monitor.
    }
  }

  draw(about) {
    if (about.entity !== this.entity) return;
    const { scrollTop } = this.element;
    const focused = this.element.contains(document.activeElement);
    const shut = make("button", { type: "button", class: "plain", text: "Close", onclick: () => this.close() });
    const judged = about.judgements || [];
    this.element.replaceChildren(
      make("div", { class: "bar-line" }, make("h3", {}, `${about.kind} `, make("bdi", { text: about.name })), shut),
      make("p", { class: "quiet", text: [about.observed, about.below, `at ${about.when}`].filter(Boolean).join(" · ") }),
      judged.length ? table(["Constraint", "State", "Value", "Expected", "Since", "What shows it"], judged.map(judgement)) : make("p", { class: "quiet", text: "No constraint is about it." }),
      about.values?.length ? table(["Signal", "Value", "What it is"], about.values.map((one) => [one.title, one.shown, one.text])) : "",
    );
    this.element.hidden = false;
    this.element.scrollTop = scrollTop;
    if (focused) shut.focus({ preventScroll: true });
  }
}

function judgement(one) {
  const why = [one.evidence, one.leads_to && `→ ${one.leads_to}`, one.cause && (one.why ? `because ${one.why}` : `because of ${one.cause}`), one.text].filter(Boolean).join("; ");
  const state = make("span", { class: "mark" }, sign(one.state, one.severity), word(one.state));
  return [make("span", { title: one.where || "", text: one.expectation }), state, one.value || "unknown", one.expected || "", one.since, why];
}

function table(headings, rows) {
  return make("table", {},
    make("thead", {}, make("tr", {}, ...headings.map((text) => make("th", { scope: "col", text })))),
    make("tbody", {}, ...rows.map((cells) => make("tr", {}, ...cells.map((one) => make("td", {}, typeof one === "string" ? make("bdi", { text: one }) : one))))));
}

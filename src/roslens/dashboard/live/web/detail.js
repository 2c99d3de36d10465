// All that is known of what was chosen: what constraints say of it, every signal, and these over time.

import { make } from "../dom.js";
import { toSource } from "./source.js";
import { sign, word } from "./states.js";
import { Why } from "./why.js";

/** Who does one of these looks where they want to. */
const BY_HAND = ["wheel", "touchmove", "keydown", "pointerdown"];

export class Detail {
  /**
   * `close` is called when the panel was closed by hand, `grown` when it takes more room for what was just chosen; `at`
   * returns the moment that is shown, null for now.
   */
  constructor(element, { close, at, plots, grown }) {
    Object.assign(this, { element, close, at, plots, grown, entity: "", asked: "", settling: false });
    this.said = make("div", {});
    this.signals = make("div", {});
    this.why = new Why(at);
    element.replaceChildren(this.said, this.why.element, ...(plots ? [plots.element] : []), this.signals);
    // It comes in parts, which push away what stands below.
    new ResizeObserver(() => this.settling && this.grown?.()).observe(element);
    for (const name of BY_HAND) addEventListener(name, () => { this.settling = false; }, { passive: true, capture: true });
  }

  show(entity) {
    if (this.entity === entity) return;
    this.entity = entity;
    this.asked = "";
    this.settling = Boolean(entity);
    this.plots?.show(entity);
    this.why.clear();
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
    const at = this.at();
    try {
      const answer = await fetch(`detail.json?select=${encodeURIComponent(entity)}${at === null ? "" : `&at=${at}`}`);
      if (entity !== this.entity || at !== this.at()) return;
      if (answer.status === 200) this.draw(await answer.json());
      else this.draw({ entity, kind: entity.split(":")[0], name: entity.slice(entity.indexOf(":") + 1), when: "", gone: true });
    } catch {
      // The page says by itself that nothing is heard of the monitor.
    }
  }

  draw(about) {
    if (about.entity !== this.entity) return;
    const { scrollTop } = this.element;
    const focused = this.said.contains(document.activeElement);
    const opened = this.signals.querySelector("details")?.open ?? true;
    const shut = make("button", { type: "button", class: "plain", text: "Close", onclick: () => this.close() });
    const judged = about.judgements || [];
    const values = about.values || [];
    this.said.replaceChildren(
      make("div", { class: "bar-line" }, make("h3", {}, `${about.kind} `, make("bdi", { text: about.name })), ...toSource(about.entity, "In the source"), shut),
      make("p", { class: "quiet", text: about.gone ? "It is not there." : [about.observed, about.below, `at ${about.when}`].filter(Boolean).join(" · ") }),
      judged.length ? table("What is expected of it", ["Constraint", "State", "Value", "Expected", "Since", "What shows it", "Written in"], judged.map(judgement)) : about.gone ? "" : make("p", { class: "quiet", text: "Not judged: no constraint is about it." }),
    );
    this.signals.replaceChildren(
      values.length ? make("details", { open: opened }, make("summary", { text: `Every signal that was sampled (${values.length})` }), table("Signals", ["Signal", "Value", "What it is"], values.map((one) => [one.title, one.shown, one.text]))) : "",
    );
    this.why.update(about);
    this.element.hidden = false;
    this.element.scrollTop = scrollTop;
    if (focused) shut.focus({ preventScroll: true });
  }
}

function judgement(one) {
  const why = [one.evidence, one.leads_to && `→ ${one.leads_to}`, one.cause && (one.why ? `because ${one.why}` : `because of ${one.cause}`), one.text].filter(Boolean).join("; ");
  const state = make("span", { class: "mark" }, sign(one.state, one.severity), word(one.state));
  return [one.expectation, state, one.value || "unknown", one.expected || "", one.since, why, one.where ? make("code", { text: one.where }) : ""];
}

function table(label, headings, rows) {
  return make("div", { class: "scroll", tabindex: "0", role: "group", "aria-label": label }, make("table", { "aria-label": label, class: "stacked" },
    make("thead", {}, make("tr", {}, ...headings.map((text) => make("th", { scope: "col", text })))),
    make("tbody", {}, ...rows.map((cells) => make("tr", {}, ...cells.map((one, place) => make("td", place ? { "data-label": headings[place] } : {}, ...(one === "" ? [] : [typeof one === "string" ? make("bdi", { text: one }) : one]))))))));
}

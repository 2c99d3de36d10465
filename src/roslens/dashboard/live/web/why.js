// Why what was chosen is as it is: the first cause with what to do, then each step to it with its evidence.

import { make } from "../dom.js";

const SIGNS = { ok: "✔", not: "✖", "cannot be seen": "?" };
const WORDS = { ok: "as it should be", not: "not as it should be", "cannot be seen": "cannot be seen" };
const ASKED_OF = new Set(["topic", "node", "service", "action", "connection"]);
const BAD = new Set(["absent", "low", "high"]);
/** What was told is asked for again after so long. */
const AGAIN_MS = 5000;

export class Why {
  /** `at` returns the moment that is shown, null for now: of the past nothing is asked. */
  constructor(at) {
    this.at = at;
    this.element = make("section", { class: "why-answer", "aria-label": "Why", hidden: true });
    this.entity = "";
    this.form = "";
    this.told = "";
    this.asked = -Infinity;
    this.shown = "";
  }

  /** Show nothing of what was chosen before. */
  clear() {
    this.entity = this.form = this.told = this.shown = "";
    this.element.hidden = true;
    this.element.replaceChildren();
  }

  /** What is wrong is explained at once, and anew when its states change and each 5 s; of anything else one may ask. */
  update(about) {
    if (this.at() !== null || !ASKED_OF.has(about.entity.split(":", 1)[0])) return this.clear();
    const states = (about.judgements || []).map((one) => one.state);
    const form = JSON.stringify([about.entity, about.gone || false, states]);
    if (form === this.form) return this.told && performance.now() - this.asked >= AGAIN_MS ? this.ask() : undefined;
    const other = about.entity !== this.entity;
    this.form = form;
    this.entity = about.entity;
    if (about.gone || states.some((state) => BAD.has(state)) || (!other && this.told)) return this.ask();
    this.element.hidden = false;
    this.element.replaceChildren(make("button", { type: "button", text: "Why?", onclick: () => this.ask() }));
    return undefined;
  }

  async ask() {
    const { entity } = this;
    this.asked = performance.now();
    try {
      const answer = await fetch(`why.json?select=${encodeURIComponent(entity)}`);
      if (entity !== this.entity) return;
      this.told = entity;
      if (answer.status === 200) this.draw(await answer.json());
      else this.element.hidden = true;
    } catch {
      // The page says by itself that nothing is heard of the monitor.
    }
  }

  draw(found) {
    const form = JSON.stringify(found);
    // What stays as it is is not touched: somebody may be reading or copying it.
    if (form === this.shown) return;
    this.shown = form;
    const { cause } = found;
    const open = this.element.querySelector("details")?.open ?? false;
    const count = found.steps.length;
    this.element.replaceChildren(
      make("h4", { text: "Why" }),
      cause ? make("p", { class: "why-cause" }, make("b", { text: "First cause: " }), make("bdi", { text: `${cause.says}.` })) : make("p", { class: "why-cause", text: "No cause was found." }),
      ...(cause ? toDo(cause) : []),
      make("details", { open }, make("summary", { text: count === 1 ? "The step to it" : `All ${count} steps` }),
        make("ol", { class: "why-steps" }, ...found.steps.map(step))),
      ...(found.notes || []).map((text) => make("p", { class: "quiet", text })),
    );
    this.element.hidden = false;
  }
}

function step(one) {
  const evidence = one.evidence || [];
  return make("li", { class: `why-${one.state === "cannot be seen" ? "unseen" : one.state}` },
    make("span", { class: "why-sign", role: "img", "aria-label": WORDS[one.state], title: WORDS[one.state], text: SIGNS[one.state] }), " ",
    make("b", { text: one.asks }), " ", make("bdi", { text: one.says }), one.of ? make("span", { class: "quiet", text: ` ${one.of}` }) : "",
    ...(evidence.length ? [make("ul", {}, ...evidence.map((text) => make("li", {}, make("bdi", { text }))))] : []),
    ...(one.state === "ok" ? [] : toDo(one)));
}

/** What to do about a step, or how to see what cannot be seen, and the command to try. */
function toDo(one) {
  return [
    ...(one.how ? [make("p", { class: "why-how" }, "→ ", make("bdi", { text: one.how }))] : []),
    ...(one.command ? [make("p", { class: "why-how" }, "→ try ", make("code", { text: one.command }))] : []),
  ];
}

// The line of time: which moment the page shows, what happened when, and playback.

import { draw, make } from "../dom.js";
import { written } from "./clock.js";
import { duration } from "./states.js";

const AGAIN_MS = 10_000;
const PLAY_MS = 500;
const STEPS = 2000;
const KINDS = { alarm: "alarm", gone: "gone", restart: "restarted", action: "action", change: "changed" };

export class Moments {
  /** `went(at)` is called with another moment, which is null for now; `show(snapshot)` draws what was then. */
  constructor(parts, went, show) {
    Object.assign(this, parts, { went, show });
    this.at = null;
    this.now = 0;
    this.found = null;
    this.begun = Number.NEGATIVE_INFINITY;
    this.wanted = undefined;
    this.asking = false;
    this.playing = 0;
    this.held = null;
    this.slider.addEventListener("input", () => this.go(Number(this.slider.value)));
    this.play.addEventListener("click", () => this.turn());
    this.back.addEventListener("click", () => this.go(null));
    this.reach.addEventListener("change", () => this.load());
    this.hold.addEventListener("click", () => this.remember());
    this.marks.addEventListener("click", (event) => {
      const mark = event.target.closest("[data-time]");
      if (mark) this.go(Number(mark.dataset.time));
    });
    setInterval(() => document.hidden || this.load(), AGAIN_MS);
    this.load();
  }

  /** Hear of a newer moment of what runs. */
  update(snapshot) {
    this.now = snapshot.time;
    if (!this.found) return;
    if (snapshot.time > this.found.last) this.found.last = snapshot.time;
    this.range();
  }

  async load() {
    const reach = Number(this.reach.value);
    const until = this.now || 0;
    const asked = reach && until ? `?since=${until - reach}&until=${until}` : "";
    try {
      const answer = await fetch(`timeline.json${asked}`);
      if (answer.status !== 200) return;
      const found = await answer.json();
      this.begun = found.first;
      this.found = reach && until ? { ...found, first: Math.max(found.first, until - reach) } : found;
    } catch {
      return;
    }
    this.element.hidden = false;
    this.range();
    this.drawMarks();
  }

  get last() {
    return Math.max(this.found.last, this.now);
  }

  range() {
    const { slider, found } = this;
    const step = Math.max(0.5, (this.last - found.first) / STEPS);
    slider.min = found.first;
    slider.step = Math.round(step * 10) / 10;
    // A whole number of steps, else the handle cannot stand at the end.
    slider.max = found.first + Math.ceil((this.last - found.first) / slider.step) * slider.step;
    slider.value = this.at ?? slider.max;
    slider.setAttribute("aria-valuetext", this.at === null ? (this.live ? "now" : "the end") : written(this.at));
  }

  drawMarks() {
    const { first } = this.found;
    const length = Math.max(this.slider.max - first, 0.001);
    this.marks.replaceChildren(...this.found.marks.filter((one) => one.time >= first).map((one) => {
      const words = `${one.when} ${one.name} ${KINDS[one.kind] || one.kind}${one.detail ? `: ${one.detail}` : ""}${one.count > 1 ? ` and ${one.count - 1} more` : ""}`;
      const x = (100 * (one.time - first)) / length;
      return draw("g", { class: `mark-of ${one.kind}`, "data-time": one.time }, draw("title", {}, words), draw("rect", { x: `${x}%`, y: 0, width: 5, height: 14, class: "reach" }), draw("rect", { x: `${x}%`, y: one.kind === "change" ? 9 : 2, width: 2, height: one.kind === "change" ? 5 : 12 }));
    }));
    this.count.textContent = `${this.found.marks.length} marks; [ and ] go to the one before and after`;
  }

  /** Show another moment; null is now. */
  go(at, quietly = false) {
    const past = at !== null && this.found && at < this.last - 0.05 ? Math.max(at, this.found.first) : at === null || this.found ? null : at;
    if (past === null && this.playing) this.turn();
    this.at = past;
    if (this.found) this.range();
    this.words();
    if (!quietly) this.went(past);
    this.wanted = past;
    this.ask();
  }

  /** Ask for the moment that is wanted; of those wanted meanwhile only the last. */
  async ask() {
    if (this.asking || this.wanted === undefined || this.wanted === null) return;
    this.asking = true;
    const at = this.wanted;
    this.wanted = undefined;
    try {
      const answer = await fetch(`snapshot.json?at=${at}`);
      if (this.at === at) {
        if (answer.status === 200) this.show(await answer.json());
        else this.then.firstChild.textContent = answer.status === 204 ? `Nothing is kept of ${written(at)}. ` : `${(await answer.text()).trim()} `;
      }
    } catch {
      // The page says by itself that nothing is heard of the monitor.
    }
    this.asking = false;
    this.ask();
  }

  words() {
    const then = this.at !== null;
    this.then.hidden = !then;
    this.back.hidden = !then;
    document.documentElement.classList.toggle("is-then", then);
    if (then) this.then.firstChild.textContent = `This is how it was at ${written(this.at)}${this.now ? `, ${duration(this.now - this.at)} before ${this.live ? "now" : "the end"}` : ""}. `;
    this.said.textContent = then ? written(this.at) : this.live ? "now" : "end";
    this.compare();
  }

  /** Start and stop playback. */
  turn() {
    if (this.playing) {
      clearInterval(this.playing);
      this.playing = 0;
    } else if (this.found) {
      if (this.at === null) this.go(this.found.first);
      this.playing = setInterval(() => {
        if (this.wanted !== undefined && this.wanted !== null) return;
        this.go(this.at + (PLAY_MS / 1000) * Number(this.speed.value));
      }, PLAY_MS);
    }
    this.play.textContent = this.playing ? "Pause" : "Play";
  }

  /** Go to the mark before or after the moment that is shown. */
  step(by) {
    if (!this.found) return false;
    const here = this.at ?? this.last;
    const others = this.found.marks.map((one) => one.time).filter((time) => (by < 0 ? time < here - 0.05 : time > here + 0.05));
    if (others.length) this.go(by < 0 ? others.at(-1) : others[0]);
    else if (by > 0) this.go(null);
    return true;
  }

  /** Keep a moment, to be compared with another one. */
  remember() {
    this.held = this.held === null ? this.at ?? this.now : null;
    this.compare();
  }

  compare() {
    this.hold.textContent = this.held === null ? "Compare with this" : "Forget";
    const other = this.at ?? this.now;
    const differs = this.held !== null && Math.abs(other - this.held) > 0.05;
    this.differences.hidden = this.held === null;
    this.differences.replaceChildren(this.held === null ? "" : differs
      ? make("a", { href: `compared?from=${Math.min(other, this.held)}&to=${Math.max(other, this.held)}`, text: `What changed between ${written(Math.min(other, this.held))} and ${written(Math.max(other, this.held))}` })
      : `${written(this.held)} is kept; go to another moment`);
  }
}

// How the foremost signal of each row that can be seen went in the last two minutes.

import { draw } from "../dom.js";

const AGAIN_MS = 5000;
const MOST = 100;
const WIDTH = 80;
const HEIGHT = 18;

export class Sparks {
  /** `moment` returns the time up to which to show them, 0 before any is known. */
  constructor(tree, moment) {
    Object.assign(this, { tree, moment, asked: 0, of: "" });
    setInterval(() => this.look(), 1000);
  }

  /** Ask when the last answer is old, or other rows came to be seen. */
  async look() {
    const until = this.moment();
    if (document.hidden || !until) return;
    const rows = this.tree.seen(MOST);
    const of = rows.join("\n");
    if (performance.now() - this.asked < AGAIN_MS && of === this.of && until === this.until) return;
    if (performance.now() - this.asked < AGAIN_MS && of === this.of) return;
    Object.assign(this, { asked: performance.now(), of, until });
    const query = new URLSearchParams([...rows.map((one) => ["of", one]), ["until", String(until)]]);
    try {
      const answer = await fetch(`sparks.json?${query}`);
      if (answer.status === 200) this.tree.spark(await answer.json(), line);
    } catch {
      // The page says by itself that nothing is heard of the monitor.
    }
  }
}

/** The path of values between 0 and 1; null is a gap. */
function line(values) {
  let path = "";
  let pen = "M";
  const step = WIDTH / Math.max(values.length - 1, 1);
  values.forEach((value, at) => {
    if (value === null) {
      pen = "M";
      return;
    }
    path += `${pen}${(at * step).toFixed(1)} ${(HEIGHT - 3 - value * (HEIGHT - 8)).toFixed(1)}`;
    pen = "L";
  });
  return draw("svg", { class: "spark", viewBox: `0 0 ${WIDTH} ${HEIGHT}`, "aria-hidden": "true" }, draw("path", { d: path || "M0 0" }));
}

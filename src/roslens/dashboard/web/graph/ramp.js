// From values to steps of the colour ramp; the same as ramp.py, which explains it.

import { figure } from "../dom.js";

const STEPS = 5;

export function rampOf(values, better, decimals) {
  const known = values.filter((value) => value !== null);
  if (!known.length) return { least: 0, most: 0, falling: false, whole: true, decimals: 0 };
  const whole = decimals === 0 && known.every(Number.isInteger);
  return {
    least: Math.min(...known),
    most: Math.max(...known),
    falling: better === "higher",
    whole,
    decimals: whole ? 0 : decimals,
  };
}

export function stepOf(ramp, value) {
  if (value === null) return "n";
  if (ramp.falling) {
    const span = ramp.most - ramp.least;
    return span ? String(Math.min(STEPS, 1 + Math.trunc((STEPS * (ramp.most - value)) / span))) : "1";
  }
  if (value <= 0 || ramp.most <= 0) return "0";
  return String(Math.max(1, Math.min(STEPS, Math.ceil(STEPS * Math.sqrt(value / ramp.most) - 1e-9))));
}

function range(ramp, low, high) {
  const first = figure(low, ramp.decimals);
  const last = figure(high, ramp.decimals);
  return first === last ? first : `${first} to ${last}`;
}

/** [step, the numbers it stands for], palest first. */
export function legendOf(ramp) {
  if (ramp.falling) {
    const width = (ramp.most - ramp.least) / STEPS;
    return [0, 1, 2, 3, 4].map((step) => [String(step + 1), range(ramp, ramp.most - (step + 1) * width, ramp.most - step * width)]);
  }
  const found = [["0", "0"]];
  for (let step = 1; step <= STEPS; step += 1) {
    const low = ramp.most * ((step - 1) / STEPS) ** 2;
    const high = ramp.most * (step / STEPS) ** 2;
    if (ramp.whole) {
      const first = Math.floor(low + 1e-9) + 1;
      const last = Math.floor(high + 1e-9);
      if (first <= last) found.push([String(step), range(ramp, first, last)]);
    } else if (ramp.most > 0) found.push([String(step), range(ramp, low, high)]);
  }
  return found;
}

// Signs of states; the word always stands beside them.

import { draw } from "../dom.js";

/** The sign of a state. */
export function sign(state, severity, place) {
  const grave = severity === "error" ? " grave" : "";
  return draw("svg", { class: `glyph ${state}${grave}`, viewBox: "0 0 16 16", "aria-hidden": "true", ...place }, draw("use", { href: `#g-${state}` }));
}

/** The word of a state. */
export function word(state) {
  return state === "unjudged" ? "not judged" : state;
}

/** Put sign and word of a state into an element. */
export function mark(element, state, severity) {
  element.replaceChildren(sign(state, severity), word(state));
}

/** 0.0123 -> "12.3 ms". */
export function span(seconds) {
  const size = Math.abs(seconds);
  const [value, unit] = size < 0.001 ? [seconds * 1e6, "µs"] : size < 1 ? [seconds * 1e3, "ms"] : [seconds, "s"];
  return `${Number(value.toPrecision(3))} ${unit}`;
}

/** 75 -> "1 min 15 s". */
export function duration(seconds) {
  const whole = Math.max(0, Math.floor(seconds));
  if (whole < 60) return `${whole} s`;
  if (whole < 3600) return `${Math.floor(whole / 60)} min ${whole % 60} s`;
  return `${Math.floor(whole / 3600)} h ${Math.floor((whole % 3600) / 60)} min`;
}

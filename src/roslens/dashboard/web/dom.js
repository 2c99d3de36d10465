// Elements without markup in strings: text stays text, whatever it holds.

const SVG = "http://www.w3.org/2000/svg";

/** Make an element. `props` are attributes, but for `text` and handlers (`onclick`). */
export function make(tag, props, ...children) {
  const element = document.createElement(tag);
  fill(element, props || {});
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** Make an SVG element. */
export function draw(tag, props, ...children) {
  const element = document.createElementNS(SVG, tag);
  fill(element, props || {});
  element.append(...children);
  return element;
}

function fill(element, props) {
  for (const [name, value] of Object.entries(props)) {
    if (name === "text") element.textContent = value;
    else if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
}

/** The sign of a severity, as templates write it. */
export function glyph(name) {
  return draw("svg", { class: `glyph ${name}`, viewBox: "0 0 16 16", "aria-hidden": "true" }, draw("use", { href: `#g-${name}` }));
}

/** 12,345.6 with at most `decimals` digits behind the point; a dash for nothing. */
export function figure(value, decimals = 0) {
  if (value === null || value === undefined) return "–";
  // The browser's own words for numbers take many milliseconds to load for the first one.
  const [whole, part] = value.toFixed(decimals).split(".");
  const grouped = whole.replace(/\B(?=(\d{3})+$)/g, ",");
  return part ? `${grouped}.${part}` : grouped;
}

/** Whether a key press belongs to a field and not to the page. */
export function typing(event) {
  const target = event.target;
  return target.isContentEditable || ["INPUT", "SELECT", "TEXTAREA"].includes(target.tagName);
}

/** Call `action` once, `delay` milliseconds after the last call. */
export function settled(action, delay) {
  let timer = 0;
  return (...args) => {
    clearTimeout(timer);
    timer = setTimeout(() => action(...args), delay);
  };
}

// Signals of one entity over time: several series, the allowed band, zoom by dragging, one cursor for all plots.

import { make } from "../dom.js";
import { beginning, written } from "./clock.js";

const AGAIN_MS = 5000;
const COLOURS = ["--ok", "--error", "--warning-edge", "--code-keyword", "--code-string", "--quiet"];
const SCALES = { s: [[1, "s"], [1e-3, "ms"], [1e-6, "µs"]], B: [[1e9, "GB"], [1e6, "MB"], [1e3, "kB"], [1, "B"]], "B/s": [[1e9, "GB/s"], [1e6, "MB/s"], [1e3, "kB/s"], [1, "B/s"]], degC: [[1, "°C"]] };
const MOST_CHOSEN = 6;

let loading;

/** Load the plotting library when the first plot is wanted. */
function library() {
  loading ??= new Promise((done, failed) => {
    const folder = new URL("vendored/uplot/", import.meta.url);
    document.head.append(make("link", { rel: "stylesheet", href: new URL("uPlot.min.css", folder).href }));
    document.head.append(make("script", { src: new URL("uPlot.iife.min.js", folder).href, onload: () => done(window.uPlot), onerror: failed }));
  });
  return loading;
}

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** An amount in a unit that people read. */
export function amount(value, unit) {
  if (value === null || value === undefined) return "–";
  const scales = SCALES[unit] || [[1, unit]];
  const [factor, name] = scales.find(([size]) => Math.abs(value) >= size) || scales.at(-1);
  return `${Number((value / factor).toPrecision(3))} ${name}`.trim();
}

export class Plots {
  constructor(element, moment, begun) {
    Object.assign(this, { element, moment, begun, entity: "", drawn: [], chosen: new Map(), zoom: null, reach: 300, asked: 0 });
    this.bar = make("div", { class: "bar-line plot-bar" });
    this.room = make("div", { class: "plot-room" });
    element.replaceChildren(this.bar, this.room);
    setInterval(() => this.entity && !document.hidden && !this.zoom && performance.now() - this.asked > AGAIN_MS && this.load(), 1000);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
    new MutationObserver(() => this.redraw()).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    new ResizeObserver(() => this.fit()).observe(this.room);
  }

  show(entity) {
    if (entity === this.entity) return;
    this.entity = entity;
    this.zoom = null;
    this.found = null;
    this.clear();
    this.bar.replaceChildren();
    if (entity) this.load();
  }

  /** Another moment is shown. */
  moved() {
    if (this.entity && !this.zoom) this.load();
  }

  async load() {
    const { entity } = this;
    const until = this.zoom?.[1] ?? this.moment();
    if (!until) return;
    const since = this.zoom?.[0] ?? until - this.reach;
    this.asked = performance.now();
    const query = new URLSearchParams({ select: entity, since, until, points: Math.max(360, Math.min(900, Math.round(this.room.clientWidth))) });
    try {
      const answer = await fetch(`plots.json?${query}`);
      if (entity !== this.entity || answer.status !== 200) return;
      this.found = await answer.json();
    } catch {
      return;
    }
    const uPlot = await library();
    // Nothing is there to draw, where another entity was looked at meanwhile and this one again.
    if (entity === this.entity && this.found) this.draw(uPlot);
  }

  /** The keys of the series to show: those that are judged, or the first one. */
  keys() {
    const kind = this.entity.split(":")[0];
    if (!this.chosen.has(kind)) {
      const judged = this.found.series.filter((one) => one.expected).map((one) => one.key);
      const usual = this.found.series.find((one) => ["rate", "cpu", "calls"].includes(one.key)) || this.found.series[0];
      this.chosen.set(kind, new Set(judged.length ? judged.slice(0, MOST_CHOSEN) : usual ? [usual.key] : []));
    }
    return this.chosen.get(kind);
  }

  draw(uPlot) {
    this.uPlot = uPlot;
    const keys = this.keys();
    this.tools(keys);
    const shown = this.found.series.filter((one) => keys.has(one.key));
    const groups = new Map();
    for (const one of shown) {
      const group = one.expected ? one.key : one.unit;
      groups.set(group, [...(groups.get(group) || []), one]);
    }
    const form = JSON.stringify([...groups].map(([group, every]) => [group, every.map((one) => [one.key, one.low, one.high])]));
    if (form !== this.form || this.drawn.length !== groups.size) {
      this.clear();
      this.form = form;
      for (const every of groups.values()) this.drawn.push(this.plot(every));
    } else [...groups.values()].forEach((every, at) => this.drawn[at].setData(joined(every), !this.zoom));
    [...groups.values()].forEach((every, at) => this.describe(this.drawn[at], every));
    for (const one of this.drawn) if (one.cursor.left === undefined || one.cursor.left < 0) one.setLegend({ idx: one.data[0].length - 1 }, false);
    this.span();
  }

  tools(keys) {
    const focused = document.activeElement?.dataset?.plot;
    const reach = make("select", { "aria-label": "How far back", "data-plot": "reach", onchange: (event) => { this.reach = Number(event.target.value); this.zoom = null; this.load(); } },
      ...[[120, "2 min"], [300, "5 min"], [1800, "30 min"], [7200, "2 h"], [86400, "1 day"], [604800, "1 week"]].map(([value, text]) => make("option", { value, text, selected: value === this.reach })));
    const all = make("button", { type: "button", class: "plain", text: "Whole stretch", "data-plot": "all", hidden: !this.zoom, onclick: () => { this.zoom = null; this.load(); } });
    const every = make("details", { class: "plot-signals", open: this.bar.querySelector("details")?.open || false }, make("summary", { text: `${keys.size} of ${this.found.series.length} signals drawn` }),
      make("div", {}, ...this.found.series.map((one) => make("label", { class: "check" }, make("input", { type: "checkbox", "data-plot": one.key, checked: keys.has(one.key), onchange: (event) => { event.target.checked ? keys.add(one.key) : keys.delete(one.key); this.draw(this.uPlot); } }), one.title))));
    this.bar.replaceChildren(make("h4", { text: "Over time" }), reach, all, every);
    if (focused) this.bar.querySelector(`[data-plot="${CSS.escape(focused)}"]`)?.focus();
  }

  plot(every) {
    const [first] = every;
    const holder = make("div", { class: "plot", role: "img" });
    this.room.append(holder);
    const colours = COLOURS.map(colour);
    const axis = { stroke: colour("--quiet"), grid: { stroke: colour("--rule"), width: 1 }, ticks: { stroke: colour("--rule"), width: 1 }, font: "11px system-ui" };
    const size = { width: Math.max(this.room.clientWidth, 200), height: 150 };
    const bounds = every.flatMap((one) => [one.low, one.high]).filter((one) => one !== undefined && one !== null);
    return new this.uPlot({
      ...size,
      cursor: { sync: { key: "roslens" }, drag: { x: true, y: false, setScale: false } },
      legend: { live: true },
      scales: {
        x: { time: false },
        y: { range: (_, least, most) => {
          const ends = [least, most, ...bounds].filter((one) => one !== null && Number.isFinite(one));
          const low = Math.min(0, ...ends);
          const high = Math.max(...ends, low + 1e-9);
          return [low, high + 0.08 * (high - low)];
        } },
      },
      axes: [{ ...axis, values: (_, ticks) => ticks.map((one) => written(one, 0)), space: 70 }, { ...axis, size: 66, values: (_, ticks) => ticks.map((one) => amount(one, first.unit)) }],
      series: [{ label: "at", value: (_, time) => ((time ?? null) === null ? "–" : written(time)) },
        ...every.map((one, at) => ({ label: one.title, stroke: colours[at % colours.length], width: 1.6, dash: at >= 3 ? [6, 3] : undefined, spanGaps: false, points: { show: false }, value: (_, value) => amount(value, one.unit) }))],
      hooks: {
        // Without a cursor the legend has the last values.
        setLegend: [(drawn) => { if (drawn.legend.idx === null || drawn.legend.idx === undefined) drawn.setLegend({ idx: drawn.data[0].length - 1 }, false); }],
        drawClear: [(drawn) => band(drawn, first)],
        draw: [(drawn) => here(drawn, this.moment())],
        setSelect: [(drawn) => {
          if (drawn.select.width < 4) return;
          this.zoom = [drawn.posToVal(drawn.select.left, "x"), drawn.posToVal(drawn.select.left + drawn.select.width, "x")];
          drawn.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
          this.load();
        }],
      },
    }, joined(every), holder);
  }

  /** Say in words what a plot shows. */
  describe(drawn, every) {
    const words = every.map((one) => {
      const known = one.values.filter((value) => value !== null);
      const missing = one.values.length - known.length;
      if (!known.length) return `${one.title}: nothing was observed`;
      return `${one.title} from ${amount(Math.min(...one.least.filter((value) => value !== null)), one.unit)} to ${amount(Math.max(...one.greatest.filter((value) => value !== null)), one.unit)}, last ${amount(known.at(-1), one.unit)}${one.expected ? `, expected ${one.expected}` : ""}${missing ? `, ${missing} ${missing === 1 ? "gap" : "gaps"}` : ""}`;
    });
    drawn.root.parentNode.setAttribute("aria-label", words.join("; "));
  }

  span() {
    const { since, until } = this.found;
    const begun = Math.max(since, beginning(), this.begun());
    for (const one of this.drawn) one.setScale("x", { min: begun < until ? begun : since, max: until });
  }

  fit() {
    for (const one of this.drawn) one.setSize({ width: Math.max(this.room.clientWidth, 200), height: one.height });
  }

  redraw() {
    this.form = "";
    if (this.found && this.uPlot && this.entity) this.draw(this.uPlot);
  }

  clear() {
    for (const one of this.drawn) one.destroy();
    this.drawn = [];
    this.room.replaceChildren();
  }
}

/** One column of times for several series: where one has no value, it has none there. */
function joined(every) {
  if (every.length === 1) return [every[0].times, every[0].values];
  const times = [...new Set(every.flatMap((one) => one.times))].sort((a, b) => a - b);
  return [times, ...every.map((one) => {
    const known = new Map(one.times.map((time, at) => [time, one.values[at]]));
    // Undefined is what others have a time for, null is a gap.
    return times.map((time) => (known.has(time) ? known.get(time) : undefined));
  })];
}

function band(drawn, { low, high }) {
  if ((low ?? high) === undefined) return;
  const { ctx, bbox } = drawn;
  const top = high === undefined ? bbox.top : Math.max(bbox.top, drawn.valToPos(high, "y", true));
  const bottom = low === undefined ? bbox.top + bbox.height : Math.min(bbox.top + bbox.height, drawn.valToPos(low, "y", true));
  ctx.save();
  ctx.globalAlpha = 0.16;
  ctx.fillStyle = colour("--ok");
  ctx.fillRect(bbox.left, top, bbox.width, Math.max(bottom - top, 0));
  ctx.globalAlpha = 1;
  ctx.strokeStyle = colour("--ok");
  ctx.setLineDash([5, 4]);
  for (const [bound, y] of [[high, top], [low, bottom]]) {
    if (bound === undefined) continue;
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
  }
  ctx.restore();
}

function here(drawn, time) {
  const { ctx, bbox } = drawn;
  const x = drawn.valToPos(time, "x", true);
  if (!(x > bbox.left && x < bbox.left + bbox.width - 2)) return;
  ctx.save();
  ctx.strokeStyle = colour("--select");
  ctx.setLineDash([3, 3]);
  ctx.beginPath();
  ctx.moveTo(x, bbox.top);
  ctx.lineTo(x, bbox.top + bbox.height);
  ctx.stroke();
  ctx.restore();
}

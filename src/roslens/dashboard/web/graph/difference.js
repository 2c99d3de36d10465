// The picture of what differs: zoom, pan, and from one difference to the next; the rest stands in the page as it came.

import { onKey } from "../keys.js";
import { Camera } from "./camera.js";
import { READABLE } from "./names.js";
import { keepTitles } from "./titles.js";

const LEGIBLE = 0.9;

export function startDifference(root) {
  const [canvas, svg] = [root.querySelector('[id$="graph-canvas"]'), root.querySelector('[id$="graph-svg"]')];
  const { width, height } = svg.viewBox.baseVal;
  const boxes = [...svg.querySelectorAll(".boxes rect")].map((one) => Object.fromEntries(["x", "y", "width", "height"].map((name) => [name, Number(one.getAttribute(name))])));
  const titles = [...svg.querySelectorAll(".titles text")];
  const camera = new Camera(canvas, svg, svg.querySelector(".scene"), () => keepTitles(titles, boxes, camera), true);
  const marked = [...svg.querySelectorAll(".node.missing, .node.added, .node.differs")];
  let at = -1;
  const show = (element) => {
    const [x, y] = element.getAttribute("transform").match(/-?[\d.]+/g).map(Number);
    const room = camera.size();
    const k = Math.max(LEGIBLE, camera.k);
    camera.showAt(k, Math.max(x, room.width / k / 2), Math.max(y, room.height / k / 2));
  };
  const next = () => {
    if (!marked.length) return;
    marked[at]?.classList.remove("selected");
    at = (at + 1) % marked.length;
    marked[at].classList.add("selected");
    show(marked[at]);
  };
  const fit = () => camera.fit({ x: 0, y: 0, width, height });
  /** All of it; where names could not be read then, the first thing that differs. */
  const start = () => {
    fit();
    if (camera.k >= READABLE) return;
    show(marked[0] || svg.querySelector(".node"));
  };
  let before = 0;
  new ResizeObserver(() => {
    const room = camera.resized();
    if (!before && room.width) start();
    before = room.width;
  }).observe(canvas);
  const actions = { "zoom-in": () => camera.zoom(1.4), "zoom-out": () => camera.zoom(1 / 1.4), "zoom-all": fit, "next-difference": next };
  for (const [name, action] of Object.entries(actions)) root.querySelector(`[data-do="${name}"]`)?.addEventListener("click", action);
  canvas.addEventListener("dragstart", (event) => event.preventDefault());
  onKey("+", actions["zoom-in"]);
  onKey("-", actions["zoom-out"]);
  onKey("0", fit);
  onKey("n", next);
}

// The picture of what differs: zoom and pan; everything else of it stands in the page as it came.

import { onKey } from "../keys.js";
import { Camera } from "./camera.js";
import { READABLE } from "./names.js";

const LEGIBLE = 0.9;

export function startDifference(root) {
  const [canvas, svg] = [root.querySelector('[id$="graph-canvas"]'), root.querySelector('[id$="graph-svg"]')];
  const { width, height } = svg.viewBox.baseVal;
  const camera = new Camera(canvas, svg, svg.querySelector(".scene"), () => {});
  const fit = () => camera.fit({ x: 0, y: 0, width, height });
  /** All of it; where names could not be read then, the first thing that differs. */
  const start = () => {
    fit();
    if (camera.k >= READABLE) return;
    const first = svg.querySelector(".node.missing, .node.added, .node.differs") || svg.querySelector(".node");
    const [x, y] = first.getAttribute("transform").match(/-?[\d.]+/g).map(Number);
    const room = camera.size();
    camera.showAt(LEGIBLE, Math.max(x, room.width / LEGIBLE / 2), Math.max(y, room.height / LEGIBLE / 2));
  };
  let before = 0;
  new ResizeObserver(() => {
    const room = camera.resized();
    if (!before && room.width) start();
    before = room.width;
  }).observe(canvas);
  const actions = { "zoom-in": () => camera.zoom(1.4), "zoom-out": () => camera.zoom(1 / 1.4), "zoom-all": fit };
  for (const [name, action] of Object.entries(actions)) root.querySelector(`[data-do="${name}"]`).addEventListener("click", action);
  canvas.addEventListener("dragstart", (event) => event.preventDefault());
  onKey("+", actions["zoom-in"]);
  onKey("-", actions["zoom-out"]);
  onKey("0", fit);
}

// Zoom and pan. While a gesture lasts, the finished picture is moved as a whole (cheap without a graphics card);
// when it ends, the scene is drawn anew and is sharp again.

import { settled } from "../dom.js";
import { READABLE } from "./names.js";

const LEAST = 0.05;
const MOST = 6;

export class Camera {
  /**
   * `changed` is called when a gesture has ended. Where the picture is a part of a page that scrolls, it is `within` it:
   * the wheel zooms it once it has the focus, or with Ctrl, and else scrolls the page.
   */
  constructor(canvas, svg, scene, changed, within = false) {
    Object.assign(this, { canvas, svg, scene, changed, within });
    this.k = 1;
    this.x = 0;
    this.y = 0;
    this.drawn = { k: 1, x: 0, y: 0 };
    this.room = null;
    svg.removeAttribute("viewBox");
    this.finish = settled(() => this.redraw(), 140);
    this.pointers = new Map();
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => this.release(event));
    canvas.addEventListener("click", (event) => {
      if (!this.dragged) return;
      // The end of a drag is no click on what happens to lie below it.
      event.preventDefault();
      event.stopPropagation();
      this.dragged = false;
    }, true);
  }

  /** How large the canvas is. To ask for it lays the page out, so it is asked once; `resized` tells what changes. */
  size() {
    return (this.room ||= this.resized());
  }

  resized() {
    return (this.room = { width: this.canvas.clientWidth, height: this.canvas.clientHeight });
  }

  /** Show all of a box. */
  fit(box) {
    const { width, height } = this.size();
    // Names keep their size when the picture is small, so those at its ends need room beside it.
    const across = (pad) => (width - 2 * pad) / Math.max(1, box.width);
    const down = (height - 48) / Math.max(1, box.height);
    this.k = Math.max(LEAST, Math.min(1.6, down, across(24) < READABLE ? across(44) : across(24)));
    this.x = width / 2 - this.k * (box.x + box.width / 2);
    this.y = height / 2 - this.k * (box.y + box.height / 2);
    this.redraw();
  }

  /** Show the scene at a zoom with this point of it in the middle. */
  showAt(k, x, y) {
    const { width, height } = this.size();
    Object.assign(this, { k, x: width / 2 - k * x, y: height / 2 - k * y });
    this.redraw();
  }

  /** Zoom by a factor around a point of the canvas, its middle by default. */
  zoom(factor, point) {
    const { width, height } = this.size();
    const [px, py] = point || [width / 2, height / 2];
    const k = Math.max(LEAST, Math.min(MOST, this.k * factor));
    this.x = px - ((px - this.x) * k) / this.k;
    this.y = py - ((py - this.y) * k) / this.k;
    this.k = k;
    this.moved();
  }

  pan(dx, dy) {
    this.x += dx;
    this.y += dy;
    this.moved();
  }

  /** Bring a point of the scene into view if it is outside, with a part of the canvas around it for what it is joined to. */
  reveal(x, y, around = 0) {
    const { width, height } = this.size();
    const [sx, sy] = [this.k * x + this.x, this.k * y + this.y];
    const [left, top] = [Math.max(60, around * width), Math.max(60, around * height)];
    const dx = sx < left ? left - sx : sx > width - left ? width - left - sx : 0;
    const dy = sy < top ? top - sy : sy > height - top ? height - top - sy : 0;
    if (dx || dy) this.pan(dx, dy);
  }

  moved() {
    const k = this.k / this.drawn.k;
    this.canvas.classList.add("moving");
    this.svg.style.transform = `matrix(${k},0,0,${k},${this.x - k * this.drawn.x},${this.y - k * this.drawn.y})`;
    this.finish();
  }

  redraw() {
    this.drawn = { k: this.k, x: this.x, y: this.y };
    this.canvas.classList.remove("moving");
    this.svg.style.transform = "";
    this.scene.setAttribute("transform", `translate(${this.x.toFixed(2)} ${this.y.toFixed(2)}) scale(${this.k.toFixed(4)})`);
    this.changed();
  }

  wheel(event) {
    if (this.within && !event.ctrlKey && !event.metaKey && !this.canvas.contains(document.activeElement)) return;
    event.preventDefault();
    const box = this.canvas.getBoundingClientRect();
    const amount = event.deltaY * (event.deltaMode === 1 ? 24 : 1);
    this.zoom(Math.exp(-amount * 0.0016), [event.clientX - box.left, event.clientY - box.top]);
  }

  press(event) {
    if (event.button !== 0) return;
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    this.dragged = false;
  }

  drag(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    if (this.pointers.size === 1) {
      if (!this.dragged && Math.hypot(now[0] - before[0], now[1] - before[1]) < 4) return;
      this.pan(now[0] - before[0], now[1] - before[1]);
    } else {
      const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
      const box = this.canvas.getBoundingClientRect();
      const grown = Math.hypot(now[0] - other[0], now[1] - other[1]) / Math.max(1, Math.hypot(before[0] - other[0], before[1] - other[1]));
      // Of two fingers one moves at a time, so the middle between them goes half its way.
      this.x += (now[0] - before[0]) / 2;
      this.y += (now[1] - before[1]) / 2;
      this.zoom(grown, [(now[0] + other[0]) / 2 - box.left, (now[1] + other[1]) / 2 - box.top]);
    }
    if (!this.dragged) {
      this.dragged = true;
      this.canvas.classList.add("dragging");
      this.canvas.setPointerCapture(event.pointerId);
    }
    this.pointers.set(event.pointerId, now);
  }

  release(event) {
    this.pointers.delete(event.pointerId);
    if (!this.pointers.size) this.canvas.classList.remove("dragging");
  }
}

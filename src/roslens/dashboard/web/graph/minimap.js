// Where in a picture the reader is, while not all of it is in sight: a click goes there.

import { draw } from "../dom.js";

const WIDTH = 150;
const HEIGHT = 96;
const MARGIN = 10;

export class Minimap {
  constructor(view) {
    this.view = view;
    this.frame = draw("rect", { class: "seen" });
    this.dots = draw("g", {});
    this.svg = draw("svg", { class: "minimap", width: WIDTH, height: HEIGHT, "aria-hidden": "true" }, this.dots, this.frame);
    this.svg.addEventListener("click", (event) => this.go(event));
    view.canvas.after(this.svg);
    this.places = null;
  }

  show() {
    const { view } = this;
    const box = view.box();
    const { width, height } = view.camera.size();
    const { k, x, y } = view.camera;
    const whole = k * box.width <= width + 1 && k * box.height <= height + 1;
    this.svg.toggleAttribute("hidden", whole || !view.places.size);
    if (whole) return;
    if (this.places !== view.places) {
      this.places = view.places;
      this.svg.setAttribute("viewBox", `${box.x} ${box.y} ${box.width} ${box.height}`);
      this.dots.replaceChildren(...[...view.places].map(([number, at]) => {
        const { w, h, severity } = view.graph.nodes[number];
        return draw("rect", { class: severity || "calm", x: at.x - w / 2, y: at.y - h / 2, width: w, height: h });
      }));
    }
    this.stand(k, x, y, width, height);
    for (const [name, value] of Object.entries({ x: -x / k, y: -y / k, width: width / k, height: height / k })) this.frame.setAttribute(name, value.toFixed(1));
  }

  /** Stand in the corner where the fewest boxes are below; the fourth corner has the buttons. */
  stand(k, x, y, width, height) {
    const [side, end] = [MARGIN + WIDTH / 2, MARGIN + HEIGHT / 2];
    const middles = { left: [side, height - end], top: [side, end], right: [width - side, end] };
    const below = { left: 0, top: 0, right: 0 };
    for (const [number, at] of this.view.places) {
      const { w, h } = this.view.graph.nodes[number];
      for (const [name, [across, down]] of Object.entries(middles)) {
        if (Math.abs(k * at.x + x - across) < (WIDTH + k * w) / 2 && Math.abs(k * at.y + y - down) < (HEIGHT + k * h) / 2) below[name] += 1;
      }
    }
    const [best] = Object.entries(below).sort((a, b) => a[1] - b[1])[0];
    // Where it stands already is as good as any other.
    if (!this.corner || below[best] < below[this.corner]) this.corner = best;
    this.svg.dataset.corner = this.corner;
    this.svg.style.left = this.corner === "right" ? `${width - WIDTH - MARGIN}px` : "";
  }

  go(event) {
    const to = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse());
    this.view.camera.showAt(this.view.camera.k, to.x, to.y);
  }
}

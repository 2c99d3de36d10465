// Where in a picture the reader is, while not all of it is in sight: a click goes there.

import { draw } from "../dom.js";

const WIDTH = 150;
const HEIGHT = 96;

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
    for (const [name, value] of Object.entries({ x: -x / k, y: -y / k, width: width / k, height: height / k })) this.frame.setAttribute(name, value.toFixed(1));
  }

  go(event) {
    const to = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse());
    this.view.camera.showAt(this.view.camera.k, to.x, to.y);
  }
}

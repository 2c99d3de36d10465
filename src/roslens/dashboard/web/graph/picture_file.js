// The picture as a file: the server has it as SVG, from which a PNG of twice its size is made here; a PDF is printed.

import { make } from "../dom.js";

const SCALE = 2;
const LARGEST = 8000;

export function startPictureFiles(root, view) {
  onPaper(root, view);
  root.querySelector('[data-do="print"]')?.addEventListener("click", () => print());
  const png = root.querySelector('[data-do="png"]');
  png?.addEventListener("click", () => savePng(png.dataset.svg, png.dataset.name));
}

/** On paper all of the picture is on one page, with every name, whatever part of it the screen shows. */
function onPaper(root, view) {
  addEventListener("beforeprint", () => {
    if (!root.checkVisibility()) return;
    const { x, y, width, height } = view.box();
    view.svg.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
    view.svg.querySelector(".scene").removeAttribute("transform");
    view.nameAll();
  });
  addEventListener("afterprint", () => {
    if (!view.svg.hasAttribute("viewBox")) return;
    view.svg.removeAttribute("viewBox");
    view.camera.redraw();
  });
}

async function savePng(address, name) {
  const text = await (await fetch(address)).text();
  const picture = new Image();
  picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  await picture.decode();
  const scale = Math.min(SCALE, LARGEST / Math.max(picture.width, picture.height));
  const canvas = make("canvas", { width: Math.round(picture.width * scale), height: Math.round(picture.height * scale) });
  canvas.getContext("2d").drawImage(picture, 0, 0, canvas.width, canvas.height);
  make("a", { href: canvas.toDataURL("image/png"), download: name }).click();
}

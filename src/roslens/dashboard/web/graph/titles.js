// The title of a box of which only a part is in sight stands in that part.

import { READABLE } from "./names.js";

const WIDTH = 7.6;
const HEIGHT = 22;

/** `texts` are the titles of `boxes`, in their order. */
export function keepTitles(texts, boxes, { k, x, y }) {
  const within = (from, least, room) => Math.max(least, Math.min(from, least + Math.max(0, room)));
  texts.forEach((text, number) => {
    const box = boxes[number];
    const close = k >= READABLE;
    const left = close ? within(-x / k + 8, box.x + 7, box.width - 14 - WIDTH * text.textContent.length) : box.x + 7;
    const top = close ? within(-y / k + 6, box.y + 3, box.height - HEIGHT) : box.y + 3;
    text.setAttribute("x", left.toFixed(1));
    text.setAttribute("y", top.toFixed(1));
  });
}

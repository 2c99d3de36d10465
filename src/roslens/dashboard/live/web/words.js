// Words about lines are shown where they touch neither a box nor words that matter more; the others when one points at them.

import { Rows } from "../graph/names.js";

const LETTER = 6.2;
/** How far words reach above their line and below it, alone and with a second line of words. */
const ABOVE = 14;
const BELOW = 1;
const BELOW_TWO = 16;
/** Words may reach so far over the edge of a box. */
const EDGE = 3;

const ROOMS = ["brief", "crowded"];

/**
 * Mark the lines whose words have no room as crowded, and as brief those of which only the first line has. `lines` come
 * with what matters most first; `boxes` are items with a place and a size. `zoom` is that of the picture, whose words grow
 * with it only up to their own size; `two` says whether there are second lines at all.
 */
export function crowd(lines, boxes, zoom, two) {
  const taken = new Rows();
  const size = 1 / Math.max(1, zoom);
  for (const { entity, x, y, w, h } of boxes) {
    taken.add({ owner: entity, left: x - w / 2 + EDGE, right: x + w / 2 - EDGE, top: y - h / 2 + EDGE, bottom: y + h / 2 - EDGE });
  }
  for (const one of lines) {
    const [first, second] = one.letters;
    const forms = two && second ? [[Math.max(first, second), BELOW_TWO], [first, BELOW]] : [[first, BELOW]];
    const boxesOf = forms.map(([letters, below]) => boxOf(one, LETTER * size * letters, size, below));
    const at = first || forms.length > 1 ? boxesOf.findIndex((box) => taken.free(box)) : 0;
    if (at >= 0) taken.add(boxesOf[at]);
    const room = at < 0 ? "crowded" : at ? "brief" : "";
    if (one.room === room) continue;
    one.room = room;
    for (const name of ROOMS) one.element.classList.toggle(name, name === room);
  }
}

function boxOf(one, long, size, below) {
  const [x, y] = one.at;
  const left = one.toTopic ? x - long : x - long / 2;
  return { owner: one, left, right: left + long, top: y - ABOVE * size, bottom: y + below * size };
}

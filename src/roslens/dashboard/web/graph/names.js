// Which names are shown: all once there is room, before that as many as fit without touching a disc or each other.

/** From this zoom on, every name is shown in the size of the picture. */
export const READABLE = 0.66;
const WIDTH = 6.9;
const HEIGHT = 15;

/**
 * Show names for a zoom. `order` is who comes first; `places` are where they stand. While only some have a name, because
 * a selection dims the rest, a name may lie on a dimmed disc.
 */
export function showNames(svg, elements, nodes, order, places, camera) {
  const all = camera.k >= READABLE;
  svg.classList.toggle("no-names", !all);
  svg.style.setProperty("--zoom", String(Math.min(camera.k, 1)));
  if (all) {
    elements.forEach((element, number) => {
      element.classList.remove("named");
      putName(element, nodes[number].r, false);
    });
    return;
  }
  const { width, height } = camera.size();
  const taken = new Rows();
  const bright = order.length < places.size ? new Set(order) : places;
  for (const [number, place] of places) {
    if (!bright.has(number)) continue;
    const [x, y, r] = [camera.k * place.x + camera.x, camera.k * place.y + camera.y, camera.k * nodes[number].r];
    taken.add({ owner: number, left: x - r, right: x + r, top: y - r, bottom: y + r });
  }
  const named = new Set();
  for (const number of order) {
    const place = places.get(number);
    if (!place) continue;
    const x = camera.k * place.x + camera.x;
    const y = camera.k * place.y + camera.y;
    const away = camera.k * (nodes[number].r + 2);
    const half = (nodes[number].label.length * WIDTH) / 2;
    const from = (top) => ({ owner: number, left: x - half, right: x + half, top, bottom: top + HEIGHT });
    const box = [from(y + away), from(y - away - HEIGHT)].find(
      (one) => one.right > 0 && one.left < width && one.bottom > 0 && one.top < height && taken.free(one),
    );
    if (!box) continue;
    putName(elements[number], nodes[number].r, box.top < y);
    taken.add(box);
    named.add(number);
  }
  elements.forEach((element, number) => element.classList.toggle("named", named.has(number)));
}

/** Below its disc, or above it where there is no room below. */
function putName(element, radius, above) {
  element.classList.toggle("above", above);
  element.lastElementChild.setAttribute("y", (above ? -radius - 2 : radius + 2).toFixed(1));
}

/** Boxes by the rows of the picture that they cross, so that only near ones are compared. */
class Rows {
  constructor() {
    this.rows = new Map();
  }

  of(box) {
    const found = [];
    for (let row = Math.floor(box.top / HEIGHT); row <= Math.floor(box.bottom / HEIGHT); row += 1) found.push(row);
    return found;
  }

  add(box) {
    for (const row of this.of(box)) this.rows.set(row, [...(this.rows.get(row) || []), box]);
  }

  free(box) {
    const touches = (other) =>
      other.owner !== box.owner && other.left < box.right + 3 && box.left < other.right + 3 && other.top < box.bottom && box.top < other.bottom;
    return !this.of(box).some((row) => (this.rows.get(row) || []).some(touches));
  }
}

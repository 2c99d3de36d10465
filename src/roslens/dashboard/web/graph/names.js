// Which names are shown: all once there is room, before that as many as fit without touching a disc or each other.

/** From this zoom on, every name is shown in the size of the picture. */
export const READABLE = 0.66;
const WIDTH = 6.9;
const HEIGHT = 15;

/**
 * Show names for a zoom. `order` is who comes first; `places` are where they stand. While only some have a name, because
 * a selection dims the rest, a name may lie on a dimmed disc. `shape` says how discs are drawn that are none: their half
 * height and width and where the name goes.
 */
export function showNames(svg, elements, nodes, order, places, camera, shape = DISC, titles = []) {
  const all = camera.k >= READABLE;
  svg.classList.toggle("no-names", !all);
  svg.style.setProperty("--zoom", String(Math.min(camera.k, 1)));
  if (all) {
    elements.forEach((element, number) => {
      element.classList.remove("named");
      shape.put(element, nodes[number], "home");
    });
    return;
  }
  const { width, height } = camera.size();
  const taken = new Rows();
  const bright = order.length < places.size ? new Set(order) : places;
  for (const [number, place] of places) {
    if (!bright.has(number)) continue;
    const [x, y] = [camera.k * place.x + camera.x, camera.k * place.y + camera.y];
    const [across, down] = [camera.k * shape.across(nodes[number]), camera.k * shape.down(nodes[number])];
    taken.add({ owner: number, left: x - across, right: x + across, top: y - down, bottom: y + down });
  }
  titles.forEach(({ x, y, width: across }, number) => {
    const [left, top] = [camera.k * x + camera.x, camera.k * y + camera.y];
    taken.add({ owner: `title ${number}`, left, right: left + across, top: top - HEIGHT, bottom: top });
  });
  const named = new Set();
  for (const number of order) {
    const place = places.get(number);
    if (!place) continue;
    const x = camera.k * place.x + camera.x;
    const y = camera.k * place.y + camera.y;
    const away = camera.k * (shape.down(nodes[number]) + 2);
    const half = (nodes[number].label.length * WIDTH) / 2;
    const from = (top) => ({ owner: number, left: x - half, right: x + half, top, bottom: top + HEIGHT });
    const box = [from(y + away), from(y - away - HEIGHT)].find(
      (one) => one.right > 0 && one.left < width && one.bottom > 0 && one.top < height && taken.free(one),
    );
    if (!box) continue;
    shape.put(elements[number], nodes[number], box.top < y ? "above" : "below");
    taken.add(box);
    named.add(number);
  }
  elements.forEach((element, number) => element.classList.toggle("named", named.has(number)));
}

/** A disc has its name below, or above where there is no room below. */
const DISC = {
  across: (node) => node.r,
  down: (node) => node.r,
  put(element, node, where) {
    const above = where === "above";
    element.classList.toggle("above", above);
    element.lastElementChild.setAttribute("y", (above ? -node.r - 2 : node.r + 2).toFixed(1));
  },
};

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

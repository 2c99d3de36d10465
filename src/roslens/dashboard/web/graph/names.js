// Which names are shown: all once there is room, before that as many as fit without touching a disc or each other.

/** From this zoom on, every name is shown in the size of the picture. */
export const READABLE = 0.66;
const WIDTH = 6.9;
const HEIGHT = 15;
const SLIM = 13;
/** Between a disc and the name beside it, and between a name and the end of the picture, in pixels. */
const GAP = 5;
const EDGE = 4;

/**
 * Show names for a zoom. `order` is who comes first; `places` are where they stand. While only some have a name, because
 * a selection dims the rest, a name may lie on a dimmed disc. `shape` says how discs are drawn that are none: how far they
 * reach to the left, the right and up, where a name is centred, whether it may stand beside them, and where it goes.
 */
export function showNames(svg, elements, nodes, order, places, camera, shape = DISC, titles = []) {
  const all = camera.k >= READABLE;
  svg.classList.toggle("no-names", !all);
  svg.style.setProperty("--zoom", String(Math.min(camera.k, 1)));
  if (all) {
    elements.forEach((element, number) => {
      element.classList.remove("named");
      shape.put(element, nodes[number], "home", shape === DISC ? aside(nodes[number], places.get(number), camera) : 0);
    });
    return;
  }
  const taken = new Rows();
  const bright = order.length < places.size ? new Set(order) : places;
  for (const [number, place] of places) if (bright.has(number)) taken.add(discOf(number, nodes[number], place, camera, shape));
  titles.forEach(({ x, y, width: across }, number) => {
    const [left, top] = [camera.k * x + camera.x, camera.k * y + camera.y];
    taken.add({ owner: `title ${number}`, left, right: left + across, top: top - HEIGHT, bottom: top });
  });
  const named = new Set();
  for (const number of order) {
    const place = places.get(number);
    const name = place && roomsFor(number, nodes[number], place, camera, shape).find((one) => taken.free(one));
    if (!name) continue;
    shape.put(elements[number], nodes[number], name.where, name.shift / camera.k);
    taken.add(name);
    named.add(number);
  }
  elements.forEach((element, number) => element.classList.toggle("named", named.has(number)));
}

/** How far the name of a disc moves aside, in the size of the picture, where that ends: a name that is cut says nothing. */
function aside(node, place, camera) {
  if (!place || !camera.size) return 0;
  const { width } = camera.size();
  const centre = camera.k * place.x + camera.x;
  const half = (camera.k * node.label.length * WIDTH) / 2;
  const reach = camera.k * node.r;
  if (centre < -reach || centre > width + reach || 2 * half > width - 2 * EDGE) return 0;
  return (Math.max(half + EDGE, Math.min(width - EDGE - half, centre)) - centre) / camera.k;
}

function discOf(number, node, place, camera, shape) {
  const [x, y] = [camera.k * place.x + camera.x, camera.k * place.y + camera.y];
  const down = camera.k * shape.down(node);
  return { owner: number, left: x - camera.k * shape.left(node), right: x + camera.k * shape.right(node), top: y - down, bottom: y + down };
}

/** Where a name may stand: below, above, beside; moved aside where the picture ends. */
function roomsFor(number, node, place, camera, shape) {
  const { width, height } = camera.size();
  const disc = discOf(number, node, place, camera, shape);
  const long = node.label.length * WIDTH;
  const centre = camera.k * (place.x + shape.centre(node)) + camera.x;
  const away = camera.k * 2;
  const inside = centre > 0 && centre < width;
  const over = (aside) => {
    const wished = centre - long / 2 + aside;
    const left = inside ? Math.max(EDGE, Math.min(width - EDGE - long, wished)) : wished;
    return { owner: number, left, right: left + long, shift: left + long / 2 - centre };
  };
  const below = { where: "below", top: disc.bottom + away, bottom: disc.bottom + away + HEIGHT };
  const above = { where: "above", top: disc.top - away - HEIGHT, bottom: disc.top - away };
  const rooms = [
    { ...over(0), ...below },
    { ...over(0), ...above },
  ];
  if (shape.beside(node)) {
    const middle = (disc.top + disc.bottom) / 2;
    const level = { owner: number, shift: 0, top: middle - SLIM / 2, bottom: middle + SLIM / 2 };
    rooms.push({ ...level, where: "right", left: disc.right + GAP, right: disc.right + GAP + long });
    rooms.push({ ...level, where: "left", left: disc.left - GAP - long, right: disc.left - GAP });
  }
  // A name longer than its box may also begin or end where the box does.
  const aside = shape.beside(node) ? (long - (disc.right - disc.left)) / 2 : 0;
  if (aside > 0) for (const by of [aside, -aside]) rooms.push({ ...over(by), ...below }, { ...over(by), ...above });
  const seen = (one) => (one.where === "left" || one.where === "right" ? one.left > 0 && one.right < width : one.right > 0 && one.left < width);
  return rooms.filter((one) => seen(one) && one.bottom > 0 && one.top < height);
}

/** A disc has its name below, or above where there is no room below. */
const DISC = {
  left: (node) => node.r,
  right: (node) => node.r,
  down: (node) => node.r,
  centre: () => 0,
  beside: () => false,
  put(element, node, where, shift) {
    const above = where === "above";
    element.classList.toggle("above", above);
    element.lastElementChild.setAttribute("x", shift.toFixed(1));
    element.lastElementChild.setAttribute("y", (above ? -node.r - 2 : node.r + 2).toFixed(1));
  },
};

/** Boxes by the rows of the picture that they cross, so that only near ones are compared. */
export class Rows {
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

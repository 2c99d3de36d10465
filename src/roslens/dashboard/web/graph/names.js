// Which names are shown: all once there is room, before that as many as fit without touching each other.

const READABLE = 0.66;
const WIDTH = 6.9;
const HEIGHT = 15;

/** Show names for a zoom. `order` is who comes first; `places` are where they stand. */
export function showNames(svg, elements, nodes, order, places, camera) {
  const all = camera.k >= READABLE;
  svg.classList.toggle("no-names", !all);
  svg.style.setProperty("--zoom", String(Math.min(camera.k, 1)));
  if (all) {
    for (const element of elements) element.classList.remove("named");
    return;
  }
  const { width, height } = camera.size();
  const taken = new Map();
  const named = new Set();
  for (const number of order) {
    const place = places.get(number);
    if (!place) continue;
    const x = camera.k * place.x + camera.x;
    const y = camera.k * (place.y + nodes[number].r) + camera.y;
    const half = (nodes[number].label.length * WIDTH) / 2;
    if (x + half < 0 || x - half > width || y < 0 || y > height) continue;
    if (claim(taken, x - half, x + half, y)) named.add(number);
  }
  elements.forEach((element, number) => element.classList.toggle("named", named.has(number)));
}

/** Take the room of a name unless another one has part of it. Rows of the map are as high as a name. */
function claim(taken, left, right, y) {
  const row = Math.floor(y / HEIGHT);
  for (const near of [row - 1, row, row + 1]) {
    for (const [start, end, at] of taken.get(near) || []) {
      if (left < end + 6 && start < right + 6 && Math.abs(at - y) < HEIGHT) return false;
    }
  }
  taken.set(row, [...(taken.get(row) || []), [left, right, y]]);
  return true;
}

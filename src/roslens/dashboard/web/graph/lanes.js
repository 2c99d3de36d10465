// Elements in columns and in boxes of namespaces, closed up around those that are visible; the modules of plan/ explain it.

const ROOM = 10;
const PAD = 12;
const HEAD = 20;
const BETWEEN = 16;
const EDGE = 16;
const GAP = 90;
const TIP = 6;
const TURN = 13;
const ASPECT = 1.6;
const LOOSEST = 22;

const parts = (name) => name.split("/").filter(Boolean);

/** Places of the visible elements and the boxes around them. `column` says in which column an element stands. */
export function closeUp(nodes, visible, lanes, column) {
  const left = EDGE + PAD;
  const spans = new Map();
  let x = left;
  for (const number of [...new Set([...visible].map(column))].sort((a, b) => a - b)) {
    const width = Math.max(...[...visible].filter((place) => column(place) === number).map((place) => nodes[place].w));
    spans.set(number, [x, x + width]);
    x += width + GAP;
  }
  const room = ROOM + looser(nodes, visible, column, x - GAP + PAD);
  const places = new Map();
  const reach = [];
  let top = EDGE;
  let before = [];
  lanes.forEach((name, lane) => {
    const members = [...visible].filter((place) => nodes[place].lane === lane).sort((a, b) => nodes[a].row - nodes[b].row);
    if (!members.length) return;
    const after = parts(name);
    let common = 0;
    while (common < Math.min(before.length, after.length) && before[common] === after[common]) common += 1;
    top += (before.length - common) * PAD + (reach.length ? BETWEEN : 0) + (after.length - common) * HEAD;
    const heights = new Map();
    for (const place of members) heights.set(column(place), (heights.get(column(place)) || 0) + nodes[place].h + room);
    const height = Math.max(...heights.values());
    const next = new Map([...heights].map(([number, own]) => [number, top + (height - own) / 2]));
    for (const place of members) {
      const span = spans.get(column(place));
      const own = nodes[place].h + room;
      places.set(place, { x: (span[0] + span[1]) / 2, y: next.get(column(place)) + own / 2 });
      next.set(column(place), next.get(column(place)) + own);
    }
    reach.push({ name, depth: after.length, top, bottom: top + height, first: Math.min(...members.map(column)), last: Math.max(...members.map(column)) });
    top += height;
    before = after;
  });
  return { places, boxes: boxesOf(reach, spans), width: Math.max(EDGE, x - GAP + PAD + EDGE), height: top + EDGE };
}

/** How much further apart rows stand, so that a wide picture fills the room and names fit between them. */
function looser(nodes, visible, column, width) {
  const rows = new Map();
  for (const place of visible) {
    const key = `${nodes[place].lane} ${column(place)}`;
    const [count, height] = rows.get(key) || [0, 0];
    rows.set(key, [count + 1, height + nodes[place].h + ROOM]);
  }
  const lanes = new Map();
  for (const [key, [count, height]] of rows) {
    const [most, tall] = lanes.get(Number.parseInt(key, 10)) || [0, 0];
    lanes.set(Number.parseInt(key, 10), [Math.max(most, count), Math.max(tall, height)]);
  }
  const [count, height] = [...lanes.values()].reduce(([a, b], [c, d]) => [a + c, b + d], [0, EDGE]);
  return Math.max(0, Math.min(LOOSEST, (width / ASPECT - height) / Math.max(1, count)));
}

/** How many steps right (or, negative, left) of one element the others stand, by the way things flow. */
export function stepsFrom(nodes, dependents, centre) {
  const found = new Map([[centre, 0]]);
  const open = [centre];
  for (const place of open) {
    const ways = [[nodes[place].needs, 1], [dependents[place], -1]];
    for (const [others, way] of ways) {
      for (const other of others) {
        if (found.has(other)) continue;
        found.set(other, found.get(place) + way);
        open.push(other);
      }
    }
  }
  return found;
}

function boxesOf(reach, spans) {
  const names = [...new Set(reach.flatMap(({ name }) => parts(name).map((_, depth) => `/${parts(name).slice(0, depth + 1).join("/")}`)))].sort();
  const deepest = Math.max(1, ...names.map((name) => parts(name).length));
  return names.map((name) => {
    const members = reach.filter((lane) => lane.name === name || lane.name.startsWith(`${name}/`));
    const depth = parts(name).length - 1;
    const side = (PAD * (deepest - depth)) / deepest;
    const first = members.reduce((a, b) => (b.top < a.top ? b : a));
    const last = members.reduce((a, b) => (b.bottom > a.bottom ? b : a));
    const x = spans.get(Math.min(...members.map((lane) => lane.first)))[0] - side;
    const y = first.top - HEAD * (first.depth - depth);
    return {
      name,
      title: titleOf(parts(name)),
      depth,
      x,
      y,
      width: spans.get(Math.max(...members.map((lane) => lane.last)))[1] + side - x,
      height: last.bottom + (PAD / 2) * (last.depth - depth) - y,
    };
  });
}

/** A host by its name, an outer namespace in full, an inner one by its end, as boxes.py has it. */
function titleOf(names) {
  const last = names[names.length - 1];
  if (last.startsWith("@")) return `host ${last.slice(1)}`;
  return names.length === 1 || (names.length === 2 && names[0].startsWith("@")) ? `/${last}` : last;
}

const point = (x, y) => `${x.toFixed(1)} ${y.toFixed(1)}`;
const bend = (x, y, to, height) => `H${x.toFixed(1)}C${point((x + to) / 2, y)} ${point((x + to) / 2, height)} ${point(to, height)}`;
const tip = (x, y) => `M${point(x - TIP, y - TIP / 2)}L${point(x, y)}L${point(x - TIP, y + TIP / 2)}`;

/** A line from the right side of an element to the left side of another, with an arrow at its end. */
export function line(a, b, from, to) {
  const [right, left] = [a.x + from.w / 2, b.x - to.w / 2];
  if (right < left) return `M${point(right, a.y)}${bend(right, a.y, left, b.y)}${tip(left, b.y)}`;
  return around(a, b, from, to, right, left);
}

/** One that runs back: it turns round beside both of its ends. */
function around(a, b, from, to, right, left) {
  const beyond = (one, node, other) => one.y + (other.y < one.y ? -1 : 1) * (node.h / 2 + ROOM / 2);
  const [y, end] = [beyond(a, from, b), beyond(b, to, a)];
  const parts = [`M${point(right, a.y)}`];
  if (Math.abs(a.x - b.x) < (from.w + to.w) / 2) {
    const far = Math.max(right, b.x + to.w / 2);
    const out = far + TURN + Math.min(30, Math.abs(a.y - b.y) / 8);
    parts.push(`H${far.toFixed(1)}C${point(out, a.y)} ${point(out, end)} ${point(far, end)}`);
  } else {
    parts.push(`C${point(right + TURN, a.y)} ${point(right + TURN, y)} ${point(right, y)}`, bend(a.x - from.w / 2, y, b.x + to.w / 2, end));
  }
  parts.push(`H${left.toFixed(1)}C${point(left - TURN, end)} ${point(left - TURN, b.y)} ${point(left, b.y)}`, tip(left, b.y));
  return parts.join("");
}

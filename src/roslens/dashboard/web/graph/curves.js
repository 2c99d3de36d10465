// Lines from a package to one that needs it, bent around the discs that lie between.

/** Names stand below discs, so a bend upwards comes first. */
const BENDS = [0, -1, 1, -2, 2, -3, 3, -4, 4];
const STEP = 26;
const PER_LENGTH = 0.06;
const SAMPLES = 14;
const CLEAR = 3;

/** Path between two places with radii; the line keeps clear of the discs of `others` if one of a few bends does. */
export function curve([a, b], [ra, rb], others) {
  if (a.x === b.x) return bow(a, b, ra, rb);
  const sign = a.x < b.x ? 1 : -1;
  const [start, end] = [{ x: a.x + sign * ra, y: a.y }, { x: b.x - sign * rb, y: b.y }];
  const between = others.filter((one) => one.x > Math.min(start.x, end.x) && one.x < Math.max(start.x, end.x));
  // The longer the line the wider its bend, so that several of them lie beside each other.
  const step = STEP + PER_LENGTH * Math.abs(end.x - start.x);
  let best = null;
  for (const bend of BENDS) {
    const points = bent(start, end, bend * step);
    const hits = between.filter((disc) => touches(points, disc)).length;
    if (!best || hits < best.hits) best = { points, hits };
    if (!hits) break;
  }
  const [p, c, d, q] = best.points.map((point) => `${point.x.toFixed(1)} ${point.y.toFixed(1)}`);
  return `M${p}C${c} ${d} ${q}`;
}

/** Two in one column: a bow beside it. */
function bow(a, b, ra, rb) {
  const out = a.x + Math.max(ra, rb) + 28;
  return `M${a.x + ra} ${a.y}C${out} ${a.y} ${out} ${b.y} ${b.x + rb} ${b.y}`;
}

function bent(start, end, offset) {
  const middle = (start.x + end.x) / 2;
  // A bend is steeper near its ends, so that it leaves the row before the first disc.
  const [first, second] = offset ? [start.x + (end.x - start.x) * 0.22, end.x - (end.x - start.x) * 0.22] : [middle, middle];
  return [start, { x: first, y: start.y + offset * 1.4 }, { x: second, y: end.y + offset * 1.4 }, end];
}

function touches([p, c, d, q], disc) {
  for (let step = 1; step < SAMPLES; step += 1) {
    const t = step / SAMPLES;
    const u = 1 - t;
    const x = u * u * u * p.x + 3 * u * u * t * c.x + 3 * u * t * t * d.x + t * t * t * q.x;
    const y = u * u * u * p.y + 3 * u * u * t * c.y + 3 * u * t * t * d.y + t * t * t * q.y;
    if (Math.hypot(x - disc.x, y - disc.y) < disc.r + CLEAR) return true;
  }
  return false;
}

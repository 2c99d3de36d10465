// The level parts of lines: a name stands best on one that no other line shares, for there it says which line it is of.

/** Lines nearer to each other than this cannot be told apart by where a name stands. */
const NEAR = 5;
/** A name leaves so much of the level part in sight at each end. */
const END = 4;
const SHARES = [0.5, 0.3, 0.7];

/** The level parts of a path of straight and bent parts. */
function levelsOf(path) {
  const found = [];
  let [x, y] = [0, 0];
  for (const [, kind, text] of path.matchAll(/([MHVQCLqml])([^MHVQCLqml]*)/g)) {
    const numbers = text.trim().split(/[\s,]+/).map(Number);
    if (kind === "H") {
      const last = found.at(-1);
      const [left, right] = [Math.min(x, numbers[0]), Math.max(x, numbers[0])];
      // Parts that go on from each other are one.
      if (last && last.y === y && last.right === left) last.right = right;
      else found.push({ y, left, right });
      x = numbers[0];
    } else if (kind === "V") y = numbers[0];
    else {
      const [across, down] = numbers.slice(-2);
      [x, y] = kind === kind.toLowerCase() ? [x + across, y + down] : [across, down];
    }
  }
  return found;
}

export class Levels {
  /** Look at the lines of these paths. */
  constructor(paths) {
    this.of = new Map(paths.map((path) => [path, levelsOf(path)]));
    this.rows = new Map();
    for (const [path, parts] of this.of) {
      for (const part of parts) {
        const row = Math.round(part.y / NEAR);
        if (!this.rows.has(row)) this.rows.set(row, []);
        this.rows.get(row).push({ path, ...part });
      }
    }
  }

  /** Middles for a name on a line, those first where fewest other lines run. */
  places(path, width) {
    const found = [];
    for (const { y, left, right } of this.of.get(path) || []) {
      const room = right - left - width - 2 * END;
      if (room < 0) continue;
      for (const share of SHARES) {
        const x = left + END + width / 2 + room * share;
        found.push({ x, y, shared: this.beside(path, y, x - width / 2, x + width / 2) });
      }
    }
    return found.sort((one, other) => one.shared - other.shared);
  }

  beside(path, y, left, right) {
    const row = Math.round(y / NEAR);
    let count = 0;
    for (const part of [row - 1, row, row + 1].flatMap((one) => this.rows.get(one) || [])) {
      if (part.path !== path && Math.abs(part.y - y) < NEAR && part.left < right && part.right > left) count += 1;
    }
    return count;
  }
}

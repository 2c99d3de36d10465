// The shortest way along the arrows from one element of the computation graph to another.

/** Numbers from `start` to `end`; empty where nothing flows from one to the other. `visible` are those to go through. */
export function wayBetween(nodes, visible, start, end) {
  const before = new Map([[start, -1]]);
  const open = [start];
  for (let place = 0; place < open.length && !before.has(end); place += 1) {
    for (const next of nodes[open[place]].needs) {
      if (!visible.has(next) || before.has(next)) continue;
      before.set(next, open[place]);
      open.push(next);
    }
  }
  if (!before.has(end)) return [];
  const way = [];
  for (let at = end; at >= 0; at = before.get(at)) way.unshift(at);
  return way;
}

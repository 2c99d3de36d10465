// A package and those at most n steps away, closed up so that they fit the picture.

const PITCH = 48;
const GAP = 60;

/** Who needs each node. */
export function dependentsOf(nodes) {
  const found = nodes.map(() => []);
  nodes.forEach((node, place) => node.needs.forEach((needed) => found[needed].push(place)));
  return found;
}

/** Nodes at most `hops` steps from one of them, in either direction. */
export function around(nodes, dependents, centre, hops) {
  const found = new Set([centre]);
  let rim = [centre];
  for (let hop = 0; hop < hops; hop += 1) {
    const next = [];
    for (const place of rim) {
      for (const other of [...nodes[place].needs, ...dependents[place]]) {
        if (!found.has(other)) {
          found.add(other);
          next.push(other);
        }
      }
    }
    rim = next;
  }
  return found;
}

/** Places of the visible nodes: same columns and order, without the gaps that the hidden ones leave. */
export function closeUp(nodes, visible) {
  const columns = new Map();
  for (const place of [...visible].sort((a, b) => nodes[a].y - nodes[b].y)) {
    const column = nodes[place].column;
    columns.set(column, [...(columns.get(column) || []), place]);
  }
  const found = new Map();
  let left = 0;
  for (const column of [...columns.keys()].sort((a, b) => a - b)) {
    const members = columns.get(column);
    const width = Math.max(...members.map((place) => Math.max(2 * nodes[place].r, nodes[place].label.length * 6.9)));
    members.forEach((place, row) => found.set(place, { x: left + width / 2, y: (row - (members.length - 1) / 2) * PITCH }));
    left += width + GAP;
  }
  return found;
}

/** Edges among the visible nodes that no longer way among them says already. */
export function reducedEdges(nodes, visible) {
  const edges = [];
  for (const from of visible) {
    for (const to of nodes[from].needs) {
      if (!visible.has(to)) continue;
      const others = nodes[from].needs.filter((other) => other !== to && visible.has(other));
      if (!reaches(nodes, visible, others, to, from)) edges.push([from, to]);
    }
  }
  return edges;
}

function reaches(nodes, visible, starts, goal, without) {
  const seen = new Set([without, ...starts]);
  const open = [...starts];
  while (open.length) {
    const place = open.pop();
    if (place === goal) return true;
    for (const next of nodes[place].needs) {
      if (visible.has(next) && !seen.has(next)) {
        seen.add(next);
        open.push(next);
      }
    }
  }
  return false;
}

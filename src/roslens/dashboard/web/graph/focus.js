// A package and those at most n steps away, closed up so that they fit the picture.

const LABEL = 15;
const ROOM = 14;
const GAP = 60;
const ASPECT = 1.6;
const TALLEST = 2.4;

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
    const heights = members.map((place) => 2 * nodes[place].r + LABEL + ROOM);
    let top = -heights.reduce((sum, height) => sum + height, 0) / 2;
    members.forEach((place, row) => {
      found.set(place, { x: left + width / 2, y: top + nodes[place].r + ROOM / 2 });
      top += heights[row];
    });
    left += width + GAP;
  }
  return pulledApart(found, left);
}

/** The same places with more room between rows where the picture would be low and wide, as lay_out.py does it. */
function pulledApart(places, width) {
  const ys = [...places.values()].map((place) => place.y);
  const height = Math.max(...ys) - Math.min(...ys);
  const stretch = height > 0 ? Math.min(TALLEST, Math.max(1, width / ASPECT / height)) : 1;
  for (const place of places.values()) place.y *= stretch;
  return places;
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

// Makes the next snapshot of the one that the page holds, as changes.py says.

/** Write a change into a snapshot. */
export function apply(snapshot, { parts = {}, order = null, rows = [], cells = [], items = [], links = [] }) {
  Object.assign(snapshot, parts);
  if (order || rows.length) reorder(snapshot, order, rows);
  const keys = snapshot.columns.map((column) => column[0]);
  for (const [place, ...texts] of cells) {
    const shown = {};
    texts.forEach((text, at) => { if (text !== null) shown[keys[at]] = text; });
    snapshot.rows[place].shown = shown;
  }
  for (const [place, state] of items) snapshot.picture.items[place].state = state;
  for (const [place, state, rate, latency, bandwidth, age, lag] of links) Object.assign(snapshot.picture.links[place], { state, rate, latency, bandwidth, age, lag });
  return snapshot;
}

function reorder(snapshot, order, rows) {
  const fresh = new Map(rows.map((row) => [row.key, row]));
  if (!order) {
    snapshot.rows.forEach((row, at) => { if (fresh.has(row.key)) snapshot.rows[at] = fresh.get(row.key); });
    return;
  }
  const known = new Map(snapshot.rows.map((row) => [row.key, row]));
  snapshot.rows = order.map((key) => fresh.get(key) || known.get(key));
}

// What is left out of a computation graph; noise.py explains it.

/** Whether a name fits one of the patterns of a shell; one without a wildcard also means what lies below it. */
export function matcher(patterns) {
  const found = patterns.map((pattern) => {
    const wild = /[*?[]/.test(pattern);
    const body = pattern.replace(/[.+^${}()|\\\]]/g, "\\$&").replace(/\*/g, ".*").replace(/\?/g, ".").replace(/\[/g, "\\[");
    return new RegExp(`^${wild ? body : `${body.replace(/\/$/, "")}(/.*)?`}$`);
  });
  return (name) => found.some((pattern) => pattern.test(name));
}

/** Numbers of the elements that are not left out; a topic that no visible wire ends at is left out too. */
export function visibleOf(graph, noise, patterns) {
  const hidden = matcher(patterns);
  const joined = new Set();
  for (const wire of graph.wires) {
    if (wire.implicit && noise.has("implicit")) continue;
    joined.add(wire.source);
    joined.add(wire.target);
  }
  const shown = ({ noise: own, name, kind }, number) => !own.some((preset) => noise.has(preset)) && !hidden(name) && (kind === "node" || joined.has(number));
  return new Set(graph.nodes.map((_, number) => number).filter((number) => shown(graph.nodes[number], number)));
}

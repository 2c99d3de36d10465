// What each package's colour stands for: findings under a tag filter, per thousand lines, or a metric.

/** Which kinds of rule the tag filter means: any tag of `include` (if there are any), none of `exclude`. */
export function wantedRules(graph, include, exclude) {
  const number = new Map(graph.tags.map((tag, place) => [tag.toLocaleLowerCase(), place]));
  const wanted = include.map((tag) => number.get(tag.toLocaleLowerCase()) ?? -1);
  const unwanted = exclude.map((tag) => number.get(tag.toLocaleLowerCase()) ?? -1);
  return graph.rules.map(
    (rule) => (!wanted.length || wanted.some((tag) => rule.tags.includes(tag))) && !unwanted.some((tag) => rule.tags.includes(tag)),
  );
}

/** Findings of a node under the filter. */
export function findingsOf(node, rules, own) {
  let total = 0;
  for (const [rule, count, gated] of node.counts) if (rules[rule]) total += own ? gated : count;
  return total;
}

/** The quantity that colours: title, unit, digits, which way it is better, and a value per node. */
export function colourOf(graph, settings) {
  const metric = settings.colour.startsWith("metric:") && graph.metrics.find((one) => `metric:${one.key}` === settings.colour);
  if (metric) return metric;
  const rules = wantedRules(graph, settings.include, settings.exclude);
  if (settings.colour === "kloc") {
    // Lines of code are those of own code, so findings are too.
    const values = graph.nodes.map((node) => (node.loc ? (1000 * findingsOf(node, rules, true)) / node.loc : null));
    return { title: "Findings per 1,000 lines of own code", unit: "", decimals: 1, better: "lower", values };
  }
  const values = graph.nodes.map((node) => findingsOf(node, rules, settings.own));
  return { title: settings.own ? "Findings in own code" : "Findings in all code", unit: "", decimals: 0, better: "lower", values };
}

/** Tag -> findings that carry it in the visible nodes. */
export function tagCounts(graph, visible, own) {
  const ofRule = graph.rules.map(() => 0);
  for (const place of visible) for (const [rule, count, gated] of graph.nodes[place].counts) ofRule[rule] += own ? gated : count;
  const totals = graph.tags.map(() => 0);
  graph.rules.forEach((rule, place) => rule.tags.forEach((tag) => (totals[tag] += ofRule[place])));
  return new Map(graph.tags.map((tag, place) => [tag, totals[place]]).filter(([, count]) => count > 0).sort((a, b) => b[1] - a[1]));
}

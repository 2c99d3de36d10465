// The side panel: what a selected package needs, what needs it, which rules it breaks.

import { withParameters } from "../address.js";
import { figure, glyph, make } from "../dom.js";

const MOST = 12;

export function list(title, entries, empty, counted = true) {
  const shown = entries.slice(0, MOST);
  return [
    make("h3", { text: entries.length && counted ? `${title} (${entries.length})` : title }),
    entries.length ? make("ul", {}, ...shown) : make("p", { class: "quiet", text: empty }),
    entries.length > MOST ? make("p", { class: "quiet", text: `${MOST} of ${entries.length} shown` }) : null,
  ];
}

/** What the panel says of a package, or of all where none is selected. */
export function contentOf(view, number) {
  if (number < 0) {
    const sums = view.visible.size === view.graph.nodes.length ? "all" : "shown";
    return [
      make("h2", { text: `${figure(view.visible.size)} packages` }),
      make("p", { class: "quiet", text: `Select one to see what it needs, what needs it and which rules it breaks.` }),
      ...list(`${view.colour.title}: ${view.colour.better === "higher" ? "lowest" : "highest"}`, worst(view), sums === "all" ? "Nothing to show." : "Nothing among those shown.", false),
    ];
  }
  const node = view.graph.nodes[number];
  const pick = (other) =>
    make("li", {}, make("button", { type: "button", class: "pick", text: view.graph.nodes[other].id, onclick: () => view.select(other) }), make("span", { class: "quiet", text: view.textOf(other) }));
  const rules = node.counts
    .filter(([rule]) => view.rules[rule])
    .map(([rule, count, gated]) => [view.graph.rules[rule], view.settings.own || view.settings.colour === "kloc" ? gated : count])
    .filter(([, count]) => count)
    .sort((a, b) => b[1] - a[1]);
  const href = view.elements[number].getAttribute("href");
  const filter = { include: view.settings.include.join(","), exclude: view.settings.exclude.join(",") };
  return [
    make("h2", { text: node.id }),
    make("p", {}, `${view.textOf(number)} ${view.colour.title.toLocaleLowerCase()}${view.colour.unit ? ` ${view.colour.unit}` : ""}`),
    make("p", { class: "quiet", text: `${node.loc ? figure(node.loc) : "no"} lines of code, tier ${node.tier}` }),
    make(
      "div",
      { class: "actions" },
      make("a", { href: withParameters(href, filter), text: "Open its page" }),
      make("button", { type: "button", class: "pick", text: "Focus on it", onclick: () => view.focusOn(number) }),
      make("button", { type: "button", class: "pick", text: "Clear", onclick: () => view.select(-1) }),
    ),
    ...list("Rules it breaks", rules.map(([rule, count]) => make("li", {}, make("span", {}, glyph(rule.severity), " ", make("a", { href: ruleHref(href, rule, filter), title: rule.rule, text: rule.title })), make("span", { class: "quiet", text: figure(count) }))), "None under these filters."),
    ...list("Needs", node.needs.map(pick), "Nothing in this workspace."),
    ...list("Needed by", view.dependents[number].map(pick), "Nothing in this workspace."),
  ];
}

/** The findings of a rule on the page of a package. */
function ruleHref(href, rule, filter) {
  const [page] = withParameters(href, { ...filter, rule: rule.rule }).split("#findings");
  return page.startsWith("#") ? page : `${page}#findings`;
}

function worst(view) {
  const falling = view.colour.better === "higher";
  return [...view.visible]
    .filter((place) => view.colour.values[place] !== null && (falling || view.colour.values[place] > 0))
    .sort((a, b) => (falling ? 1 : -1) * (view.colour.values[a] - view.colour.values[b]))
    .slice(0, 8)
    .map((place) =>
      make("li", {}, make("button", { type: "button", class: "pick", text: view.graph.nodes[place].id, onclick: () => view.select(place) }), make("span", { class: "quiet", text: view.textOf(place) })),
    );
}

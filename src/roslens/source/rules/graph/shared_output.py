"""Rule ``graph.shared_output``: two nodes of one program whose outputs are kept apart, except one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode
from roslens.model.finding import Finding
from roslens.model.graph import Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import exclude_each_other, weighed
from roslens.source.rules.graph.ends import listed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.shared_output",
    "Output without a remapping of its own",
    "Two nodes of one program publish on the same topic, while other topics that they publish are remapped to "
    "separate names. Remap this one as well, or give each node a namespace.",
    Consequence.MAY_BE_WRONG,
    Certainty.LIKELY,
    ("ros", "graph", "names", "launch"),
    "The launch description of a second camera or arm is a copy of the first: if one remapping is forgotten, the data "
    "of both is mixed on one topic, and is missing under the intended names.",
)
_Place = tuple[str, int, int]


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each topic that such nodes share."""
    for nodes in _copies(configuration):
        published = [(node, _published(node)) for node in nodes]
        for name, of_name in _sharing(published):
            if surroundings.is_external(name) or any(one.remapped for _node, one in of_name):
                continue
            others = [(node, ends) for node, ends in published if node in [each for each, _one in of_name]]
            if len(of_name) > 1 and (apart := _kept_apart(others)):
                yield _told(name, of_name, apart)


def _sharing(
    published: Sequence[tuple[ConfiguredNode, Mapping[_Place, ConfiguredEndpoint]]],
) -> Iterator[tuple[str, list[tuple[ConfiguredNode, ConfiguredEndpoint]]]]:
    """Yield, for each place of the code that publishes, its topics with who publishes on them from there."""
    for place in sorted({place for _node, ends in published for place in ends}):
        sharing: dict[str, list[tuple[ConfiguredNode, ConfiguredEndpoint]]] = {}
        for node, ends in published:
            if place in ends:
                sharing.setdefault(ends[place].endpoint.name, []).append((node, ends[place]))
        yield from sorted(sharing.items())


def _copies(configuration: Configuration) -> list[list[ConfiguredNode]]:
    """Return the nodes that run the same program, where there are several."""
    groups: dict[tuple[str, str, str], list[ConfiguredNode]] = {}
    for node in configuration.nodes:
        if node.resolved and node.defined is not None:
            groups.setdefault((node.package, node.executable, node.defined.place), []).append(node)
    return [
        nodes
        for nodes in groups.values()
        if len(nodes) > 1 and not any(exclude_each_other(nodes[0].clauses, one.clauses) for one in nodes[1:])
    ]


def _published(node: ConfiguredNode) -> dict[_Place, ConfiguredEndpoint]:
    """Return what a node publishes, by the place in its code."""
    return {
        (one.proof.path, one.proof.line, one.proof.column): one
        for one in node.endpoints
        if one.endpoint.role is Role.PUBLISHER and one.resolved and not one.implicit
    }


def _kept_apart(nodes: list[tuple[ConfiguredNode, dict[_Place, ConfiguredEndpoint]]]) -> list[str]:
    """Return the names of an output that each of the nodes has under another name because it is remapped."""
    first = nodes[0][1]
    for place in sorted(first):
        ends = [ends.get(place) for _node, ends in nodes]
        names = {one.endpoint.name for one in ends if one is not None and one.remapped is not None}
        if len(names) == len(nodes):
            return sorted(names)
    return []


def _told(name: str, of_name: list[tuple[ConfiguredNode, ConfiguredEndpoint]], apart: list[str]) -> Finding:
    node, one = of_name[0]
    certainty, doubt = weighed(RULE.certainty, (one.proof,), (*node.conditions, *one.conditions))
    who = listed([each.name for each, _one in of_name])
    message = (
        f"{who} ({one.proof.place}) all publish topic {name}, while they keep {listed(apart)} apart by remapping. "
        f"Remap `{one.given or name}` for each of them too."
    )
    return occurrence(RULE, message, node.proof, entity=f"topic:{name}", certainty=certainty, doubt=doubt)

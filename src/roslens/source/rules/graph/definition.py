"""Rule ``graph.definition``: ends of one name whose types have the same name and another definition."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration
from roslens.model.finding import Finding
from roslens.model.graphs.end import End
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed, weighed_apart
from roslens.source.rules.graph.ends import by_name, conditions_of, ends
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.definition",
    "Two definitions of one type",
    "Endpoints of one topic, service or action have types of the same name with different fields: their MD5 sums (ROS "
    "1) or type hashes (ROS 2) differ. Build all nodes against the same version of the interface package.",
    Consequence.WRONG,
    Certainty.PROVEN,
    ("ros", "graph", "type", "connectivity"),
    "ROS 1 refuses the connection; ROS 2 may connect the endpoints and deserialize messages with the wrong definition.",
)


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each name with two definitions of one type."""
    for (kind, name), all_ends in by_name(ends(configuration)).items():
        firsts: dict[str, dict[str, End]] = {}
        for end in all_ends:
            if end.type and end.one.endpoint.hash:
                firsts.setdefault(end.type, {}).setdefault(end.one.endpoint.hash, end)
        for type_, by_hash in sorted(firsts.items()):
            if len(by_hash) > 1:
                yield _told(kind, name, type_, list(by_hash.values()), together=surroundings.together)


def _told(kind: str, name: str, type_: str, differing: list[End], *, together: bool) -> Finding:
    good, bad = differing[:2]
    certainty, doubt = weighed(RULE.certainty, (good.one.proof, bad.one.proof), conditions_of(good, bad))
    if not together:
        certainty, doubt = weighed_apart(doubt)
    message = (
        f"{bad.label} and {good.label} use {kind} {name} with different definitions of {type_}: "
        f"{_short(bad)} and {_short(good)}. Build both against the same version of {type_.partition('/')[0]}."
    )
    return occurrence(RULE, message, bad.where, entity=bad.entity, certainty=certainty, context=type_, doubt=doubt)


def _short(end: End) -> str:
    return end.one.endpoint.hash[:14]

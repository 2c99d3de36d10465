"""Rule ``graph.type``: ends of one name that speak of different types."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations, product

from roslens.model.configuration import Configuration
from roslens.model.finding import Finding
from roslens.model.graphs.end import VERB, End
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import doubt_of, exclude_each_other, weighed, weighed_apart
from roslens.source.rules.graph.ends import by_name, conditions_of, ends, exclude, listed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.type",
    "Two types for one name",
    "Endpoints of one topic, service or action have different types. Unknown types, and those that accept any type, "
    "match all; if one node has the name with both types and may choose, it is a note. Rename one of them, or use one "
    "type for both.",
    Consequence.WRONG,
    Certainty.PROVEN,
    ("ros", "graph", "type", "connectivity"),
    "The endpoints are never connected. ROS 1 refuses the connection and logs a message; in ROS 2 the effect depends "
    "on the middleware: no messages, corrupted messages, or a crash.",
)
_APART = "if both nodes decide alike, they have the same type"
_SAME = {"tf/tfMessage": "tf2_msgs/TFMessage"}
"""Types of ROS 1 that have the definition of another one: connections compare definitions, not names."""
_ANY = frozenset({"*", "topic_tools/ShapeShifter", "topic_tools/msg/ShapeShifter"})


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each name that has more than one type."""
    for (kind, name), all_ends in by_name(ends(configuration)).items():
        of_type: dict[str, list[End]] = {}
        for end in all_ends:
            if end.type and end.type not in _ANY:
                of_type.setdefault(_SAME.get(end.type, end.type), []).append(end)
        # What most ends have is taken to be meant; the others are found fault with.
        ranked = sorted(of_type, key=lambda one: (-len(of_type[one]), one))
        types: dict[str, set[str]] = {}
        for one, of_one in of_type.items():
            for end in of_one:
                types.setdefault(end.node.name, set()).add(one)
        pairs = [pair for pair in _pairs(ranked, of_type) if not exclude(*pair)]
        if pairs:
            choosers = [_chooser(first, second, types) for first, second in pairs]
            # What nobody can choose is clearer.
            place = min(range(len(pairs)), key=lambda number: bool(choosers[number]))
            yield _told(kind, name, of_type, ranked, pairs[place], choosers[place], surroundings)


def _pairs(ranked: list[str], of_type: dict[str, list[End]]) -> Iterator[tuple[End, End]]:
    for usual, other in combinations(ranked, 2):
        yield from product(of_type[usual], of_type[other])


def _chooser(first: End, second: End, types: Mapping[str, set[str]]) -> str:
    """Return the node that has the name with the types of both ends, and may choose; empty where none has."""
    if first.node.name == second.node.name:
        sure = (
            not (first.one.conditions or second.one.conditions) and doubt_of((first.one.proof, second.one.proof)) == 0
        )
        return "" if sure else first.node.name
    both = {_SAME.get(one.type, one.type) for one in (first, second)}
    return next((end.node.name for end in (first, second) if both <= types[end.node.name]), "")


def _told(
    kind: str,
    name: str,
    of_type: dict[str, list[End]],
    ranked: list[str],
    pair: tuple[End, End],
    chooser: str,
    surroundings: Surroundings,
) -> Finding:
    good, bad = pair
    apart = _APART if exclude_each_other(good.clauses, bad.clauses) else ""
    if chooser:
        apart = f"{chooser} has it with each of these types, and may choose the one that fits"
    certainty, doubt = weighed(
        Certainty.HEURISTIC if chooser else RULE.certainty,
        (good.one.proof, bad.one.proof),
        conditions_of(good, bad),
        more=apart,
    )
    if not surroundings.together:
        certainty, doubt = weighed_apart(doubt)
    said = "; ".join(
        f"{listed([f'{end.label} {VERB[end.role]} it' for end in of_type[one]])} as {one}" for one in ranked
    )
    message = (
        f"{kind} {name} has {len(ranked)} types: {said}. They are never connected. "
        f"Give all of them one type, or {bad.type} another name."
    )
    return occurrence(
        RULE,
        message,
        bad.where,
        entity=bad.entity,
        certainty=certainty,
        context=" ".join(sorted(ranked)),
        doubt=doubt,
    )

"""Rule ``graph.transform``: a frame that two nodes place, or that has two parents."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from roslens.model.configuration import Configuration
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import exclude_each_other, weighed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings, Transform

RULE = graph_rule(
    "graph.transform",
    "Frame published twice",
    "Two nodes publish the transform to one frame, from different parents or from the same one. Only transforms on "
    "command lines of static_transform_publisher are known. Remove one of the two.",
    Consequence.MAY_BE_WRONG,
    Certainty.HEURISTIC,
    ("ros", "graph", "tf"),
    "Frames form a tree: of two parents the one published last is used, so that positions jump or look-ups fail.",
)


def found(_configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each frame that is placed more than once."""
    by_child: dict[str, list[Transform]] = {}
    for one in surroundings.transforms:
        by_child.setdefault(one.child.lstrip("/"), []).append(one)
    for child, ones in sorted(by_child.items()):
        pairs = [pair for pair in combinations(ones, 2) if not exclude_each_other(*(one.clauses for one in pair))]
        if pairs:
            # Two parents are worse than the same one twice.
            yield _told(child, *min(pairs, key=lambda pair: pair[0].parent == pair[1].parent))


def _told(child: str, first: Transform, second: Transform) -> Finding:
    certainty, doubt = weighed(RULE.certainty, (first.proof, second.proof), (*first.conditions, *second.conditions))
    if first.parent == second.parent:
        both = f"{first.node} ({first.proof.place}) and {second.node} ({second.proof.place})"
        what = f"{both} both place {child} in {first.parent}"
    else:
        what = (
            f"frame {child} has two parents: {first.parent} by {first.node} ({first.proof.place}) "
            f"and {second.parent} by {second.node} ({second.proof.place})"
        )
    message = f"{what}. Remove one of the two."
    return occurrence(
        RULE, message, second.proof, entity=f"node:{second.node}", certainty=certainty, context=child, doubt=doubt
    )

"""Rule ``graph.global_name``: a name in the code that no namespace moves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from roslens.model.configuration import Configuration, Origin
from roslens.model.finding import Finding
from roslens.model.graphs.end import KIND, VERB, End
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.global_name",
    "Global name in code",
    "Code names a topic, service or action with a leading `/`. Names that are global by convention, such as /tf and "
    "/clock, are not reported. Use a relative name, or `~/` for names that belong to the node, and let launch files "
    "assign the namespace.",
    Consequence.HARD_TO_MAINTAIN,
    Certainty.LIKELY,
    ("ros", "graph", "names", "reuse"),
    "A namespace does not change a global name: a second robot, or a second instance of the node, uses the topics of "
    "the first.",
)


_MOST = 5
"""So many further places are named; of more only the number is stated."""


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each global name that a file of code gives to one thing, with all places where it does."""
    seen: set[tuple[str, str]] = set()
    groups: dict[tuple[str, str, str], list[End]] = {}
    for node in configuration.nodes:
        for one in node.endpoints:
            place = (one.proof.place, one.given)
            if one.implicit or one.proof.origin is not Origin.CODE or not one.given.startswith("/") or place in seen:
                continue
            if not surroundings.is_external(one.given):
                seen.add(place)
                end = End(node, one)
                groups.setdefault((end.entity, one.proof.path, one.given), []).append(end)
    for ends in groups.values():
        yield _told(*ends)


def _told(end: End, *others: End) -> Finding:
    given = end.one.given
    certainty, doubt = weighed(RULE.certainty, (), ())
    moved = " A remapping changes it here." if end.one.remapped is not None else ""
    message = (
        f"{end.label} {VERB[end.role]} the {KIND[end.role]} `{given}`, a global name{_also(others)}.{moved} "
        f"Write `{given.lstrip('/')}` and remap or push a namespace in the launch file."
    )
    return occurrence(RULE, message, end.one.proof, entity=end.entity, certainty=certainty, context=given, doubt=doubt)


def _also(others: Sequence[End]) -> str:
    if not others:
        return ""
    places = ", ".join(f"{one.node.name} ({one.one.proof.place})" for one in others[:_MOST])
    return f", as {places}" + (f" and {len(others) - _MOST} more places do" if len(others) > _MOST else "")

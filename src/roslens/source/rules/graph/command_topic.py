"""Rule ``graph.command_topic``: several nodes that command one thing."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration
from roslens.model.finding import Finding
from roslens.model.graph import Role
from roslens.model.graphs.end import End
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import exclude_each_other, weighed
from roslens.source.rules.graph.ends import by_name, conditions_of, ends, listed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.command_topic",
    "Several publishers of a command",
    "More than one node publishes on a topic whose messages cause motion, such as cmd_vel or joint commands. "
    "`command_topics` in `[options.graph]` defines these topics. Let a multiplexer choose the source.",
    Consequence.MAY_BE_WRONG,
    Certainty.HEURISTIC,
    ("ros", "graph", "safety"),
    "The receiver obeys the last message received: commands alternate, and a stop is overruled by the next message.",
)


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each topic of commands with publishers in several nodes."""
    for (kind, name), all_ends in by_name(ends(configuration)).items():
        if kind != "topic" or not surroundings.is_command(name):
            continue
        by_node: dict[str, End] = {}
        for end in all_ends:
            if end.role is Role.PUBLISHER:
                by_node.setdefault(end.node.name, end)
        publishers = _together(list(by_node.values()))
        if len(publishers) > 1:
            yield _told(name, publishers)


def _together(publishers: list[End]) -> list[End]:
    """Return those that run together with at least one other."""
    return [
        one
        for one in publishers
        if any(one is not other and not exclude_each_other(one.clauses, other.clauses) for other in publishers)
    ]


def _told(name: str, publishers: list[End]) -> Finding:
    first, second = publishers[:2]
    certainty, doubt = weighed(RULE.certainty, (first.one.proof, second.one.proof), conditions_of(first, second))
    message = (
        f"{len(publishers)} nodes publish commands on {name}: {listed([end.label for end in publishers])}. "
        "The last message is obeyed; let a multiplexer choose between them."
    )
    names = " ".join(sorted(end.node.name for end in publishers))
    return occurrence(
        RULE, message, second.where, entity=second.entity, certainty=certainty, context=names, doubt=doubt
    )

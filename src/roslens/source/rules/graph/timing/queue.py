"""Rule ``graph.queue``: a queue of one message for a fast topic that nobody sends again."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration
from roslens.model.finding import Finding
from roslens.model.graph import Role
from roslens.model.graphs.end import End
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import by_name, conditions_of, ends
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.queue",
    "Queue of one on a fast topic",
    "A subscription has a queue of one message, for a topic that is published best effort and at a high rate: that of "
    "the publisher's timer, if the publisher has timers and no other trigger. `fast_hz` in `[options.graph]` defines "
    "a high rate. If only the newest message matters, no change is needed.",
    Consequence.MAY_BE_WRONG,
    Certainty.HEURISTIC,
    ("ros", "graph", "qos"),
    "Each message received while a callback runs replaces the previous one; lost messages are not counted.",
)


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each topic with a subscription whose queue is too short."""
    for (kind, name), all_ends in by_name(ends(configuration)).items():
        if kind != "topic":
            continue
        short = [end for end in all_ends if end.role is Role.SUBSCRIPTION and _is_short(end)]
        fast = [
            (rate, end)
            for end in all_ends
            if end.role is Role.PUBLISHER and (rate := _rate_hz(end)) >= surroundings.fast_hz
        ]
        if short and fast:
            yield _told(name, short, *max(fast, key=lambda pair: pair[0]))


def _is_short(end: End) -> bool:
    qos = end.one.endpoint.qos
    return qos is not None and qos.reliability == "best_effort" and qos.history == "keep_last" and qos.depth == 1


def _rate_hz(end: End) -> float:
    """Return how often a node publishes that only its timers move; 0 where that is not known."""
    timers = end.node.timers
    moved = any(other.endpoint.role is Role.SUBSCRIPTION and not other.implicit for other in end.node.endpoints)
    if moved or not timers or any(not timer.period_s for timer in timers):
        return 0.0
    return min(1 / timer.period_s for timer in timers if timer.period_s)


def _told(name: str, short: list[End], rate: float, publisher: End) -> Finding:
    end = short[0]
    certainty, doubt = weighed(RULE.certainty, (end.one.proof,), conditions_of(end, publisher))
    more = f" (and {len(short) - 1} more)" if len(short) > 1 else ""
    message = (
        f"{end.label}{more} keeps 1 message of {name}, which {publisher.label} publishes best effort with {rate:g} Hz: "
        "messages are lost while a callback runs. Keep more, unless only the newest counts."
    )
    return occurrence(
        RULE, message, end.where, entity=end.entity, certainty=certainty, context=end.node.name, doubt=doubt
    )

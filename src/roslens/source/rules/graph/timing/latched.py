"""Rule ``graph.latched``: a subscription misses what was published before it started."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, Origin
from roslens.model.finding import Finding
from roslens.model.graph import Role
from roslens.model.graphs.end import End
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import exclude_each_other, weighed
from roslens.source.rules.graph.ends import by_name, conditions_of, ends, is_unknown
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.latched",
    "Latched message that a late subscription misses",
    "All publishers of a topic keep their last message for those that start later (`transient_local`) and publish "
    "seldom: they are in nodes of the workspace that have neither a timer nor a subscription, or in `map_server`. A "
    "subscription requests `volatile`, so it is not given that message. Request `transient_local` at the subscription.",
    Consequence.MAY_BE_WRONG,
    Certainty.LIKELY,
    ("ros", "graph", "qos", "connectivity"),
    "The two are connected and nothing warns: whether the message arrives depends on which of them starts first.",
    url="https://docs.ros.org/en/rolling/Concepts/Intermediate/About-Quality-of-Service-Settings.html",
)
_SELDOM = frozenset({"map_server"})
"""Executables outside of the workspace that publish when they are activated or asked."""


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each subscription of ROS 2 that takes no message from before it was there."""
    if configuration.generation != "ros2":
        return
    open_nodes = {one.node for one in configuration.unresolved if one.node}
    for (kind, name), of_name in by_name(ends(configuration)).items():
        publishers = [one for one in of_name if one.role is Role.PUBLISHER]
        if kind != "topic" or not publishers or not all(_is_kept(one, open_nodes) for one in publishers):
            continue
        for one in of_name:
            if one.role is Role.SUBSCRIPTION and _durability(one) == "volatile" and one.one.proof.origin is Origin.CODE:
                feeding = [other for other in publishers if not exclude_each_other(other.clauses, one.clauses)]
                if feeding:
                    yield _told(name, one, feeding[0])


def _is_kept(end: End, open_nodes: set[str]) -> bool:
    """Return whether a publisher keeps its last message, and sends the next one who knows when."""
    node = end.node
    if _durability(end) != "transient_local":
        return False
    if end.one.proof.origin is not Origin.CODE:
        return node.executable in _SELDOM
    repeats = bool(node.timers) or any(
        one.endpoint.role is Role.SUBSCRIPTION and not one.implicit for one in node.endpoints
    )
    return not (repeats or is_unknown(node) or node.name in open_nodes)


def _durability(end: End) -> str:
    qos = end.one.endpoint.qos
    return qos.durability if qos is not None and not end.one.qos_unknown else ""


def _told(name: str, subscription: End, publisher: End) -> Finding:
    proofs = (publisher.one.proof, subscription.one.proof)
    certainty, doubt = weighed(RULE.certainty, proofs, conditions_of(publisher, subscription))
    message = (
        f"{subscription.label} requests volatile on {name}, {publisher.label} offers transient_local and publishes "
        "seldom: what was published before the subscription was there does not arrive. Request transient_local at the "
        "subscription."
    )
    return occurrence(
        RULE,
        message,
        subscription.where,
        entity=subscription.entity,
        certainty=certainty,
        context=f"{subscription.node.name} {publisher.node.name}",
        doubt=doubt,
    )

"""What is there: the graph of a running system or of a recording as one side of a comparison."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import msgspec

from roslens.compare.conformance.claim import NODE, PARAMETER, TOPIC, Claim, surest
from roslens.compare.conformance.policies import policies
from roslens.compare.conformance.side import EVERYTHING, Side, SideKind
from roslens.compare.conformance.topics import topics_of
from roslens.model.graph import Endpoint, Graph, Role

_CLIENT = Role.SERVICE_CLIENT.value


def running_side(graph: Graph, title: str, *, parameters: bool = True) -> Side:
    """Return the graph of a running system as a side.

    A ROS 1 master knows nobody who calls a service. A node of ROS 2 that tells no parameters is one that nobody spins.

    Args:
        graph: of the system.
        title: how it is called.
        parameters: whether the graph has parameters at all.
    """
    knows = EVERYTHING if parameters and graph.parameters else EVERYTHING - {PARAMETER}
    if "ros1" in graph.generation:
        knows -= {_CLIENT}
    reported = graph.parameters
    silent = (
        frozenset(one.name for one in graph.nodes if one.name not in reported) if graph.generation != "ros1" else ()
    )
    return Side(
        SideKind.RUNNING, title, observed_claims(graph), frozenset(knows), generation=graph.generation,
        silent=frozenset(silent), graph=graph,
    )  # fmt: skip


def recorded_side(graph: Graph, title: str) -> Side:
    """Return the graph of a recording as a side: topics, and in ROS 1 who published on them.

    What it does not hold may only not have been recorded, unless the graph itself was: that has who takes what, too.
    """
    if any(one.role is not Role.PUBLISHER for one in graph.endpoints):
        whole = running_side(graph, title)
        return msgspec.structs.replace(whole, kind=SideKind.RECORDING)
    named = any(one.node for one in graph.endpoints)
    claims = observed_claims(graph, actions=False)
    knows = frozenset({TOPIC, NODE, Role.PUBLISHER.value} if named else {TOPIC})
    return Side(
        SideKind.RECORDING, title, tuple(one for one in claims if one.kind in knows), knows, whole=False,
        generation=graph.generation, graph=graph,
    )  # fmt: skip


def observed_claims(graph: Graph, *, actions: bool = True) -> tuple[Claim, ...]:
    """Return what a graph shows; with ``actions`` the five topics of an action of ROS 1 are one."""
    ros1 = graph.generation == "ros1"
    found = [Claim(NODE, node.name, lifecycle=node.lifecycle) for node in graph.nodes]
    found += map(_endpoint, actions_joined(graph.endpoints) if ros1 and actions else graph.endpoints)
    found += _of_server(graph.parameters) if ros1 else _of_nodes(graph.parameters)
    claims = surest(found)
    return surest((*claims, *topics_of(claims)))


def _endpoint(end: Endpoint) -> Claim:
    values = {"type": end.type} if end.type else {}
    if end.qos is not None:
        values |= policies(end.qos)
    return Claim(end.role.value, end.node, end.name, values)


def _of_server(parameters: Mapping[str, Mapping[str, str]]) -> Iterator[Claim]:
    """Yield parameters of ROS 1, which are of the parameter server."""
    for node, values in parameters.items():
        for name, value in values.items():
            yield Claim(PARAMETER, "", f"{node}/{name}" if node else name, {"value": value})


def _of_nodes(parameters: Mapping[str, Mapping[str, str]]) -> Iterator[Claim]:
    """Yield parameters of ROS 2, which are of a node each."""
    for node, values in parameters.items():
        for name, value in values.items():
            yield Claim(PARAMETER, node, name, {"value": value})


_TO_SERVER, _TO_CLIENT = ("goal", "cancel"), ("status", "result", "feedback")


def actions_joined(endpoints: Iterable[Endpoint]) -> tuple[Endpoint, ...]:
    """Return endpoints with an action of ROS 1 in place of its five topics, see wiki.ros.org/actionlib."""
    there = {(end.node, end.role, end.name): end for end in endpoints}
    kept = dict(there)
    for end in there.values():
        name, _, last = end.name.rpartition("/")
        if last != "goal" or not end.type.endswith("ActionGoal"):
            continue
        server = end.role is Role.SUBSCRIPTION
        mine, theirs = (Role.SUBSCRIPTION, Role.PUBLISHER) if server else (Role.PUBLISHER, Role.SUBSCRIPTION)
        keys = [(end.node, mine, f"{name}/{part}") for part in _TO_SERVER]
        keys += [(end.node, theirs, f"{name}/{part}") for part in _TO_CLIENT]
        if not all(key in there for key in keys):
            continue
        for key in keys:
            kept.pop(key, None)
        role = Role.ACTION_SERVER if server else Role.ACTION_CLIENT
        kept[end.node, role, name] = Endpoint(end.node, role, name, end.type.removesuffix("Goal"))
    return tuple(kept.values())

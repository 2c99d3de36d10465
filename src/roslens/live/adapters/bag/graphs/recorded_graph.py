"""The graph as far as a recording knows it: topics with types, and in ROS 1 the nodes that published."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from roslens.live.adapters.bag.channel import Channel
from roslens.live.adapters.bag.graphs.graph_messages import TYPES
from roslens.live.adapters.bag.graphs.recorded_qos import profiles_of
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.qos import Qos


def graph_of(generation: str, channels: Iterable[Channel]) -> Graph:
    """Return nodes and publishers; in ROS 2, their node is empty if the publisher is unknown."""
    endpoints = {}
    nodes = set()
    for channel in channels:
        if channel.publisher:
            nodes.add(channel.publisher)
        profiles: list[Qos | None] = [*profiles_of(channel.qos)]
        for qos in profiles or [None]:
            endpoint = Endpoint(channel.publisher, Role.PUBLISHER, channel.topic, channel.type, channel.hash, qos)
            endpoints[(endpoint.node, endpoint.name, endpoint.type, endpoint.hash, repr(qos))] = endpoint
    return Graph(
        generation,
        tuple(Node(name) for name in sorted(nodes)),
        tuple(endpoints[key] for key in sorted(endpoints)),
    )


def with_recorded(recorded: Graph, channels: Graph) -> Graph:
    """Return a recorded graph with what was recorded on topics that it does not have published by anybody.

    The topic of the graph itself is its monitor's, and no part of the robot.
    """
    published = {end.name for end in recorded.endpoints if end.role is Role.PUBLISHER}
    more = tuple(end for end in channels.endpoints if end.name not in published and end.type not in TYPES)
    return msgspec.structs.replace(recorded, endpoints=recorded.endpoints + more)

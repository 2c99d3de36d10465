"""Who uses an interface that became another type: nodes of a workspace, and recordings."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode
from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.interfaces.interface_change import InterfaceUser

_VERBS = {
    Role.PUBLISHER: "publishes",
    Role.SUBSCRIPTION: "subscribes to",
    Role.SERVICE_SERVER: "serves",
    Role.SERVICE_CLIENT: "calls",
    Role.ACTION_SERVER: "serves the action",
    Role.ACTION_CLIENT: "calls the action",
}
_KINDS = {
    Role.PUBLISHER: "msg",
    Role.SUBSCRIPTION: "msg",
    Role.SERVICE_SERVER: "srv",
    Role.SERVICE_CLIENT: "srv",
    Role.ACTION_SERVER: "action",
    Role.ACTION_CLIENT: "action",
}


def full_type(endpoint: Endpoint) -> str:
    """Return ``package/kind/Name`` of the type of an endpoint, also where ROS 1 leaves the kind out."""
    package, slash, name = endpoint.type.partition("/")
    if not slash or "/" in name:
        return endpoint.type
    return f"{package}/{_KINDS[endpoint.role]}/{name}"


def using_nodes(configurations: Iterable[Configuration], interfaces: Collection[str]) -> tuple[InterfaceUser, ...]:
    """Return the nodes that publish, subscribe, serve or call with one of these interfaces, each use once."""
    found = {
        _user(node, one)
        for configuration in configurations
        for node in configuration.nodes
        for one in node.endpoints
        if full_type(one.endpoint) in interfaces
    }
    return tuple(sorted(found))


def _user(node: ConfiguredNode, one: ConfiguredEndpoint) -> InterfaceUser:
    end = one.endpoint
    return InterfaceUser("node", node.name, f"{_VERBS[end.role]} {end.name}", full_type(end), one.proof.place)


def recorded_uses(name: str, graph: Graph, checksums: Mapping[str, tuple[str, str]]) -> Iterator[InterfaceUser]:
    """Yield the topics of a recording whose type is another one now.

    Args:
        name: of the recording.
        graph: what it holds.
        checksums: of interfaces that are other types on the wire: before and after, by full name.
    """
    seen: set[tuple[str, str]] = set()
    for end in graph.endpoints:
        kind = full_type(end)
        if kind not in checksums or (end.name, kind) in seen:
            continue
        seen.add((end.name, kind))
        now = checksums[kind][1]
        if not end.hash or end.hash != now:
            known = " (which type it recorded is unknown)" if not end.hash else ""
            yield InterfaceUser("recording", name, f"holds {end.name}{known}", kind)

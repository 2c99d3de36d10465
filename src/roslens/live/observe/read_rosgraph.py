"""Reads a graph that was written as a rosgraph_msgs/msg/Graph in YAML: who publishes, takes and offers what."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from roslens.judge.documents.document import Section, read_document
from roslens.model.graph import Endpoint, Graph, Node, Role

_NODES = {"nodes": "the nodes"}
_ENDS = {
    "publishers": Role.PUBLISHER,
    "subscriptions": Role.SUBSCRIPTION,
    "service_clients": Role.SERVICE_CLIENT,
    "service_servers": Role.SERVICE_SERVER,
    "action_clients": Role.ACTION_CLIENT,
    "action_servers": Role.ACTION_SERVER,
}
_NODE = {"name": "of the node", "parameters": "of it", "parameter_values": "of these", **dict.fromkeys(_ENDS, "of it")}
_END = {
    "name": "of the topic, service or action",
    "type": "of messages",
    "qos": "of the endpoint",
    "request_type": "of requests or goals",
    "response_type": "of responses or results",
    "feedback_type": "of feedback",
}
_TYPE = {"name": "of the type", "hash": "of the type"}


def read_rosgraph(path: Path) -> Graph:
    """Return nodes and endpoints of a graph, without parameters and qualities of service.

    Raises:
        DocumentError: the file is no such message, with its place.
    """
    document = read_document(path, "graph", _NODES)
    sections = document.sections("nodes", "node", _NODE)
    nodes = tuple(Node(section.text("name")) for section in sections if section.text("name", ""))
    return Graph("", tuple(sorted(nodes)), tuple(end for section in sections for end in _endpoints(section)))


def _endpoints(section: Section) -> Iterator[Endpoint]:
    node = section.text("name", "")
    for field, role in _ENDS.items():
        for one in section.sections(field, "topic or service", _END):
            of_messages = role in (Role.PUBLISHER, Role.SUBSCRIPTION)
            type_ = one.section("type" if of_messages else "request_type", "type", _TYPE)
            name = type_.text("name", "") if type_ else ""
            yield Endpoint(node, role, one.text("name"), name if of_messages else name.rpartition("_")[0])

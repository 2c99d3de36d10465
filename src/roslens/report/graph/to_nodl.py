"""Nodes of a configuration as NoDL 2 documents: what each offers and needs, one YAML document a node.

NoDL (ros-tooling/nodl, nodl.schema.yaml) is about ROS 2. It has no word for what is unknown: a quality of service that
is unknown is the system's default, an endpoint whose name or type is unknown is left in a comment.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence

from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, ConfiguredParameter
from roslens.model.graph import Role
from roslens.model.qos import Qos
from roslens.report.graph.nodl_parameter import TYPES, nodl_parameter

_FIELDS = {
    Role.PUBLISHER: "publishers",
    Role.SUBSCRIPTION: "subscriptions",
    Role.SERVICE_SERVER: "service_servers",
    Role.SERVICE_CLIENT: "service_clients",
    Role.ACTION_SERVER: "action_servers",
    Role.ACTION_CLIENT: "action_clients",
}
_NAME = re.compile(r"(?:[A-Za-z]|[/~A-Za-z][A-Za-z0-9_/]*[A-Za-z0-9_])\Z")
_TYPE = re.compile(r"[A-Za-z]\w*(?:/(?:msg|srv|action))?/[A-Z][A-Za-z0-9]*\Z")


def to_nodl(configuration: Configuration) -> str:
    """Return the nodes of a configuration as YAML documents, each begun by ``---`` and a comment that names it."""
    return "".join(f"{line}\n" for node in configuration.nodes for line in _node(node))


def _node(node: ConfiguredNode) -> Iterator[str]:
    yield "---"
    yield f"# {_comment(node.name)} ({_comment(node.package)}/{_comment(node.executable)})"
    yield "nodl_version: 2"
    yield from _parameters(node.parameters)
    for role, field in _FIELDS.items():
        ends = {(one.endpoint.name, one.endpoint.type): one for one in node.endpoints if one.endpoint.role is role}
        yield from _endpoints(field, [one for _, one in sorted(ends.items())])


def _parameters(parameters: Sequence[ConfiguredParameter]) -> Iterator[str]:
    known = [one for one in parameters if one.access and not _unknown(one)]
    if known:
        yield "parameters:"
        for one in known:
            yield from nodl_parameter(one)
    for one in parameters:
        if one.access and (why := _unknown(one)):
            yield f"# parameter {_comment(one.name)}: {why}"


def _endpoints(field: str, ends: Sequence[ConfiguredEndpoint]) -> Iterator[str]:
    valid = [one for one in ends if _valid(one)]
    if valid:
        yield f"{field}:"
        for end in valid:
            yield from _end(end)
    for end in ends:
        if not _valid(end):
            words = f"{end.endpoint.name} {end.endpoint.type or 'of unknown type'} ({end.given})"
            yield f"# {field}: {_comment(words)}: unresolved"


def _unknown(one: ConfiguredParameter) -> str:
    """Return what of a parameter NoDL has no word for; nothing where it has one for all."""
    if "*" in one.name:
        return "a part of its name is unknown"
    if one.dynamic:
        return "it may be of any type"
    return "" if one.type in TYPES else "its type is unknown"


def _valid(one: ConfiguredEndpoint) -> bool:
    return one.resolved and bool(_NAME.match(one.endpoint.name)) and bool(_TYPE.match(one.endpoint.type))


def _end(one: ConfiguredEndpoint) -> Iterator[str]:
    yield f"  - name: {json.dumps(one.endpoint.name)}"
    yield f"    type: {one.endpoint.type}"
    if one.endpoint.role in (Role.PUBLISHER, Role.SUBSCRIPTION):
        yield "    qos:"
        yield from (f"      {key}: {value}" for key, value in _qos(one.endpoint.qos or Qos()).items())
    if one.conditions:
        yield f"    description: {json.dumps('if ' + ' and '.join(one.conditions))}"


def _qos(qos: Qos) -> dict[str, str | int]:
    history = qos.history.upper() or "SYSTEM_DEFAULT"
    # Without its depth a history of the last messages is no valid one.
    if history == "KEEP_LAST" and not qos.depth:
        history = "SYSTEM_DEFAULT"
    found: dict[str, str | int] = {"history": history}
    if history == "KEEP_LAST":
        found["depth"] = qos.depth
    found["reliability"] = qos.reliability.upper() or "SYSTEM_DEFAULT"
    for key, text in (("durability", qos.durability), ("liveliness", qos.liveliness)):
        if text:
            found[key] = text.upper()
    times = {"deadline_ns": qos.deadline_s, "lifespan_ns": qos.lifespan_s, "liveliness_lease_duration_ns": qos.lease_s}
    found.update({key: round(seconds * 1e9) for key, seconds in times.items() if seconds})
    return found


def _comment(text: str) -> str:
    return " ".join(text.split())

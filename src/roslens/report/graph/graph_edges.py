"""Nodes and what joins them, for formats that draw: topics, services and actions as things of their own."""

from __future__ import annotations

import msgspec

from roslens.model.configuration import Configuration, ConfiguredEndpoint
from roslens.model.graph import Role
from roslens.model.graphs.end import KIND

_OUT = frozenset({Role.PUBLISHER, Role.SERVICE_CLIENT, Role.ACTION_CLIENT})


class Drawn(msgspec.Struct, frozen=True, order=True):
    """A node or a thing; ``kind`` is ``node``, ``topic``, ``service`` or ``action``."""

    kind: str
    name: str
    resolved: bool = True
    conditional: bool = False


class Line(msgspec.Struct, frozen=True, order=True):
    """A line from a node to a thing (``out``: it publishes or calls), or the other way."""

    node: str
    kind: str
    thing: str
    out: bool
    resolved: bool = True
    conditional: bool = False
    likely: bool = False


def things_of(configuration: Configuration) -> tuple[tuple[Drawn, ...], tuple[Line, ...]]:
    """Return what is drawn and the lines, each sorted; several endpoints of a node and thing are one line."""
    drawn = {Drawn("node", node.name, node.resolved, bool(node.conditions)) for node in configuration.nodes}
    lines: dict[tuple[str, str, str, bool], Line] = {}
    for node in configuration.nodes:
        for one in node.endpoints:
            line = _line(node.name, one)
            key = (line.node, line.kind, line.thing, line.out)
            known = lines.get(key)
            lines[key] = line if known is None else _surer(known, line)
            drawn.add(Drawn(line.kind, line.thing, one.resolved))
    return tuple(sorted(drawn)), tuple(sorted(lines.values()))


def _line(node: str, one: ConfiguredEndpoint) -> Line:
    role = one.endpoint.role
    likely = one.proof.sure != "certain"
    # Names that are not known in full may be any; two nodes are not joined by both being unknown.
    thing = one.endpoint.name if one.resolved else f"{one.endpoint.name} of {node}"
    return Line(node, KIND[role], thing, role in _OUT, one.resolved, bool(one.conditions), likely)


def _surer(first: Line, second: Line) -> Line:
    return msgspec.structs.replace(
        first,
        resolved=first.resolved or second.resolved,
        conditional=first.conditional and second.conditional,
        likely=first.likely and second.likely,
    )


def namespace_of(name: str) -> str:
    """Return the namespace of a name, ``/`` at the top."""
    return name.rpartition("/")[0] or "/"

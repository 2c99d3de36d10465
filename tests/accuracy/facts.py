"""What a graph says, one sentence at a time: the same form for what source says and for what a running system shows."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec

from roslens.compare.conformance.observed import actions_joined
from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, ConfiguredParameter
from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.qos import Qos

NODE, PARAMETER = "node", "parameter"
KINDS = (NODE, *(role.value for role in Role), PARAMETER)
UNLISTED = frozenset({"start_type_description_service", "use_sim_time"})
"""Parameters that every node of ROS 2 has; a graph from source lists what somebody declares or sets."""
OUTSIDE = ""
"""The node of a parameter that belongs to none."""


class Fact(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """One thing that is there.

    Attributes:
        kind: one of ``KINDS``.
        node: resolved name.
        name: of the topic, service, action or parameter; empty of a node.
        values: what else is known of it: ``type``, ``hash``, policies of the quality of service, ``value``.
        implicit: whether every node of its kind has it.
        sure: of what source says: ``certain``, ``likely`` or ``possible``.
        resolved: whether all of the name is known; ``*`` stands for what is not.
        conditions: what must hold, as source says.
        place: in source.
        given: the name as the code gives it.
    """

    kind: str
    node: str
    name: str = ""
    values: dict[str, str] = {}
    implicit: bool = False
    sure: str = "certain"
    resolved: bool = True
    conditions: tuple[str, ...] = ()
    place: str = ""
    given: str = ""

    @property
    def key(self) -> tuple[str, str, str]:
        """Return by what it is compared."""
        return self.kind, self.node, self.name

    def __str__(self) -> str:
        """Return it in words."""
        return f"{self.kind.replace('_', ' ')} {self.name or self.node}{f' of {self.node}' if self.name else ''}"


def seen(graph: Graph) -> tuple[Fact, ...]:
    """Return what a running system shows."""
    found = [Fact(NODE, node.name) for node in graph.nodes]
    ends = actions_joined(graph.endpoints) if graph.generation == "ros1" else graph.endpoints
    for end in ends:
        if not _part_of_action(end):
            found.append(Fact(end.role.value, end.node, end.name, _values(end)))
    for node, values in graph.parameters.items():
        for name, value in values.items():
            known = {"value": value}
            if name in UNLISTED:
                continue
            if graph.generation == "ros1":
                found.append(Fact(PARAMETER, OUTSIDE, f"{node}/{name}" if node else name, known))
            else:
                found.append(Fact(PARAMETER, node, name, known))
    return tuple(sorted(set_of(found), key=lambda one: one.key))


def said(configuration: Configuration) -> tuple[Fact, ...]:
    """Return what source says of the same.

    In ROS 1 a parameter is one of the parameter server: what is only read is not there. In ROS 2 it is one of a node:
    what is only set, and never declared, is not there.
    """
    names = {node.name for node in configuration.nodes}
    nodes = [_ended(node) for node in configuration.nodes]
    ros1 = configuration.generation == "ros1"
    found: list[Fact] = []
    for node in nodes:
        inside = node.container if node.kind == "nodelet" and node.container in names else ""
        if not inside or any(one.implicit for one in node.endpoints):
            found.append(_node(node))
        found += (_endpoint(one, node.name if one.implicit else inside or node.name, node) for one in node.endpoints)
        found += _parameters(node.parameters, node, ros1=ros1)
    if ros1:
        found += _parameters(configuration.parameters, None, ros1=True)
    return tuple(sorted(set_of(found), key=lambda one: (one.key, one.place)))


def set_of(facts: Iterable[Fact]) -> list[Fact]:
    """Return each fact once; of several with one key that which source is surest of."""
    best: dict[tuple[str, str, str], Fact] = {}
    for one in facts:
        other = best.get(one.key)
        if other is None or _doubt(one) < _doubt(other):
            best[one.key] = one
    return list(best.values())


def _doubt(one: Fact) -> tuple[bool, bool, bool]:
    return bool(one.conditions), one.sure != "certain", not one.values


def _ended(node: ConfiguredNode) -> ConfiguredNode:
    """Return a node whose name only lacks its random end as one whose name is known."""
    known = node.anonymous and node.name.count("*") == 1 and node.name.endswith("_*")
    if not known:
        return node
    ends = []
    for one in node.endpoints:
        name = one.endpoint.name
        ends.append(msgspec.structs.replace(one, resolved=name.count("*") <= name.startswith(node.name)))
    return msgspec.structs.replace(node, resolved=True, endpoints=tuple(ends))


def _node(node: ConfiguredNode) -> Fact:
    return Fact(
        NODE, node.name, sure=node.proof.sure, resolved=node.resolved, conditions=node.conditions,
        place=node.proof.place,
    )  # fmt: skip


def _endpoint(one: ConfiguredEndpoint, node: str, of: ConfiguredNode) -> Fact:
    end = one.endpoint
    sure = one.proof.sure if one.resolved and of.resolved else "possible"
    return Fact(
        end.role.value, node, end.name, _values(end, "" if one.implicit else one.qos_unknown), one.implicit,
        sure, one.resolved and of.resolved, (*of.conditions, *one.conditions), one.proof.place, one.given,
    )  # fmt: skip


def _parameters(parameters: Iterable[ConfiguredParameter], of: ConfiguredNode | None, *, ros1: bool) -> Iterator[Fact]:
    for one in parameters:
        if one.name in UNLISTED:
            continue
        there = one.set_by is not None or one.written_by is not None if ros1 else one.access == "declared"
        if not there:
            continue
        proof = one.written_by or one.set_by or one.proof
        known = {} if one.value is None else {"value": one.value}
        sure = proof.sure if proof else "likely"
        if one.set_by is None and one.default is not None:
            sure = "certain" if sure == "likely" and not ros1 else sure
        conditions = (*(of.conditions if of else ()), *(one.conditions if not one.set_by or not ros1 else ()))
        node = OUTSIDE if ros1 or of is None else of.name
        yield Fact(
            PARAMETER, node, one.name, known, False, sure, "*" not in one.name and (of is None or of.resolved),
            conditions, proof.place if proof else "",
        )  # fmt: skip


def _values(end: Endpoint, unknown: str = "") -> dict[str, str]:
    found = {"type": end.type if "*" not in end.type else "", "hash": end.hash}
    if end.qos is not None:
        found |= _policies(end.qos, certain=not unknown)
    return {name: value for name, value in found.items() if value}


def _policies(qos: Qos, *, certain: bool) -> dict[str, str]:
    """Return those policies that endpoints tell each other; depth and history stay with who has them."""
    # A policy that nobody sets is as every profile of ROS 2 has it.
    lively = qos.liveliness or ("automatic" if certain else "")
    found = {"reliability": qos.reliability, "durability": qos.durability, "liveliness": lively}
    for name, value in (("deadline", qos.deadline_s), ("lifespan", qos.lifespan_s), ("lease", qos.lease_s)):
        if value or certain:
            found[name] = f"{value:g}" if value else "none"
    return found


def _part_of_action(end: Endpoint) -> bool:
    return "/_action/" in end.name

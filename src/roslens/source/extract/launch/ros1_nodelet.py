"""Nodelets of ROS 1: what a ``nodelet`` program is asked to load, and into which manager.

The program that asks a manager is a node of the nodelet's name, as long as it runs. It and the manager tell each other
that they live, on a topic ``bond`` of the manager, unless a parameter forbids it (nodelet_core, nodelet.cpp and
loader.cpp).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import msgspec

from roslens.model.configuration import ConfiguredEndpoint, ConfiguredNode, Origin, Proof
from roslens.model.graph import Endpoint, Role
from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.symbolic.condition import as_written, clauses_of
from roslens.source.extract.symbolic.text import Conditions, Text

_PROGRAM = ("nodelet", "nodelet")
_NO_BOND = "--no-bond"
_ASSIGNS = ":="
_BOND = "bond/Status"


def as_nodelet(launched: Launched) -> Launched:
    """Return a node as the nodelet or manager that its arguments make it (wiki.ros.org/nodelet); others unchanged."""
    if (launched.package.known, launched.executable.known) != _PROGRAM or not launched.arguments:
        return launched
    command, *rest = _for_itself(launched.arguments) or [Text()]
    if command.known == "manager":
        return msgspec.structs.replace(launched, kind="container")
    if command.known == "standalone" and rest:
        return msgspec.structs.replace(launched, kind="nodelet", plugin=rest[0])
    if command.known == "load" and len(rest) > 1:
        return msgspec.structs.replace(launched, kind="nodelet", plugin=rest[0], container=rest[1])
    return launched


def is_process(launched: Launched) -> bool:
    """Return whether something is started by the ``nodelet`` program, and so is a process."""
    return (launched.package.known, launched.executable.known) == _PROGRAM


def has_bond(launched: Launched) -> bool:
    """Return whether the loader of a nodelet has a bond with its manager; False where that is unknown."""
    if not is_process(launched) or not launched.container.parts:
        return False
    after = _for_itself(launched.arguments)[3:4]
    return not after or after[0].known not in (None, _NO_BOND)


def _for_itself(words: Sequence[Text]) -> list[Text]:
    """Return words without empty ones and those that are for ROS."""
    return [one for one in words if one.parts and _ASSIGNS not in one.pattern]


class Bond(msgspec.Struct, frozen=True, order=True):
    """A bond: resolved names of who loads and of the manager, and under which conditions it is there."""

    loader: str
    manager: str
    conditions: Conditions = ()


def with_bonds(nodes: Iterable[ConfiguredNode], bonds: Iterable[Bond]) -> list[ConfiguredNode]:
    """Return nodes with what bonds make of them: each end tells, and listens."""
    ends: dict[str, dict[str, Conditions]] = {}
    for one in sorted(bonds, key=lambda bond: (len(bond.conditions), bond)):
        ends.setdefault(one.loader, {})[f"{one.manager}/bond"] = ()
        ends.setdefault(one.manager, {}).setdefault(f"{one.manager}/bond", one.conditions)
    return [_bound(node, ends.get(node.name, {})) for node in nodes]


def _bound(node: ConfiguredNode, ends: Mapping[str, Conditions]) -> ConfiguredNode:
    if not ends or node.kind not in ("nodelet", "container"):
        return node
    proof = Proof(how="the loader of a nodelet has a bond with its manager", origin=Origin.IMPLICIT)
    made = [
        ConfiguredEndpoint(
            Endpoint(node.name, role, name, _BOND),
            proof,
            name,
            "*" not in name,
            as_written(conditions),
            clauses=clauses_of(conditions),
        )
        for name, conditions in ends.items()
        for role in (Role.PUBLISHER, Role.SUBSCRIPTION)
    ]
    order = sorted((*node.endpoints, *made), key=lambda one: (one.endpoint.role.value, one.endpoint.name))
    return msgspec.structs.replace(node, endpoints=tuple(order))

"""What was not understood of the builds and the code of packages, in short: what is the same is reported once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

import msgspec

if TYPE_CHECKING:
    from roslens.model.configuration import Configuration, ConfiguredNode
    from roslens.source.extract.facts.launched import Unresolved


def reported_once(missed: Iterable[Unresolved]) -> tuple[Unresolved, ...]:
    """Return what was not understood of builds: each text and reason once, at the first place where it is so."""
    places: dict[tuple[str, str], list[Unresolved]] = {}
    for one in missed:
        places.setdefault((one.text, one.reason), []).append(one)
    found = []
    for group in places.values():
        first = min(group, key=lambda one: one.evidence)
        more = len({(one.evidence.path, one.evidence.line) for one in group}) - 1
        reason = f"{first.reason}; and in {more} more place{'s' * (more > 1)}" if more else first.reason
        found.append(msgspec.structs.replace(first, reason=reason))
    return tuple(found)


def reported_by_file(missed: Iterable[Unresolved]) -> tuple[Unresolved, ...]:
    """Return what was not understood of code: each reason once for a file, at the first place where it is so."""
    places: dict[tuple[str, str], list[Unresolved]] = {}
    for one in missed:
        places.setdefault((one.evidence.path, one.reason), []).append(one)
    found = []
    for group in places.values():
        first = min(group, key=lambda one: one.evidence)
        more = len(group) - 1
        reason = f"{first.reason}; and {more} more in this file" if more else first.reason
        found.append(msgspec.structs.replace(first, reason=reason))
    return tuple(found)


def with_roles(configuration: Configuration, roles: Mapping[str, str]) -> Configuration:
    """Return a configuration whose unresolved parts have the role of their code; ``roles`` are those of files."""
    missed = (msgspec.structs.replace(one, role=roles.get(one.proof.path, "")) for one in configuration.unresolved)
    nodes = tuple(_with_role(one, roles) for one in configuration.nodes)
    return msgspec.structs.replace(configuration, nodes=nodes, unresolved=tuple(missed))


def _with_role(node: ConfiguredNode, roles: Mapping[str, str]) -> ConfiguredNode:
    role = roles.get(node.defined.path, "") if node.defined is not None else ""
    return msgspec.structs.replace(node, role=role) if role else node

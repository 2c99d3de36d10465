"""Who is affected by changed interfaces: nodes of the workspace, recordings and references that the user names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.model.configuration import Configuration
    from roslens.model.interfaces.interface_change import InterfaceDifference, InterfaceUser


def with_users(
    found: InterfaceDifference,
    configurations: Iterable[Configuration],
    recordings: Sequence[str] = (),
    references: Sequence[str] = (),
) -> InterfaceDifference:
    """Return a difference with who is affected by it.

    Raises:
        UsageError: a recording is none.
        DocumentError: a reference is none.
    """
    from roslens.compare.interface_users import using_nodes

    configurations = tuple(configurations)
    users = list(using_nodes(configurations, found.on_wire))
    for path in recordings:
        users += _recorded(path, found)
    for path in references:
        users += _expected(path, found, configurations)
    return msgspec.structs.replace(found, users=tuple(users))


def _recorded(path: str, found: InterfaceDifference) -> Iterator[InterfaceUser]:
    from roslens.compare.interface_users import recorded_uses
    from roslens.live.adapters.bag.open_bag import open_bag

    if not Path(path).exists():
        raise UsageError(f'no recording "{path}"', expected="a .mcap, .db3 or .bag file, or a folder with them")
    yield from recorded_uses(path, open_bag(Path(path)).graph(), found.checksums)


def _expected(
    path: str, found: InterfaceDifference, configurations: Sequence[Configuration]
) -> Iterator[InterfaceUser]:
    """Yield the checks of a reference on fields that are gone, by the types of the topics that they match."""
    from roslens.compare.interface_users import full_type
    from roslens.judge.patterns.pattern import Pattern
    from roslens.judge.reading.read_reference import load_reference
    from roslens.live.window.signals import BY_KEY
    from roslens.model.interfaces.interface_change import InterfaceUser

    gone = {one.interface: one.gone for one in found.changes if one.gone}
    topics = {
        (one.endpoint.name, full_type(one.endpoint))
        for configuration in configurations
        for node in configuration.nodes
        for one in node.endpoints
        if full_type(one.endpoint) in gone
    }
    for check in load_reference([Path(path)], BY_KEY).field_checks:
        pattern = Pattern.parse(check.topic)
        for topic, kind in sorted(topics):
            first = check.field.partition(".")[0].partition("[")[0]
            if pattern.matches(topic) and first in gone[kind]:
                yield InterfaceUser("reference", path, f"checks {check.field} of {topic}", kind)

"""Nodelets of ROS 1: what a ``nodelet`` program is told to load, and into which manager."""

from __future__ import annotations

import msgspec

from roslens.source.extract.launched import Launched

_PROGRAM = ("nodelet", "nodelet")


def as_nodelet(launched: Launched) -> Launched:
    """Return a node as the nodelet or manager that its arguments make it (wiki.ros.org/nodelet); others unchanged."""
    if (launched.package.known, launched.executable.known) != _PROGRAM or not launched.arguments:
        return launched
    command, *rest = launched.arguments
    if command.known == "manager":
        return msgspec.structs.replace(launched, kind="container")
    if command.known == "standalone" and rest:
        return msgspec.structs.replace(launched, kind="nodelet", plugin=rest[0])
    if command.known == "load" and len(rest) > 1:
        return msgspec.structs.replace(launched, kind="nodelet", plugin=rest[0], container=rest[1])
    return launched

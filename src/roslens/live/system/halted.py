"""Nodes whose process is stopped or hangs, as the operating system has it."""

from __future__ import annotations

import msgspec

from roslens.model.entity import EntityId


class Halted(msgspec.Struct, frozen=True, order=True):
    """A node whose process is stopped, or waits for the kernel and cannot be interrupted; seconds.

    Attributes:
        entity: the node.
        hung: whether it hangs, else it is stopped.
        since: on the monitor's clock.
    """

    entity: EntityId
    hung: bool
    since: float

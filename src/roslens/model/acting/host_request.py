"""What a host is asked to do: one action on one of its processes, or one of its commands."""

from __future__ import annotations

from typing import Any

import msgspec


class HostRequest(msgspec.Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    """One action.

    Attributes:
        id: of the decision, by which the answer is known.
        kind: key of the action.
        node: name of the node that it is done to, empty where it is done to the host.
        pid: process that the node lives in, or lived in last; 0 where that is not known.
        beside: other nodes that live in the same process.
        arguments: of the action, defaults filled in.
    """

    id: str
    kind: str
    node: str
    pid: int
    beside: tuple[str, ...] = ()
    arguments: dict[str, Any] = {}

"""A claim of one side that something exists, in one form for source, a running system and a recording."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

NODE, PARAMETER, TOPIC = "node", "parameter", "topic"
Key = tuple[str, str, str]


class Claim(msgspec.Struct, frozen=True, omit_defaults=True):
    """One thing that is there.

    Attributes:
        kind: ``node``, a role of an endpoint, ``parameter`` or ``topic``.
        node: resolved name; empty of a topic, and of a parameter that belongs to no node.
        name: of the topic, service, action or parameter; empty of a node.
        values: what else is known of it: ``type``, policies of the quality of service, ``value``.
        sure: of what source says: ``certain``, ``likely`` or ``possible``.
        resolved: whether all of the name is known; ``*`` stands for what is not.
        implicit: whether every node of its kind has it.
        conditions: what must hold for it to be there.
        place: where it is said, as ``path:line``.
        given: the name as the code gives it.
        remapped: where a remapping changed its name; empty where none did.
        lifecycle: state of a managed node.
        ignored: whether it is a parameter that is set and that no code declares.
        uncertain: why a value is not sure, in words; empty where it is.
    """

    kind: str
    node: str = ""
    name: str = ""
    values: dict[str, str] = {}
    sure: str = "certain"
    resolved: bool = True
    implicit: bool = False
    conditions: tuple[str, ...] = ()
    place: str = ""
    given: str = ""
    remapped: str = ""
    lifecycle: str = ""
    ignored: bool = False
    uncertain: str = ""

    @property
    def key(self) -> Key:
        """Return by what sides are joined."""
        return self.kind, self.node, self.name

    @property
    def doubt(self) -> tuple[bool, bool, int]:
        """Return by what of several claims with one key the surest is chosen: the least."""
        return bool(self.conditions), self.sure != "certain", -len(self.values)


def surest(claims: Iterable[Claim]) -> tuple[Claim, ...]:
    """Return each claim once, of several with one key the surest, sorted by key."""
    best: dict[Key, Claim] = {}
    for one in claims:
        other = best.get(one.key)
        if other is None or one.doubt < other.doubt:
            best[one.key] = one
    return tuple(best[key] for key in sorted(best))

"""How the messages, services and actions of two states of a workspace differ, and what breaks by that."""

from __future__ import annotations

from enum import Enum

import msgspec


class Breaks(str, Enum):
    """What no longer fits after a change.

    - wire: programs built before do not understand those built after; recordings cannot be read as the new type
    - source: code that names what is gone does not build, or fails where it runs
    - meaning: it is read without an error, and means something else
    """

    WIRE = "wire"
    SOURCE = "source"
    MEANING = "meaning"


class InterfaceChange(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """A difference of one interface.

    Attributes:
        interface: its full name, as ``geometry_msgs/msg/Pose``.
        what: the difference in words.
        breaks: what does not fit any more; empty of a compatible change.
        path: of the file; that of the state before where it is gone after.
        line: in it; 0 where all of it is meant.
        gone: fields that a path into a message cannot begin with any more.
    """

    interface: str
    what: str
    breaks: tuple[Breaks, ...] = ()
    path: str = ""
    line: int = 0
    gone: tuple[str, ...] = ()


class VersionStep(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """The version of a package before and after, and the step (``major`` or ``minor``) that its changes ask for."""

    package: str
    before: str
    after: str
    step: str
    least: str
    enough: bool


class InterfaceUser(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """Who is affected by a change on the wire.

    Attributes:
        kind: ``node``, ``recording`` or ``reference``.
        name: of the node, or the file.
        how: what it does with the interface.
        interface: the full name of what it uses.
        place: where that stands; empty where it is no source.
    """

    kind: str
    name: str
    how: str
    interface: str
    place: str = ""


class InterfaceDifference(msgspec.Struct, frozen=True, omit_defaults=True):
    """All of it.

    Attributes:
        changes: sorted by interface.
        containing: interfaces that are other types on the wire because one that they contain is, by full name.
        checksums: MD5 of ROS 1 or RIHS01 of ROS 2, before and after, of what is another type on the wire.
        steps: of the packages with changes.
        users: who is affected.
        unread: files that could not be understood completely: what of them changed is not known.
    """

    changes: tuple[InterfaceChange, ...] = ()
    containing: dict[str, tuple[str, ...]] = {}
    checksums: dict[str, tuple[str, str]] = {}
    steps: tuple[VersionStep, ...] = ()
    users: tuple[InterfaceUser, ...] = ()
    unread: tuple[str, ...] = ()

    @property
    def breaking(self) -> tuple[InterfaceChange, ...]:
        """The changes that break something."""
        return tuple(one for one in self.changes if one.breaks)

    @property
    def on_wire(self) -> frozenset[str]:
        """Full names of interfaces that are other types on the wire, or are gone."""
        direct = {one.interface for one in self.changes if Breaks.WIRE in one.breaks}
        return frozenset(direct | self.containing.keys())

"""An interface: what a message, service or action consists of, of both generations of ROS."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

Value = str | int | float | bool | tuple[str | int | float | bool, ...]
"""Of a constant or a default."""


class FieldType(msgspec.Struct, frozen=True, array_like=True):
    """The type of a field.

    Attributes:
        name: of a primitive type (``float64``, ``string``, ``time``) or of a message (``Pose``).
        package: of the message; empty of a primitive type.
        array: ``""``, ``fixed``, ``bounded`` or ``unbounded``.
        size: of a fixed array, most items of a bounded one.
        longest: most characters of a bounded string; 0 is no bound.
        written: as it stands in the file.
    """

    name: str
    package: str = ""
    array: str = ""
    size: int = 0
    longest: int = 0
    written: str = ""

    @property
    def message(self) -> str:
        """Return the full name of the message (``geometry_msgs/msg/Pose``); empty of a primitive type."""
        return f"{self.package}/msg/{self.name}" if self.package else ""


class InterfaceField(msgspec.Struct, frozen=True, omit_defaults=True):
    """A field; ``default`` is None where none is given, ``column`` that of the name."""

    name: str
    type: FieldType
    default: Value | None = None
    comment: str = ""
    line: int = 0
    column: int = 0


class InterfaceConstant(msgspec.Struct, frozen=True, omit_defaults=True):
    """A constant of a primitive ``type``; ``written`` is its value as it stands in the file."""

    name: str
    type: str
    value: Value
    written: str
    comment: str = ""
    line: int = 0
    column: int = 0


class Message(msgspec.Struct, frozen=True, omit_defaults=True):
    """A message, or one part of a service or action."""

    fields: tuple[InterfaceField, ...] = ()
    constants: tuple[InterfaceConstant, ...] = ()
    comment: str = ""


class Interface(msgspec.Struct, frozen=True, omit_defaults=True):
    """An interface.

    Attributes:
        package: that it belongs to.
        name: without package.
        kind: ``msg``, ``srv`` or ``action``.
        generation: of ROS: 1 or 2.
        parts: one of a message; request and response of a service; goal, result and feedback of an action.
        complete: whether all of its file was understood.
    """

    package: str
    name: str
    kind: str
    generation: int
    parts: tuple[Message, ...]
    complete: bool = True

    @property
    def full_name(self) -> str:
        """Return ``package/kind/Name``, in both generations."""
        return f"{self.package}/{self.kind}/{self.name}"


Lookup = Callable[[str], Interface | None]
"""Finds an interface by its full name (``geometry_msgs/msg/Pose``); None where there is none."""


class Checksum(msgspec.Struct, frozen=True, omit_defaults=True):
    """What identifies a type on the wire; ``unknown`` is the reason where it could not be determined."""

    text: str = ""
    unknown: str = ""

    def __bool__(self) -> bool:
        """Return whether it is known."""
        return bool(self.text)


def unknown_field_type(owner: str, field: InterfaceField) -> Checksum:
    """Return the checksum of an interface one of whose fields is of a type that is not found."""
    return Checksum(unknown=f"{field.type.message!r}, the type of field {field.name!r} of {owner}, is unknown")

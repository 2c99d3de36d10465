"""Definitions of ROS 1 messages: their text, the MD5 sum by which two sides compare them, and how they are serialised.

The sum is that of genmsg: constants, then fields, without comments, and a message in place of its type by its own sum.
"""

from __future__ import annotations

import hashlib
import re
import struct
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec

from roslens.live import publish

HEADER = "std_msgs/Header"
_LINE = re.compile(r"([\w/]+)(\[\])?\s+(\w+)\s*(?:=\s*(.*?))?\s*$")
_NUMBERS = {
    "bool": "?", "byte": "b", "char": "B", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i",
    "uint32": "I", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d",
}  # fmt: skip
_STAMP = struct.Struct("<II")
_DIAGNOSTICS = {
    "std_msgs/Header": "uint32 seq\ntime stamp\nstring frame_id\n",
    "diagnostic_msgs/KeyValue": "string key\nstring value\n",
    "diagnostic_msgs/DiagnosticStatus": (
        "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\n"
        "byte level\nstring name\nstring message\nstring hardware_id\nKeyValue[] values\n"
    ),
    "diagnostic_msgs/DiagnosticArray": "Header header\nDiagnosticStatus[] status\n",
}
_SEPARATOR = "=" * 80

Packer = Callable[[Any], bytes]


class Field(msgspec.Struct, frozen=True):
    """A field or, with a value, a constant; ``type`` of a message is ``package/Name``."""

    type: str
    name: str
    several: bool = False
    value: str | None = None


def read_definition(name: str, text: str) -> tuple[Field, ...]:
    """Return constants and fields of the message ``package/Name``, in their order.

    Raises:
        ValueError: a line is neither; arrays of fixed length and constants that are texts are none of ours.
    """
    found = []
    for line in text.splitlines():
        stripped = line.partition("#")[0].strip()
        if not stripped:
            continue
        match = _LINE.match(stripped)
        if match is None:
            raise ValueError(f"{stripped!r} in {name}, expected `type name` or `type NAME=value`")
        type_, several, field, value = match.groups()
        found.append(Field(_resolved(type_, name), field, bool(several), value))
    return tuple(found)


def _resolved(type_: str, within: str) -> str:
    if type_ in _NUMBERS or type_ in ("string", "time") or "/" in type_:
        return type_
    return HEADER if type_ == "Header" else f"{within.partition('/')[0]}/{type_}"


class Definitions:
    """A set of definitions that is whole: each message that one of them holds is in it."""

    def __init__(self, texts: Mapping[str, str]) -> None:
        """Take texts by ``package/Name``.

        Raises:
            ValueError: one of them is no definition.
        """
        self._texts = texts
        self._fields = {name: read_definition(name, text) for name, text in texts.items()}

    def fields(self, name: str) -> tuple[Field, ...]:
        """Return the fields of a message, without its constants."""
        return tuple(field for field in self._fields[name] if field.value is None)

    def md5(self, name: str) -> str:
        """Return the sum of a message."""
        constants = [f"{one.type} {one.name}={one.value}" for one in self._fields[name] if one.value is not None]
        fields = [f"{self._shown(one)} {one.name}" for one in self.fields(name)]
        return hashlib.md5("\n".join(constants + fields).encode(), usedforsecurity=False).hexdigest()

    def _shown(self, field: Field) -> str:
        if field.type in self._fields:
            return self.md5(field.type)
        return f"{field.type}[]" if field.several else field.type

    def whole_text(self, name: str) -> str:
        """Return the text of a message and of all that it holds, as publishers send it."""
        parts = [self._texts[name]]
        parts += [f"{_SEPARATOR}\nMSG: {one}\n{self._texts[one]}" for one in self._held(name)]
        return "\n".join(parts)

    def _held(self, name: str) -> list[str]:
        found: dict[str, None] = {}
        for field in self.fields(name):
            if field.type in self._fields:
                found.update(dict.fromkeys([field.type, *self._held(field.type)]))
        return list(found)

    def packer(self, name: str) -> Packer:
        """Return what serialises a message, given as the values of its fields in their order; a time is seconds."""
        parts = [self._field_packer(field) for field in self.fields(name)]

        def pack(values: Sequence[Any]) -> bytes:
            return b"".join([part(value) for part, value in zip(parts, values, strict=True)])

        return pack

    def _field_packer(self, field: Field) -> Packer:
        one = self._type_packer(field.type)
        if not field.several:
            return one
        return lambda values: len(values).to_bytes(4, "little") + b"".join([one(value) for value in values])

    def _type_packer(self, type_: str) -> Packer:
        if type_ in _NUMBERS:
            return struct.Struct(f"<{_NUMBERS[type_]}").pack
        if type_ == "string":
            return _text
        return _time if type_ == "time" else self.packer(type_)


def _text(value: str) -> bytes:
    encoded = value.encode("utf-8", "replace")
    return len(encoded).to_bytes(4, "little") + encoded


def _time(seconds: float) -> bytes:
    return _STAMP.pack(*divmod(round(seconds * 1e9), 1_000_000_000))


def known_definitions() -> Definitions:
    """Return those of the messages that roslens publishes."""
    folder = Path(publish.__file__).with_name("msg")
    own = {f"roslens_msgs/{file.stem}": file.read_text(encoding="utf-8") for file in sorted(folder.glob("*.msg"))}
    return Definitions({**_DIAGNOSTICS, **own})

"""How messages and services of ROS 1 are serialised, of any type whose definition is found here."""

from __future__ import annotations

import os
import re
import struct
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.base import TypesysError

from roslens.intake.bounded_file import read_bounded
from roslens.live.act.ros import ActionError

_TYPE = re.compile(r"([A-Za-z][A-Za-z0-9_]*)/(?:(msg|srv)/)?([A-Za-z][A-Za-z0-9_]*)\Z")
_NUMBERS = {
    "bool": "?", "octet": "b", "byte": "b", "char": "B", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H",
    "int32": "i", "uint32": "I", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d",
}  # fmt: skip
_TIMES = {"builtin_interfaces/msg/Time": "<II", "builtin_interfaces/msg/Duration": "<ii"}
_HEADER = "std_msgs/msg/Header"
_MOST_BYTES = 1_000_000
_DEEPEST = 20
_MOST_TYPES = 2_000

_Described = tuple[Nodetype, Any]


def share_folders(environment: Mapping[str, str]) -> tuple[Path, ...]:
    """Return the folders that hold packages: those of the workspaces that are sourced, then those of the system."""
    found = [Path(one) for one in environment.get("ROS_PACKAGE_PATH", "").split(os.pathsep) if one]
    found += [Path(one) / "share" for one in environment.get("CMAKE_PREFIX_PATH", "").split(os.pathsep) if one]
    return (*found, Path("/usr/share"))


class MessageForms:
    """Serialises by definitions: those of ROS Noetic, and those of packages that are found in folders."""

    def __init__(self, folders: Sequence[Path]) -> None:
        """Look for what is not known in ``folders``, the first that has it."""
        self._folders = folders
        self._store = get_typestore(Stores.ROS1_NOETIC)

    def name(self, type_: str) -> str:
        """Return the full name of a message type that is known here.

        Raises:
            ActionError: there is none, or its definition is none.
        """
        found = _TYPE.match(type_)
        if found is None or found[2] == "srv":
            raise ActionError(f"the type {type_[:80]!r}", expected="`package/Type`")
        full = f"{found[1]}/msg/{found[3]}"
        self._learn(full)
        return full

    def sum_and_text(self, type_: str) -> tuple[str, str]:
        """Return the MD5 sum and the text of a message type, with the texts of what it holds."""
        text, md5 = self._store.generate_msgdef(self.name(type_))
        return md5, text

    def service(self, type_: str) -> tuple[str, str]:
        """Return the full names of request and response of a service type.

        Raises:
            ActionError: it is not found here, or its definition is none.
        """
        found = _TYPE.match(type_)
        if found is None or found[2] == "msg":
            raise ActionError(f"the type {type_[:80]!r}", expected="`package/Type` of a service")
        names = tuple(f"{found[1]}/msg/{found[3]}_{part}" for part in ("Request", "Response"))
        if names[0] not in self._store.fielddefs:
            text = self._text(found[1], "srv", found[3])
            request, _, response = re.sub(r"(?m)^-{3}\s*$", "\0", text, count=1).partition("\0")
            for name, part in zip(names, (request, response), strict=True):
                self._register(name, part)
                self._learn_held(name, 0)
        return names[0], names[1]

    def packed(self, full: str, fields: Any, stamp: tuple[int, int]) -> bytes:
        """Serialise a message; others than the given fields are zero, empty or false, and headers are stamped.

        Args:
            full: name of the type.
            fields: values by name.
            stamp: seconds and nanoseconds since the epoch.

        Raises:
            ActionError: there is no such field, or its value does not fit.
        """
        out = bytearray()
        self._pack(out, full, fields, stamp, full.rpartition("/")[2], 0)
        return bytes(out)

    def unpacked(self, full: str, body: bytes) -> Mapping[str, Any]:
        """Read a message.

        Raises:
            ActionError: the bytes are too few.
        """
        try:
            value, _ = self._unpack((Nodetype.NAME, full), body, 0)
        except (struct.error, IndexError) as error:
            raise ActionError(f"an answer of {len(body)} bytes that is not a {full}: {error}") from None
        found: Mapping[str, Any] = value
        return found

    def _learn(self, full: str, depth: int = 0) -> None:
        if full in self._store.fielddefs or full in _TIMES:
            return
        if depth > _DEEPEST or len(self._store.fielddefs) > _MOST_TYPES:
            raise ActionError(f"{full} holds too many other types")
        package, _, name = full.split("/")
        self._register(full, self._text(package, "msg", name))
        self._learn_held(full, depth)

    def _learn_held(self, full: str, depth: int) -> None:
        for _, described in self._store.fielddefs[full][1]:
            one: _Described = described
            kind, of = one
            if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
                kind, of = of[0]
            if kind is Nodetype.NAME:
                self._learn(of, depth + 1)

    def _register(self, full: str, text: str) -> None:
        try:
            self._store.register(get_types_from_msg(text, full))
        except (TypesysError, ValueError, KeyError) as error:
            raise ActionError(f"the definition of {full} is none: {error}", expected="lines of `type name`") from None

    def _text(self, package: str, room: str, name: str) -> str:
        for folder in self._folders:
            place = folder / package / room / f"{name}.{room}"
            try:
                return read_bounded(place, _MOST_BYTES).decode("utf-8", "replace")
            except OSError:
                continue
        shown = ", ".join(str(one) for one in self._folders[:5])
        raise ActionError(
            f"there is no {package}/{name} here", expected=f"{package}/{room}/{name}.{room} below one of {shown}",
            advice="Source the workspace that has it before roslens is started",
        )  # fmt: skip

    def _pack(self, out: bytearray, full: str, fields: Any, stamp: tuple[int, int], place: str, depth: int) -> None:
        if full in _TIMES:
            out += self._time(full, fields, place)
            return
        if not isinstance(fields, Mapping) or depth > _DEEPEST:
            raise ActionError(f"{place} is {str(fields)[:60]!r}", expected="fields with their values")
        described = self._store.fielddefs[full][1]
        names = [name for name, _ in described if name != "structure_needs_at_least_one_member"]
        if unknown := next((name for name in fields if name not in names), None):
            raise ActionError(f"{place} has no field {str(unknown)[:60]!r}", expected=", ".join(names)[:200])
        if full == _HEADER and "stamp" not in fields:
            fields = {**fields, "stamp": {"secs": stamp[0], "nsecs": stamp[1]}}
        for name, one in described:
            if name in names:
                self._pack_field(out, one, fields.get(name), stamp, f"{place}.{name}", depth + 1)

    def _pack_field(
        self, out: bytearray, described: _Described, value: Any, stamp: tuple[int, int], place: str, depth: int
    ) -> None:
        kind, of = described
        if kind is Nodetype.NAME:
            self._pack(out, of, {} if value is None else value, stamp, place, depth)
        elif kind is Nodetype.BASE:
            out += _base(of[0], value, place)
        else:
            item, size = of
            values = _items(value, size if kind is Nodetype.ARRAY else None, place)
            if kind is Nodetype.SEQUENCE:
                out += len(values).to_bytes(4, "little")
            for number, one in enumerate(values):
                self._pack_field(out, item, one, stamp, f"{place}[{number}]", depth + 1)

    @staticmethod
    def _time(full: str, value: Any, place: str) -> bytes:
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            value = dict(zip(("secs", "nsecs"), divmod(round(value * 1e9), 1_000_000_000), strict=True))
        if not isinstance(value, Mapping) or not set(value) <= {"secs", "nsecs"}:
            raise ActionError(f"{place} is {str(value)[:60]!r}", expected="seconds, or secs and nsecs")
        try:
            return struct.pack(_TIMES[full], value.get("secs", 0), value.get("nsecs", 0))
        except struct.error as error:
            raise ActionError(
                f"{place} is {str(value)[:60]!r}", expected=f"seconds, or secs and nsecs ({error})"
            ) from None

    def _unpack(self, described: _Described, body: bytes, at: int) -> tuple[Any, int]:
        kind, of = described
        if kind is Nodetype.NAME:
            if of in _TIMES:
                secs, nsecs = struct.unpack_from(_TIMES[of], body, at)
                return {"secs": secs, "nsecs": nsecs}, at + 8
            found = {}
            for name, one in self._store.fielddefs[of][1]:
                if name != "structure_needs_at_least_one_member":
                    found[name], at = self._unpack(one, body, at)
            return found, at
        if kind is Nodetype.BASE:
            return _read_base(of[0], body, at)
        item, size = of
        if kind is Nodetype.SEQUENCE:
            (size,) = struct.unpack_from("<I", body, at)
            at += 4
        if size > len(body):
            raise struct.error(f"a list of {size}")
        values = []
        for _ in range(size):
            one, at = self._unpack(item, body, at)
            values.append(one)
        return values, at


def _items(value: Any, size: int | None, place: str) -> Sequence[Any]:
    """Return the values of a list, which has to be ``size`` long where that is fixed."""
    if value is None:
        return [None] * (size or 0)
    if not isinstance(value, (list, tuple)) or (size is not None and len(value) != size):
        expected = "a list" if size is None else f"a list of {size}"
        raise ActionError(f"{place} is {str(value)[:60]!r}", expected=expected)
    return value


def _base(type_: str, value: Any, place: str) -> bytes:
    if type_ in ("string", "wstring"):
        if value is not None and not isinstance(value, str):
            raise ActionError(f"{place} is {str(value)[:60]!r}", expected="a text")
        encoded = (value or "").encode("utf-8", "replace")
        return len(encoded).to_bytes(4, "little") + encoded
    right = (
        isinstance(value, bool) if type_ == "bool" else isinstance(value, (int, float)) and not isinstance(value, bool)
    )
    if value is not None and not right:
        raise ActionError(f"{place} is {str(value)[:60]!r}", expected="true or false" if type_ == "bool" else type_)
    try:
        return struct.pack(f"<{_NUMBERS[type_]}", value or 0)
    except (struct.error, OverflowError) as error:
        raise ActionError(f"{place} is {str(value)[:60]!r}", expected=f"{type_} ({error})") from None


def _read_base(type_: str, body: bytes, at: int) -> tuple[Any, int]:
    if type_ in ("string", "wstring"):
        (size,) = struct.unpack_from("<I", body, at)
        end = at + 4 + size
        if end > len(body):
            raise struct.error(f"a text of {size} bytes")
        return body[at + 4 : end].decode("utf-8", "replace"), end
    form = struct.Struct(f"<{_NUMBERS[type_]}")
    return form.unpack_from(body, at)[0], at + form.size

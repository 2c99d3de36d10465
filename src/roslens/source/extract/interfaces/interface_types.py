"""Types and names in interface files, by the rules of genmsg (ROS 1) and of rosidl (ROS 2)."""

from __future__ import annotations

import re

from roslens.source.extract.interfaces.interface import FieldType

_INTEGERS = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64")
_EVERYWHERE = frozenset({"bool", "byte", "char", "float32", "float64", "string", *_INTEGERS})
CONSTANT_TYPES = {1: _EVERYWHERE, 2: _EVERYWHERE | {"wstring"}}
"""Types that a constant can have, by generation."""
_PRIMITIVES = {1: _EVERYWHERE | {"time", "duration"}, 2: CONSTANT_TYPES[2]}

_ROS1_TYPE = re.compile(r"(?P<of>[A-Za-z][\w/]*)(?P<array>\[(?P<size>\d*)\])?", re.ASCII)
_ROS1_NAME = re.compile(r"[A-Za-z]\w*")
_ROS2_ARRAY = re.compile(r"(?P<of>[^\[\]]+)(?P<array>\[(?P<most><=)?(?P<size>\d*)\])?", re.ASCII)
_ROS2_STRING = re.compile(r"(w?string)<=(\d+)", re.ASCII)
_ROS2_PACKAGE = re.compile(r"(?!.*__)(?!.*_$)[a-z][a-z0-9_]*")
_ROS2_MESSAGE = re.compile(r"[A-Z][A-Za-z0-9]*")
_ROS2_CONSTANT = re.compile(r"[A-Z](?:_?[A-Z0-9])*")
"""As rosidl has it, but with one way to match a name: with two, the time doubles with each letter of what is none."""


class MisreadError(Exception):
    """Something in an interface file that is not as its generation wants it: what was found, and what was expected."""

    def __init__(self, found: str, expected: str) -> None:
        """Keep both."""
        super().__init__(found, expected)
        self.found = found
        self.expected = expected


_LONGEST = (1 << 32) - 1
_MOST_DIGITS = 20


def field_type(written: str, package: str, generation: int) -> FieldType:
    """Return the type that is ``written``.

    Args:
        written: type as it stands in the file.
        package: that bare names of messages belong to.
        generation: of ROS.

    Raises:
        MisreadError: it is no type.
    """
    return _ros1_type(written, package) if generation == 1 else _ros2_type(written, package)


def _ros1_type(written: str, package: str) -> FieldType:
    match = _ROS1_TYPE.fullmatch(written)
    expected = "a type such as 'float64', 'float64[36]' or 'geometry_msgs/Pose[]'"
    if match is None or match["of"].count("/") > 1 or "//" in written or match["of"].endswith("/"):
        raise MisreadError(f"type {written!r}", expected)
    array = "" if match["array"] is None else "fixed" if match["size"] else "unbounded"
    size = _length(match["size"])
    of = match["of"]
    if of in _PRIMITIVES[1]:
        return FieldType(of, "", array, size, 0, written)
    if written == "Header":
        return FieldType("Header", "std_msgs", written=written)
    owner, _, name = of.rpartition("/")
    return FieldType(name, owner or package, array, size, 0, written)


def _ros2_type(written: str, package: str) -> FieldType:
    expected = "a type such as 'float64', 'string<=10', 'float64[<=5]' or 'geometry_msgs/Pose[]'"
    match = _ROS2_ARRAY.fullmatch(written)
    if match is None or (match["most"] and not match["size"]):
        raise MisreadError(f"type {written!r}", expected)
    if match["size"] and not _length(match["size"]):
        raise MisreadError(f"type {written!r}", "an array of at least one item")
    array, size = _ros2_array(match)
    of = match["of"]
    if of in _PRIMITIVES[2]:
        return FieldType(of, "", array, size, 0, written)
    if string := _ROS2_STRING.fullmatch(of):
        if not (longest := _length(string[2])):
            raise MisreadError(f"type {written!r}", "a string of at least one character")
        return FieldType(string[1], "", array, size, longest, written)
    if of in {"time", "duration"}:
        raise MisreadError(f"type {written!r}", f"'builtin_interfaces/{of.capitalize()}', as ROS 2 has no type {of!r}")
    owner, slash, name = of.partition("/")
    if not slash:
        owner, name = package, of
    if not (_ROS2_MESSAGE.fullmatch(name) and _ROS2_PACKAGE.fullmatch(owner)):
        raise MisreadError(f"type {written!r}", expected)
    return FieldType(name, owner, array, size, 0, written)


def _length(digits: str | None) -> int:
    """Return the length that digits state; 0 for none.

    Raises:
        MisreadError: no message can be that long: it states lengths in 32 bits.
    """
    if digits and (len(digits) > _MOST_DIGITS or int(digits) > _LONGEST):
        raise MisreadError(f"a length of {digits[:40]}", f"at most {_LONGEST:,}")
    return int(digits or 0)


def _ros2_array(match: re.Match[str]) -> tuple[str, int]:
    """Return the kind of an array, empty where there is none, and its size."""
    size = _length(match["size"])
    if not match["array"]:
        return "", size
    if match["most"]:
        return "bounded", size
    return "fixed" if match["size"] else "unbounded", size


def check_field_name(name: str, generation: int) -> None:
    """Raise MisreadError unless ``name`` can be that of a field."""
    if generation == 1:
        if not _ROS1_NAME.fullmatch(name):
            raise MisreadError(f"name {name!r}", "letters, digits and underscores, beginning with a letter")
    elif not _ROS2_PACKAGE.fullmatch(name):
        raise MisreadError(f"name {name!r}", "small letters, digits and single underscores, beginning with a letter")


def check_constant_name(name: str, generation: int) -> None:
    """Raise MisreadError unless ``name`` can be that of a constant."""
    if generation == 1:
        if not name or " " in name:
            raise MisreadError(f"name {name!r}", "a name without spaces, and nothing before the type")
    elif not _ROS2_CONSTANT.fullmatch(name):
        raise MisreadError(f"name {name!r}", "capital letters, digits and single underscores, beginning with a letter")

"""Values of constants and defaults in interface files, by the rules of genmsg (ROS 1) and of rosidl (ROS 2)."""

from __future__ import annotations

import re
from ast import literal_eval

from roslens.source.extract.interfaces.interface import FieldType, Value
from roslens.source.extract.interfaces.interface_types import MisreadError

_Single = str | int | float | bool
_LONGEST_NUMBER = 100
_ITEM = re.compile(r"""\s*(?:"((?:[^"\\]|\\.)*)"|'((?:[^'\\]|\\.)*)'|([^,"'\s][^,]*))\s*(?:,|$)""")


def constant_value(type_: str, written: str, generation: int) -> _Single:
    """Return the value of a constant.

    Raises:
        MisreadError: it is no value of that type.
    """
    if generation == 2:
        return _single(FieldType(type_), written)
    if type_ == "string":
        return written.strip()
    if type_ == "bool":
        try:
            return bool(literal_eval(written)) if len(written) < _LONGEST_NUMBER else _refuse(type_, written)
        except (ValueError, SyntaxError, TypeError):
            return _refuse(type_, written)
    if type_.startswith("float"):
        return _fraction(type_, written)
    return _whole(type_, written, 10, *_limits({"byte": "int8", "char": "uint8"}.get(type_, type_)))


def default_value(type_: FieldType, written: str) -> Value:
    """Return the default of a field of ROS 2.

    Raises:
        MisreadError: it is no value of that type.
    """
    if type_.package:
        raise MisreadError(f"default {written!r}", "no default, as a message can have none")
    if not type_.array:
        return _single(type_, written)
    if not (written.startswith("[") and written.endswith("]")):
        raise MisreadError(f"default {written!r}", "a list such as '[1, 2]'")
    inner = written[1:-1]
    items = _texts(inner) if type_.name in {"string", "wstring"} else inner.split(",") if inner else []
    if (type_.array == "fixed" and len(items) != type_.size) or (type_.array == "bounded" and len(items) > type_.size):
        number = "exactly" if type_.array == "fixed" else "at most"
        raise MisreadError(f"default {written!r} of {len(items)} items", f"{number} {type_.size}")
    return tuple(_single(type_, item.strip()) for item in items)


def _single(type_: FieldType, written: str) -> _Single:
    name = type_.name
    if name in {"string", "wstring"}:
        return _text(type_, written)
    if name == "bool":
        if written.lower() not in {"true", "1", "false", "0"}:
            _refuse(name, written)
        return written.lower() in {"true", "1"}
    if name.startswith("float"):
        return _fraction(name, written)
    return _whole(name, written, 0, *_limits("uint8" if name in {"byte", "char"} else name))


def _text(type_: FieldType, written: str) -> str:
    for quote in "\"'":
        if written.startswith(quote) and written.endswith(quote):
            written = written[1:-1]
            if re.search(rf"(?<!\\){quote}", written):
                raise MisreadError(f"text {written!r}", f"a backslash before each {quote} inside")
            written = written.replace("\\" + quote, quote)
            break
    if type_.longest and len(written) > type_.longest:
        raise MisreadError(f"text {written!r} of {len(written)} characters", f"at most {type_.longest}")
    return written


def _texts(inner: str) -> list[str]:
    items = []
    place = 0
    while place < len(inner.rstrip()):
        match = _ITEM.match(inner, place)
        if match is None:
            raise MisreadError(f"default {inner!r}", "texts separated by commas")
        found = next(part for part in match.groups() if part is not None)
        items.append(found)
        place = match.end()
    return items


def _fraction(type_: str, written: str) -> float:
    try:
        return float(written)
    except ValueError:
        return _refuse(type_, written)


def _limits(type_: str) -> tuple[int, int]:
    unsigned = type_.startswith("u")
    bits = int(type_[4 if unsigned else 3 :])
    return (0, 2**bits - 1) if unsigned else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)


def _whole(type_: str, written: str, base: int, least: int, most: int) -> int:
    if len(written) > _LONGEST_NUMBER:
        _refuse(type_, written)
    try:
        value = int(written)
    except ValueError:
        try:
            value = int(written, base)
        except ValueError:
            return _refuse(type_, written)
    if not least <= value <= most:
        raise MisreadError(f"value {written!r}", f"a number from {least} to {most}, as it is of type {type_!r}")
    return value


def _refuse(type_: str, written: str) -> bool:
    raise MisreadError(f"value {written[:_LONGEST_NUMBER]!r}", f"a value of type {type_!r}")

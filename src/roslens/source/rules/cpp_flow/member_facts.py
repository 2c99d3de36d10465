"""Which members of which type the classes of a file declare: sources of the package use what a header declares.

A hit that counts only where a member has such a type names the fact as its ``callback``; see
:class:`~roslens.source.rules.hit.Hit`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from roslens.source.rules.cpp_flow.variable_type import class_extents
from roslens.source.rules.file_view import FileView

MEMBER = "member "
"""Before a fact: ``member Class::name kind``."""

_KINDS: Mapping[str, str] = {
    "LifecyclePublisher": r"(?:rclcpp_lifecycle::)?LifecyclePublisher<[^;={}]*>::(?:Shared|Unique)Ptr"
    r"|std::(?:shared|unique)_ptr<(?:rclcpp_lifecycle::)?LifecyclePublisher<[^;={}]*>\s*>",
    "Duration": r"rclcpp::Duration",
    "Time": r"rclcpp::Time",
    "bool": r"bool",
    "double": r"double|float",
    "string": r"std::string",
    "int": r"u?int(?:8|16|32|64)_t|std::u?int(?:8|16|32|64)_t|(?:std::)?size_t|int|long|unsigned(?: int)?|short",
}
"""The kinds of types that rules ask for, and how they are written."""

_MEMBER = re.compile(
    (
        r"(?:^|[;{}])[ \t]*(?:mutable\s+)?(?:"
        + "|".join(f"(?P<k{number}>{written})" for number, written in enumerate(_KINDS.values()))
        + r")\s+(?P<names>\w+(?:\s*[={][^;]*|(?:\s*,\s*\w+)*)\s*)(?=;)"
    ).encode(),
    re.MULTILINE,
)
_NAME = re.compile(rb"\w+")
_VALUE = re.compile(rb"\{[^{}]*\}|=[^,;]*")
_PLAIN = re.compile(rb"[\w\s,]+")
_NAMES = tuple(_KINDS)
_WHOLE = tuple(re.compile(written) for written in _KINDS.values())


def kind_of(written: str) -> str:
    """Return the kind of a type as it is written; empty for one that no rule asks for."""
    return next((name for name, one in zip(_NAMES, _WHOLE, strict=True) if one.fullmatch(written)), "")


def member_fact(of_class: str, name: str, kind: str) -> str:
    """Return the fact that a member is of a kind."""
    return f"{MEMBER}{of_class}::{name} {kind}"


def member_facts(view: FileView) -> tuple[str, ...]:
    """Return the members that a header declares in classes, of types that rules ask for, sorted."""
    # What a source declares, no other file sees.
    if view.syntax != "cpp" or not view.may_be_header or not view.mentions((b"rclcpp",)):
        return ()
    found: set[str] = set()
    for match in _MEMBER.finditer(view.code):
        of_class = _innermost(match.start("names"), view)
        kind = _matched(match)
        names = match["names"]
        plain = _VALUE.sub(b"", names)
        listed = _NAME.findall(plain if _PLAIN.fullmatch(plain) else plain.partition(b",")[0])
        if of_class:
            found.update(member_fact(of_class, one.decode("utf-8", "replace"), kind) for one in listed)
    return tuple(sorted(found))


def _matched(match: re.Match[bytes]) -> str:
    return next(name for number, name in enumerate(_NAMES) if match[f"k{number}"] is not None)


def _innermost(at: int, view: FileView) -> str:
    around = [(end - start, name) for start, end, name in class_extents(view) if start < at < end]
    return min(around)[1] if around else ""

"""Preprocessor conditions that choose between ROS 1 and ROS 2: ``#ifdef ROS1``, ``#if ROS_VERSION == 2``.

Code that is built for both keeps its variants in the arms of such conditions. What a condition asks is known by the
usual names of the macros alone: builds define them, and seldom otherwise.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable
from functools import lru_cache

VERSIONS = ("ros1", "ros2")
_SWITCH = re.compile(rb"(?m)^[ \t]*#[ \t]*(?:el)?if[^\n]*(?:ROS_?[12]|ROS_VERSION|CATKIN|AMENT|has_include\s*\([<\"]r)")
_DEFINED = re.compile(rb"#\s*(?:el)?if(n?)def\s+(\w+)")
_ASKED = re.compile(rb"#\s*(?:el)?if\b(.*)", re.DOTALL)
_NAMED = re.compile(r"(?:^|_)(?:(ROS_?1|ROSCPP|CATKIN)|(ROS_?2|RCLCPP|AMENT))(?:_(?:BUILD|ENABLED|NODE|BUILT))?_*$")
_IS_DEFINED = re.compile(r"defined\s*\(\s*(\w+)\s*\)|defined\s+(\w+)|(\w+)")
_COMPARED = re.compile(r"(?:\w+_)?ROS_VERSION\s*(==|!=|<|>|<=|>=)\s*([12])")
_HEADER = re.compile(r"__has_include\s*\(\s*[<\"](?:(ros/|roscpp)|(rclcpp))[^)]*\)")
_OPERATORS: dict[str, Callable[[int, int], bool]] = {
    "==": operator.eq, "!=": operator.ne, "<": operator.lt, ">": operator.gt, "<=": operator.le, ">=": operator.ge,
}  # fmt: skip


def has_switch(source: bytes) -> bool:
    """Return whether a file of C++ may choose between variants for ROS 1 and ROS 2."""
    return _SWITCH.search(source) is not None


@lru_cache(maxsize=4096)
def holds(directive: bytes, version: str) -> bool | None:
    """Return whether the first arm of a directive is compiled for a version; None where that is not what it asks.

    Args:
        directive: its line, ``#ifdef ROS1``.
        version: ``ros1`` or ``ros2``.
    """
    line = directive.partition(b"//")[0].partition(b"/*")[0].strip()
    if (found := _DEFINED.match(line)) is not None:
        asked = _of_macro(found[2].decode("ascii", "replace"), version)
        return None if asked is None else asked != bool(found[1])
    condition = _ASKED.match(line)
    if condition is None:
        return None
    return _either(condition[1].decode("utf-8", "replace"), version)


def _of_macro(name: str, version: str) -> bool | None:
    found = _NAMED.search(name)
    return None if found is None else (version == "ros1") == bool(found[1])


def _either(text: str, version: str) -> bool | None:
    answers = [_both(one, version) for one in text.split("||")]
    return True if True in answers else None if None in answers else False


def _both(text: str, version: str) -> bool | None:
    answers = [_one(one.strip(), version) for one in text.split("&&")]
    return False if False in answers else None if None in answers else True


def _one(text: str, version: str) -> bool | None:
    if text.startswith("!") and not text.startswith("!="):
        answer = _one(text[1:].strip(), version)
        return None if answer is None else not answer
    if text.startswith("(") and text.endswith(")") and "(" not in text[1:]:
        text = text[1:-1].strip()
    if (compared := _COMPARED.fullmatch(text)) is not None:
        return _OPERATORS[compared[1]](int(version[-1]), int(compared[2]))
    if (header := _HEADER.fullmatch(text)) is not None:
        return (version == "ros1") == bool(header[1])
    asked = _IS_DEFINED.fullmatch(text)
    return None if asked is None else _of_macro(asked[1] or asked[2] or asked[3], version)

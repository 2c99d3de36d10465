"""Rule ``cpp.identical_arguments``: a comparison of something with itself by a function."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, whole_name
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_RANGES = ("equal", "mismatch", "is_permutation", "includes", "lexicographical_compare")
"""The second range begins at the third argument."""
_VALUES = ("memcmp", "strcmp", "strncmp", "strcasecmp", "swap", "min", "max", "fmin", "fmax")
"""The first two arguments are compared or exchanged."""
_SAME = re.compile(r"[\w\s.:>\[\]*&-]+?(?:\s*(?:\.|->)\s*c?begin\s*\(\s*\))?|(?:std::)?c?begin\s*\([\w\s.:>-]+\)")
"""An expression that gives the same whenever it is evaluated."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call of the standard library with one thing in both places that it compares."""
    call, name = call_at(node), view.text(node)
    if call is None or not _is_of_library(node, view):
        return
    given = arguments(call)
    other = 2 if name in _RANGES else 1
    if len(given) <= other:
        return
    first, second = _plain(given[0], view), _plain(given[other], view)
    if first != second or not _SAME.fullmatch(first) or not re.search("[A-Za-z_]", first) or "++" in first:
        return
    shown = view.short(call, 80)
    if name in ("swap", "min", "max", "fmin", "fmax"):
        message = f"`{shown}` has `{first}` twice and changes nothing; expected another second argument"
    else:
        message = f"`{shown}` compares `{first}` with itself, which never differs; expected the other one"
    yield view.hit("cpp.identical_arguments", call, message)


def _is_of_library(node: Node, view: FileView) -> bool:
    """Return whether a name is one of ``std``, or written without anything before it."""
    written = view.text(whole_name(node)).partition("<")[0]
    return written in (view.text(node), f"std::{view.text(node)}", f"::{view.text(node)}")


def _plain(node: Node, view: FileView) -> str:
    return " ".join(view.text(node).split())


RULE = FileRule(
    id="cpp.identical_arguments",
    title="Function that compares something with itself",
    finds="`std::equal(a.begin(), a.end(), a.begin())`, `memcmp(a, a, n)`, `std::min(a, a)` and the like: one "
    "expression in both places. Name the other one. Expressions with calls, but for `begin()`, are left out.",
    why="A check that two lists agree never fails, so that the code behind it reads past the end of the shorter one.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=(),
    bad="bool same(const V & a, const V & b) { return std::equal(a.begin(), a.end(), a.begin()); }\n",
    good="bool same(const V & a, const V & b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }\n",
    syntax="cpp",
    anchors=(*_RANGES, *_VALUES),
    spares_tests=True,
    found=found,
)

"""Names in code that distributions of ROS deprecated or removed, from the tables of distributions."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import cast

import msgspec
from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty
from roslens.source.distributions.read_changes import Change, Kind, rows_of
from roslens.source.rules.calls import whole_name
from roslens.source.rules.distribution.row_hit import is_chosen, row_message
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit

CPP_ROS2 = rows_of(Kind.CPP, ros=2)
PYTHON_ROS2 = rows_of(Kind.PYTHON, ros=2)
CPP_ROS1 = rows_of(Kind.CPP, ros=1)
PYTHON_ROS1 = rows_of(Kind.PYTHON, ros=1)


def find(node: Node, view: FileView, rule: str, table: tuple[Change, ...]) -> Iterator[Hit]:
    """Yield a hit where a node, or the name it is part of, is one of a table."""
    place = whole_name(node)
    name = view.text(place)
    if is_chosen(node, view) or _is_defined(name, view):
        return
    row = next((row for row in table if _is_meant(name, row.name, alone=place is node)), None)
    if row is None:
        return
    certainty = None if row.removed or row.ros == 1 else Certainty.HEURISTIC
    edits = _renamed(place, row, view)
    hit = view.hit(rule, place, row_message(row, row.name), edits=edits, certainty=certainty)
    yield msgspec.structs.replace(hit, change=row.key)


def _is_meant(name: str, deprecated: str, *, alone: bool) -> bool:
    """Return whether a name is a deprecated one, a member of it, or, behind an object, a method of that name."""
    if name == deprecated or name.startswith(f"{deprecated}::"):
        return True
    return not alone and name.endswith((f".{deprecated}", f"->{deprecated}"))


def _renamed(place: Node, row: Change, view: FileView) -> tuple[Edit, ...]:
    at = view.content.find(row.name.encode(), place.start_byte, place.end_byte) if row.alike else -1
    return view.edits((at, at + len(row.name), row.instead)) if at >= 0 else ()


def _is_defined(name: str, view: FileView) -> bool:
    """Tell whether the file defines a class or its constructor: who deprecates a name has to keep it for a while."""
    last = re.split(r"::|->|\.", name)[-1]
    key = ("defined", last)
    found = view.kept.get(key)
    if found is None:
        word = re.escape(last.encode())
        defined = rb"\b(?:class|struct)\s+(?:\w+\s+)?%s\s*(?:final\s*)?[:{]|\b%s\s*::\s*~?%s\s*\("
        found = view.kept[key] = re.search(defined % (word, word, word), view.code) is not None
    return cast("bool", found)

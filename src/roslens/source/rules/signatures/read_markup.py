"""The elements, attributes and substitutions of launch files in XML and YAML of ROS 2."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import msgspec

TABLES = ("launch_markup.toml", "launch_ros_markup.toml")
ANYWHERE = frozenset({"if", "unless"})
"""Attributes of every action."""


class ElementSignature(msgspec.Struct, frozen=True):
    """What an element may have.

    Attributes:
        name: of the element.
        attributes: that it reads, but for those of :data:`ANYWHERE`.
        required: those without which it is refused.
        children: the names of the elements that may stand in it; ``*`` for any action.
    """

    name: str
    attributes: tuple[str, ...] = ()
    required: tuple[str, ...] = ()
    children: tuple[str, ...] = ()


class Markup(msgspec.Struct, frozen=True):
    """All tables as one.

    Attributes:
        elements: actions, by the names of their elements.
        parts: elements that stand in others only; those of one element alone as ``include.arg``.
        substitutions: the least and the largest number of arguments of each.
    """

    elements: Mapping[str, ElementSignature]
    parts: Mapping[str, ElementSignature]
    substitutions: Mapping[str, tuple[int, int]]


@cache
def read_markup() -> Markup:
    """Return what the tables say."""
    import tomli

    rows: dict[str, dict[str, Any]] = {"elements": {}, "parts": {}, "substitutions": {}}
    for table in TABLES:
        read = tomli.loads(Path(__file__).with_name(table).read_text("utf-8"))
        for part, known in rows.items():
            known.update(read.get(part, {}))
    return Markup(
        {name: _element(name, rows["elements"]) for name in rows["elements"]},
        {name: _element(name, rows["parts"]) for name in rows["parts"]},
        {name: (least, most) for name, (least, most) in rows["substitutions"].items()},
    )


def _element(name: str, rows: Mapping[str, Any]) -> ElementSignature:
    """Return a row, with what the row that it is like has, but for what it is without."""
    row = rows[name]
    like = _element(row["like"], rows) if "like" in row else ElementSignature("")
    without = row.get("without", ())
    return ElementSignature(
        name,
        tuple(one for one in (*like.attributes, *row.get("attributes", ())) if one not in without),
        tuple(one for one in (*like.required, *row.get("required", ())) if one not in without),
        tuple(dict.fromkeys((*like.children, *row.get("children", ())))),
    )


def part_of(element: ElementSignature, child: str) -> ElementSignature | None:
    """Return what a child may have in an element; None where no such child may stand there."""
    markup = read_markup()
    for name in (f"{element.name}.{child}", child):
        if name in element.children:
            return markup.parts.get(name)
    return markup.elements.get(child) if "*" in element.children else None

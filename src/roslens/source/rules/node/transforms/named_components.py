"""Which angle or component an argument is, by its name: ``imu.roll``, ``angles->vector.z * rad``, ``q.w()``."""

from __future__ import annotations

import re
from collections.abc import Sequence

_CHAIN = re.compile(r"[A-Za-z_]\w*(?:\(\)|\[\w*\])?(?:(?:\.|->|::)[A-Za-z_]\w*(?:\(\)|\[\w*\])?)*(?!\w*\()")
_LAST = re.compile(r"(?:^|_)([xyzw])_?$")
_ANGLE = re.compile(r"(?:^|_|(?<=[a-z])(?=[A-Z]))([Rr]oll|[Pp]itch|[Yy]aw|ROLL|PITCH|YAW)(?![a-z])")
_LETTERS = {"roll": "r", "pitch": "p", "yaw": "y"}
_SIGNED = re.compile(r"^\s*-|[-+]\s*(?:\w|\()")
_ORDERED = re.compile("ypr|zyx|euler", re.IGNORECASE)
_AXES = str.maketrans("xyz", "rpy")


def order_of(texts: Sequence[str]) -> str:
    """Return the components that arguments are by their names, a letter for each: ``xyzw``.

    Empty where one of them is not known, or is negated or summed up: who turns axes on purpose does so.
    """
    letters = [_component(text) for text in texts]
    return "".join(letters) if all(letters) else ""


def angles_of(texts: Sequence[str]) -> str:
    """Return which angles arguments are, as ``rpy`` in the order of roll, pitch and yaw; those about x, y and z too."""
    found = [_angle(text) for text in texts]
    if all(found):
        return "".join(found)
    # What is called so holds the angles in the order of the name, whatever the parts of the vector are.
    order = "" if any(map(_ORDERED.search, texts)) else order_of(texts)
    return order.translate(_AXES) if "w" not in order else ""


def _component(text: str) -> str:
    names = {match[1] for name in _names(text) if (match := _LAST.search(name.lower()))}
    return names.pop() if len(names) == 1 else ""


def _angle(text: str) -> str:
    names = {_LETTERS[match.lower()] for name in _names(text) for match in _ANGLE.findall(name)}
    return names.pop() if len(names) == 1 else ""


def _names(text: str) -> list[str]:
    """Return the last part of each name in an expression, without calls and indices."""
    if _SIGNED.search(text):
        return []
    return [re.split(r"\.|->|::", re.sub(r"\(\)|\[\w*\]", "", chain))[-1] for chain in _CHAIN.findall(text)]

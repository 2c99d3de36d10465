"""The ids of ARNI's entities: ``h!host``, ``n!node``, ``t!topic`` and ``c!subscriber!topic!publisher``."""

from __future__ import annotations

import re

import msgspec

from roslens.judge.patterns.pattern import Pattern
from roslens.model.entity import EntityKind

_KINDS = {"h": EntityKind.HOST, "n": EntityKind.NODE, "t": EntityKind.TOPIC, "c": EntityKind.CONNECTION}
_ESCAPES = (("___xm___", "!"), ("___sl___", "/"), ("___dt___", "."))
_VALID = re.compile(r"[A-Za-z0-9_/.]+\Z")


class Selected(msgspec.Struct, frozen=True):
    """An id of ARNI as the lines of a constraint that select the same; ``odd`` is what ARNI thought of it."""

    kind: EntityKind
    lines: tuple[tuple[str, str], ...]
    odd: str = ""


def read_id(seuid: str) -> Selected | str:
    """Return what an id selects, or why it selects nothing."""
    letter, *parts = seuid.split("!")
    kind = _KINDS.get(letter)
    names = [_unescaped(part) for part in parts]
    if kind is None or not all(names) or len(names) != (3 if kind is EntityKind.CONNECTION else 1):
        return "no id, expected h!host, n!node, t!topic or c!subscriber!topic!publisher"
    if not all(name.isprintable() for name in names):
        return "its name cannot be printed, which no ROS name is like"
    try:
        wild = [name for name in names if Pattern.parse(name).literal is None]
    except ValueError as error:
        return str(error)
    odd = ""
    if wild:
        odd = f"ARNI had no wildcards and ignored it; now {' and '.join(map(repr, wild))} is a pattern"
    elif not all(_VALID.match(name) for name in names):
        odd = "ARNI ignored such names; now it counts"
    elif kind is EntityKind.HOST and names[0] == "127.0.0.1":
        odd = "the address of every host without a setting in ARNI; write the name of the host"
    if kind is EntityKind.CONNECTION:
        subscriber, topic, publisher = names
        lines = (("connection", topic), ("publisher", publisher), ("subscriber", subscriber))
        return Selected(kind, lines, odd)
    return Selected(kind, ((kind.value, names[0]),), odd)


def _unescaped(name: str) -> str:
    for escape, char in _ESCAPES:
        name = name.replace(escape, char)
    return name

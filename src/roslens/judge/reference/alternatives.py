"""The names that the braces of a pattern list: ``/{lidar,planner}`` names two nodes."""

from __future__ import annotations

import msgspec

from roslens.judge.patterns.pattern import REGULAR_EXPRESSION, Pattern
from roslens.judge.reference.expectation import Presence, PresenceMode

MOST = 1000
"""Alternatives of one pattern."""

EACH = frozenset({PresenceMode.ALWAYS, PresenceMode.WHILE})
"""Modes that ask for each alternative of a name, and not only for one."""

_ANY_DEPTH = "{,**/}"
"""Lists nothing: what ``**/`` means in a namespace."""


def alternatives(pattern: str) -> tuple[str, ...]:
    """Return the patterns that one is short for, without braces; a regular expression is itself.

    Args:
        pattern: that :class:`Pattern` has read.

    Raises:
        ValueError: there are more than `MOST`.
    """
    if pattern.startswith(REGULAR_EXPRESSION) or "{" not in pattern:
        return (pattern,)
    return tuple(dict.fromkeys(_Reader(pattern).sequence(0)))


def each(presence: Presence) -> tuple[Presence, ...]:
    """Return a presence once for each alternative of its name, where each of them has to be there."""
    if presence.mode not in EACH:
        return (presence,)
    selector = presence.selector
    left_out = [Pattern.parse(text) for text in selector.without]
    return tuple(
        msgspec.structs.replace(presence, selector=msgspec.structs.replace(selector, name=name))
        for name in alternatives(selector.name)
        if (literal := Pattern.parse(name).literal) is None or not any(one.matches(literal) for one in left_out)
    )


class _Reader:
    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0

    def sequence(self, depth: int) -> list[str]:
        """Read up to the end of the text, or inside braces up to a comma or their end."""
        found = [""]
        while self._at < len(self._text):
            char = self._text[self._at]
            if self._text.startswith(_ANY_DEPTH, self._at):
                pieces = self._take(len(_ANY_DEPTH))
            elif char == "\\" or self._text.startswith("**", self._at):
                pieces = self._take(2)
            elif char == "{":
                pieces = self._choice(depth)
            elif depth and char in ",}":
                break
            else:
                pieces = self._take(1)
            if len(found) * len(pieces) > MOST:
                raise ValueError(f"{self._text[:60]!r} names more than {MOST} things, expected at most {MOST}")
            found = [_joined(before, piece) for before in found for piece in pieces]
        return found

    def _choice(self, depth: int) -> list[str]:
        pieces = []
        while self._at < len(self._text) and self._text[self._at] != "}":
            self._at += 1
            pieces += self.sequence(depth + 1)
        self._at += 1
        return pieces

    def _take(self, length: int) -> list[str]:
        self._at += length
        return [self._text[self._at - length : self._at]]


def _joined(before: str, piece: str) -> str:
    """Return two parts of a pattern as one: wildcards that meet where braces were are the wider one of them."""
    head, rest = before.rstrip("*"), piece.lstrip("*")
    ends, begins = len(before) - len(head), len(piece) - len(rest)
    if (len(head) - len(head.rstrip("\\"))) % 2:
        # The first of them stands for itself.
        head, ends = head + "*", ends - 1
    return head + "*" * max(ends, begins) + rest if ends and begins else before + piece

"""The lines of a text and where they begin, split once for all who ask: facts, rules, places of findings."""

from __future__ import annotations

from functools import cached_property
from itertools import accumulate, count
from operator import add


class TextLines:
    """The lines of a text."""

    def __init__(self, text: bytes) -> None:
        """Split ``text`` on first use."""
        self._text = text

    @cached_property
    def lines(self) -> list[bytes]:
        """The lines, without what ends them; the last is empty where the text ends with a line end."""
        return self._text.split(b"\n")

    @cached_property
    def starts(self) -> list[int]:
        """The position at which each line begins, and one behind the last."""
        return [0, *map(add, accumulate(map(len, self.lines)), count(1))]

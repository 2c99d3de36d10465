"""Where lines begin in C++ source, and which of them are executed."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from itertools import accumulate, compress, count, product
from operator import add
from zlib import crc32

from roslens.source.syntax.facts import Lines

_BRACES = tuple("".join(marks) for length in (1, 2, 3) for marks in product("{}();", repeat=length))
_WORDS = tuple(f"{left}{word}{right}" for word in ("else", "do", "try") for left in ("", "}") for right in ("", "{"))
_NOT_EXECUTED = frozenset(crc32(text.encode()) for text in (*_BRACES, *_WORDS))
_DIRECTIVE = re.compile(rb"[#\xa3]")
"""A directive, or an ``#include`` that is one word since its comments were blanked."""


class LineMap:
    """Lines of a source text: numbers of positions, and how many lines of a span are executed.

    A line of a body is executed when it holds a token of a statement or of a declaration with an initialiser. At most
    three braces, parentheses and semicolons alone, ``else``, ``do`` and ``try`` alone, labels of ``goto``,
    preprocessor directives, comments, and declarations without an initialiser are not executed. The headers of
    control statements and ``case`` labels are. This follows STXLN of the static analyser QAC.
    """

    def __init__(self, source: bytes, hashes: Sequence[int], numbers: Sequence[int]) -> None:
        """Find the line starts of ``source``; the hashes of its code lines and their numbers tell what is on them."""
        lines = source.split(b"\n")
        self._starts: list[int] = [0, *map(add, accumulate(map(len, lines)), count(1))]
        self._numbers = numbers
        self._filled = list(compress(count(1), map(bytes.strip, lines)))
        self._executed = list(compress(numbers, [one not in _NOT_EXECUTED for one in hashes]))

    def leave_out(self, code: bytes, spans: Sequence[tuple[int, int]], statements: Sequence[int]) -> None:
        """Leave out the directives of ``code`` and the lines of ``spans``, unless a statement begins on them."""
        left_out = set()
        for match in _DIRECTIVE.finditer(code):
            line = self.number(match.start())
            if not code[self.start(line) : match.start()].strip():
                left_out.add(line)
        for start, end in spans:
            first, last = self.number(start), self.number(end - 1)
            left_out.update(range(first, last + 1) if last > first else (first,))
        left_out = {line for line in left_out if not self._begins_on(line, statements)}
        if left_out:
            self._executed = [number for number in self._executed if number not in left_out]

    def _begins_on(self, line: int, positions: Sequence[int]) -> bool:
        place = bisect_left(positions, self._starts[line - 1])
        return place < len(positions) and positions[place] < self._starts[line]

    @property
    def filled(self) -> int:
        """Number of lines that are not blank."""
        return len(self._filled)

    def leave_only(self, filled: Sequence[int]) -> None:
        """Leave out all lines but ``filled``: those that still hold something in a source that was repaired."""
        kept = set(filled)
        self._executed = [number for number in self._executed if number in kept]

    def number(self, position: int) -> int:
        """Return the 1-based line of a byte position."""
        return bisect_right(self._starts, position)

    def start(self, line: int) -> int:
        """Return the position that a line begins at."""
        return self._starts[line - 1]

    def executed(self, first: int, last: int) -> int:
        """Return how many of the lines from ``first`` to ``last`` are executed."""
        return bisect_right(self._executed, last) - bisect_left(self._executed, first)

    def lines(self, first: int, last: int) -> Lines:
        """Return what the lines from ``first`` to ``last`` hold."""
        filled = bisect_right(self._filled, last) - bisect_left(self._filled, first)
        code = bisect_right(self._numbers, last) - bisect_left(self._numbers, first)
        return Lines(last - first + 1, code, max(0, filled - code), last - first + 1 - max(filled, code))

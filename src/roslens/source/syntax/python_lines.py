"""Where lines begin in Python source, and which of them are executed."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from itertools import accumulate, compress, product
from zlib import crc32

from roslens.source.syntax.facts import Lines

_PUNCTUATION = tuple("".join(marks) for length in (1, 2, 3) for marks in product("()[]{},:;", repeat=length))
_NOT_EXECUTED = frozenset(crc32(text.encode()) for text in (*_PUNCTUATION, "else:", "try:", "finally:"))


class LineMap:
    """Lines of a source text: numbers of positions, and how many lines of a span are executed.

    A line is executed when it holds a token, but not when it holds nothing besides at most three brackets, commas,
    colons and semicolons, nor when it is a bare ``else:``, ``try:`` or ``finally:``, nor when it belongs to a string
    that stands alone (a docstring) or to a ``global`` or ``nonlocal`` statement. Every line of another string is;
    there the lines of a function differ from cloc, which takes all but the first line of any triple-quoted string
    for a comment.
    """

    def __init__(
        self, source: bytes, hashes: Sequence[int], numbers: Sequence[int], idle: Sequence[tuple[int, int]]
    ) -> None:
        """Find the lines of ``source``.

        Args:
            source: the text.
            hashes: of its code lines.
            numbers: of the same lines.
            idle: extents of statements that do nothing.
        """
        lines = source.splitlines(keepends=True)
        self._starts = list(accumulate(map(len, lines), initial=0))
        blank = {number for number, line in enumerate(lines, 1) if not line.strip()}
        self._blank = sorted(blank.difference(numbers))
        self._numbers = numbers
        executed = compress(numbers, [one not in _NOT_EXECUTED for one in hashes])
        nothing: set[int] = set()
        for start, end in idle:
            nothing.update(range(self.number(start), self.number(end) + 1))
        self._executed = [number for number in executed if number not in nothing]

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
        """Classify the lines from ``first`` to ``last``."""
        code = bisect_right(self._numbers, last) - bisect_left(self._numbers, first)
        blank = bisect_right(self._blank, last) - bisect_left(self._blank, first)
        physical = last - first + 1
        return Lines(physical, code, max(0, physical - code - blank), blank)

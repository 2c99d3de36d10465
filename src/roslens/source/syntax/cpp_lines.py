"""Where lines begin in C++ source, and which of them are executed."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from itertools import compress, count, product
from operator import itemgetter
from zlib import crc32

from roslens.source.syntax.facts import Lines
from roslens.source.syntax.text_lines import TextLines

_BRACES = tuple("".join(marks) for length in (1, 2, 3) for marks in product("{}();", repeat=length))
_WORDS = tuple(f"{left}{word}{right}" for word in ("else", "do", "try") for left in ("", "}") for right in ("", "{"))
_NOT_EXECUTED = frozenset(crc32(text.encode()) for text in (*_BRACES, *_WORDS))
_DIRECTIVE = re.compile(rb"[#\xa3]")
"""What begins a directive, or an ``#include`` that is one word since its comments were blanked."""


class LineMap:
    """Lines of a source text: numbers of positions, and how many lines of a span are executed.

    A line of a body is executed when it holds a token of a statement or of a declaration with an initialiser. At most
    three braces, parentheses and semicolons alone, ``else``, ``do`` and ``try`` alone, labels of ``goto``,
    preprocessor directives, comments, and declarations without an initialiser are not executed. The headers of
    control statements and ``case`` labels are. This follows STXLN of the static analyser QAC.

    Attributes:
        hashes: of the lines that hold code, see :func:`~roslens.source.syntax.tokens.line_hashes`.
        numbers: of these lines.
    """

    def __init__(self, text: TextLines, squeezed: Sequence[bytes]) -> None:
        """Take the lines of a source, ``text``, and those of the same ``squeezed``, with its comments blanked."""
        code = list(filter(None, squeezed))
        self.hashes = tuple(map(crc32, code))
        self.numbers = numbers = tuple(compress(count(1), squeezed))
        lines = text.lines
        self._starts = text.starts
        self._physical = len(lines) if lines[-1] else len(lines) - 1
        self._filled = list(compress(count(1), map(bytes.strip, lines)))
        self._executed = [number for number, one in zip(numbers, self.hashes, strict=True) if one not in _NOT_EXECUTED]
        firsts = bytes(map(itemgetter(0), code))
        self._directives = {numbers[match.start()] for match in _DIRECTIVE.finditer(firsts)}

    def leave_out(self, spans: Sequence[tuple[int, int]], statements: Sequence[int]) -> None:
        """Leave out the directives and the lines of ``spans``, unless a statement begins on them."""
        left_out = set(self._directives)
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

    def whole(self) -> Lines:
        """Return what the lines of the source hold."""
        filled, code = len(self._filled), len(self.numbers)
        return Lines(self._physical, code, filled - code, self._physical - filled)

    def lines(self, first: int, last: int) -> Lines:
        """Return what the lines from ``first`` to ``last`` hold."""
        filled = bisect_right(self._filled, last) - bisect_left(self._filled, first)
        code = bisect_right(self.numbers, last) - bisect_left(self.numbers, first)
        return Lines(last - first + 1, code, max(0, filled - code), last - first + 1 - max(filled, code))

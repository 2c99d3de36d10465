"""Extents of bytes that edits take away: a word with the space behind it, a whole line."""

from __future__ import annotations


def with_space(content: bytes, start: int, end: int) -> tuple[int, int]:
    """Return the extent of a word and the blanks behind it; where a line ends behind it, those before it."""
    last = end
    while content[last : last + 1] in (b" ", b"\t"):
        last += 1
    if content[last : last + 1] not in (b"", b"\r", b"\n"):
        return start, last
    first = start
    while content[first - 1 : first] in (b" ", b"\t") and first:
        first -= 1
    return first, end


def line_around(content: bytes, at: int) -> tuple[int, int]:
    """Return the extent of the line with a byte, with what ends it."""
    start = content.rfind(b"\n", 0, at) + 1
    end = content.find(b"\n", at)
    return start, len(content) if end < 0 else end + 1


def indent_of(content: bytes, at: int) -> str:
    """Return the blanks with which the line with a byte begins."""
    start, end = line_around(content, at)
    line = content[start:end]
    return line[: len(line) - len(line.lstrip(b" \t"))].decode("ascii")


def whole_lines(content: bytes, start: int, end: int) -> tuple[int, int]:
    """Return an extent, widened to whole lines where nothing else stands in them."""
    first, _ = line_around(content, start)
    _, last = line_around(content, max(end - 1, start))
    if content[first:start].strip() or content[end:last].strip():
        return start, end
    return first, last

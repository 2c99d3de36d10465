"""Places of a pattern in code without comments and strings, with the node of the tree around each."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.file_view import FileView

WORD_BYTES = frozenset((*b"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_", *range(0x80, 0x100)))
"""What words are made of; those above ASCII are letters of other scripts, and what stands in strings."""


def places(pattern: re.Pattern[bytes], view: FileView, group: int = 0) -> Iterator[tuple[re.Match[bytes], Node]]:
    """Yield each match in the code of a file, with the smallest node around one of its groups.

    Strings are single words there (:mod:`~roslens.source.syntax.comments`), comments are spaces.
    """
    for match in pattern.finditer(view.code):
        node = view.node_at(match.start(group), match.end(group))
        if node is not None:
            yield match, node


def lines_of(pattern: re.Pattern[bytes], view: FileView, group: int = 0) -> Iterator[tuple[re.Match[bytes], int]]:
    """Yield each match in the code of a file, with its line, 1-based."""
    for match in pattern.finditer(view.code):
        yield match, view.place(match.start(group))[0]


def word_places(word: bytes, view: FileView, start: int = 0, end: int | None = None) -> Iterator[int]:
    """Yield each position in the code of a file at which a name stands as a whole word.

    It compiles no pattern: names are many, and each is asked once.
    """
    code = view.code
    last = len(code) if end is None else end
    length = len(word)
    at = code.find(word, start, last)
    while at >= 0:
        behind = at + length
        if not ((at and code[at - 1] in WORD_BYTES) or (behind < len(code) and code[behind] in WORD_BYTES)):
            yield at
        at = code.find(word, behind, last)

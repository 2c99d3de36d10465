"""One parse within the time that a file may take.

The recovery of tree-sitter from what is no source takes more than quadratic time. Its Python binding has no time limit,
but asks on the way whether to go on; it does not look whether that question raised, so signals are held meanwhile.
(What it has for queries, of version 0.26, uses memory that is no longer there.)

The binding, as of version 0.26, also never lets go of the bytes that it asks for: a process that parses again and again
would keep the text of every file. So they are given back here.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from functools import cache

from tree_sitter import Language, Parser, Point, Tree

from roslens.intake.held_signals import held_signals
from roslens.intake.time_budget import is_spent, spent

_PIECE = 1 << 10
"""The first piece is all of the source; of this size are those that are asked for later, when a part of it is parsed
again and for the text of each node, of which most are a word."""


def timed_parse(parser: Parser, source: bytes, earlier: Tree | None = None) -> Tree:
    """Parse ``source``, from the edited tree of an ``earlier`` version where there is one.

    Raises:
        OverBudgetError: the time budget of the file is spent.
    """
    handed: list[bytes] = []

    def read(position: int, _point: Point) -> bytes:
        # A copy, so that nobody else holds what is given back.
        piece = bytes(memoryview(source)[position : position + _PIECE if position else None])
        if parsing and piece:
            handed.append(piece)
        return piece

    parsing = True
    try:
        return _parsed(parser, read, earlier)
    finally:
        parsing = False
        _give_back(handed, _kept_references(parser.language) if parser.language else 0)


def _parsed(parser: Parser, read: Callable[[int, Point], bytes], earlier: Tree | None) -> Tree:
    while True:
        with held_signals() as came:
            stop = _stop(came)
            try:
                if earlier is None:
                    return parser.parse(read, progress_callback=stop)
                return parser.parse(read, earlier, progress_callback=stop)
            except ValueError:
                # What is left of it would be gone on with at the next parse, of another text.
                parser.reset()
                if not came and not is_spent():
                    raise
        _stop_if_spent()


def _give_back(handed: list[bytes], kept: int) -> None:
    """Drop the references that the binding kept: so many of each of these objects, which nobody else has."""
    for _ in range(kept):
        for piece in handed:
            ctypes.pythonapi.Py_DecRef(ctypes.py_object(piece))


@cache
def _kept_references(language: Language) -> int:
    """Return how many references to a piece of source a parse leaves behind: 0 for a binding without the mistake."""
    probe = bytes(bytearray(b"a probe"))
    before = sys.getrefcount(probe)
    Parser(language).parse(lambda position, _: b"" if position else probe)
    return max(0, sys.getrefcount(probe) - before)


def _stop(came: list[int]) -> Callable[..., bool]:
    return lambda _at, _has_error: bool(came) or is_spent()


def _stop_if_spent() -> None:
    if is_spent():
        raise spent()

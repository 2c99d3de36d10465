"""One parse within the time that a file may take.

The recovery of tree-sitter from what is no source takes more than quadratic time. Its Python binding has no time limit,
but asks on the way whether to go on; it does not look whether that question raised, so signals are held meanwhile.
(What it has for queries, of version 0.26, uses memory that is no longer there.)
"""

from __future__ import annotations

from collections.abc import Callable

from tree_sitter import Parser, Point, Tree

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

    def read(position: int, _point: Point) -> bytes:
        return source[position : position + _PIECE] if position else source

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


def _stop(came: list[int]) -> Callable[..., bool]:
    return lambda _at, _has_error: bool(came) or is_spent()


def _stop_if_spent() -> None:
    if is_spent():
        raise spent()

"""What is remembered of what is gone: the newest of it, so that a watch of weeks stays as small as one of an hour."""

from __future__ import annotations

from typing import TypeVar

K = TypeVar("K")
V = TypeVar("V")

MOST_GONE = 300
"""Of one kind of thing. A command line tool makes a node, and topics of it, whose name never comes again."""


def keep_newest(kept: dict[K, V], most: int = MOST_GONE) -> None:
    """Drop what was put first until ``most`` are left; to put a key anew at the end, take it out before."""
    for key in list(kept)[: max(len(kept) - most, 0)]:
        del kept[key]

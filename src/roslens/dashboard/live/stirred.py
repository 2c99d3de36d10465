"""Which of many values are other objects than they were: who makes them anew keeps those that stay."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import compress
from operator import is_not


def stirred(before: Sequence[object], after: Sequence[object]) -> list[int]:
    """Return the places at which two lists of one length hold different objects."""
    return list(compress(range(len(after)), map(is_not, before, after)))

"""Which constraints of an imported specification contradict each other; of a pattern and a name, the pattern goes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reading.read_reference import GivenText, read_references
from roslens.judge.reference.expectation import Expectation
from roslens.judge.reference.merge_references import merge_references
from roslens.model.quantity import Quantity

GREATEST = 100.0
"""The percentile that stands for the greatest value of a window."""


class Clash(msgspec.Struct, frozen=True):
    """Two constraints that cannot both hold, by their number in the document.

    Attributes:
        loser: a pattern, and the later one of two.
        winner: the other.
        key: the signal that both are about.
        percentile: of the loser, ``GREATEST`` or 0.
    """

    loser: int
    winner: int
    key: str
    percentile: float


def clashes_of(text: str, known: Mapping[str, Quantity]) -> tuple[Clash, ...]:
    """Return the contradictions between signals in the text of a reference.

    Raises:
        DocumentError: it is no reference.
    """
    merged = merge_references(read_references([GivenText("imported", text.encode())], known))
    starts = list(_starts(text))
    found = []
    for one in merged.contradictions:
        first, second = one.first, one.second
        if isinstance(first, Expectation) and isinstance(second, Expectation):
            sides = [(_number(starts, one.other), first), (_number(starts, one.where), second)]
            sides.sort(key=lambda side: (not _is_pattern(side[1]), -side[0]))
            (loser, constraint), (winner, _) = sides
            found.append(Clash(loser, winner, constraint.quantity, constraint.percentile))
    return tuple(found)


def _starts(text: str) -> Iterator[int]:
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("  - "):
            yield number


def _number(starts: list[int], place: str) -> int:
    line = int(place.split(":")[-2])
    return sum(start <= line for start in starts) - 1


def _is_pattern(one: Expectation) -> bool:
    names = (one.selector.name, one.selector.publisher, one.selector.subscriber)
    return any(name and Pattern.parse(name).literal is None for name in names)

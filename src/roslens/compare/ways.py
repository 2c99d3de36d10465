"""The ways in which something comes to be there: each a list of conditions that must all hold."""

from __future__ import annotations

from collections.abc import Iterable

Way = tuple[str, ...]

_NOT = "not "


def fewest(ways: Iterable[Way]) -> tuple[Way, ...]:
    """Return ways that hold exactly where those given do, without what they say twice.

    Two that differ only in a condition and its opposite are one without it: what is there if a, and if not a, always
    is. One that asks for more than another adds nothing.
    """
    left = {tuple(dict.fromkeys(way)) for way in ways}
    while (pair := _joined(left)) is not None:
        one, two, both = pair
        left = (left - {one, two}) | {both}
    return tuple(sorted(way for way in left if not any(other != way and set(other) < set(way) for other in left)))


def _joined(ways: set[Way]) -> tuple[Way, Way, Way] | None:
    ordered = sorted(ways)
    for place, one in enumerate(ordered):
        for two in ordered[place + 1 :]:
            differing = set(one) ^ set(two)
            if len(differing) == 2 and len(one) == len(two) and _opposite(*sorted(differing)):
                return one, two, tuple(condition for condition in one if condition not in differing)
    return None


def _opposite(one: str, two: str) -> bool:
    return one == _NOT + two or two == _NOT + one

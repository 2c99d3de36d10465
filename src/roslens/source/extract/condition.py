"""Conditions as they are written in code."""

from __future__ import annotations

from collections.abc import Sequence

_LONG = 150
"""So many signs of one of several conditions are shown."""


def negated(condition: str) -> str:
    """Return the opposite of a condition as written."""
    if condition == "no exception":
        return "an exception"
    if " and " in condition or " or " in condition:
        return f"not ({condition})"
    return condition.removeprefix("not ") if condition.startswith("not ") else f"not {condition}"


def under_either(first: Sequence[str], second: Sequence[str]) -> tuple[str, ...]:
    """Return what holds wherever all of these conditions or all of those do."""
    common = tuple(one for one in first if one in second)
    rests = [" and ".join(one for one in whole if one not in common) for whole in (first, second)]
    if not all(rests) or negated(rests[0]) == rests[1] or negated(rests[1]) == rests[0]:
        return common
    return *common, " or ".join(one if len(one) <= _LONG else f"{one[:_LONG]}…" for one in rests)

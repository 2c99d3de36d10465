"""Conditions of reactions in words."""

from __future__ import annotations

from roslens.model.acting.condition import AllOf, AnyOf, AtLeast, Condition, Not, OverTime, Stated


def condition_words(condition: Condition) -> str:
    """Return what has to be the case: ``node /lidar is gone and (host base is high or …)``."""
    return _of(condition) + _over_time(condition.time)


def _of(condition: Condition) -> str:
    if isinstance(condition, Stated):
        return condition.written
    if isinstance(condition, Not):
        return f"not ({condition_words(condition.part)})"
    parts = [_part(one) for one in condition.parts]
    if isinstance(condition, AtLeast):
        return f"at least {condition.count} of: {', '.join(parts)}"
    return (" and " if isinstance(condition, AllOf) else " or ").join(parts)


def _part(condition: Condition) -> str:
    words = condition_words(condition)
    joined = isinstance(condition, (AllOf, AnyOf, AtLeast)) and len(condition.parts) > 1
    return f"({words})" if joined else words


def _over_time(time: OverTime) -> str:
    found = []
    if time.for_s:
        found.append(f"for {time.for_s:g} s")
    if time.of is not None:
        found.append(f"within {time.within_s:g} s of ({condition_words(time.of)})")
    if time.after_start_s:
        found.append(f"from {time.after_start_s:g} s after the start")
    return "".join(f", {one}" for one in found)

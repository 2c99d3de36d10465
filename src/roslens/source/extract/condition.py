"""Conditions as they are written in code."""

from __future__ import annotations


def negated(condition: str) -> str:
    """Return the opposite of a condition as written."""
    if condition == "no exception":
        return "an exception"
    if " and " in condition or " or " in condition:
        return f"not ({condition})"
    return condition.removeprefix("not ") if condition.startswith("not ") else f"not {condition}"

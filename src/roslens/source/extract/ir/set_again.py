"""Texts that a block sets more than once: where an exception leaves it they may be what they were in between."""

from __future__ import annotations

from typing import Any

from roslens.source.extract.ir.program import Assign, Branch, Loop, Member, Name, Statement
from roslens.source.extract.symbolic.text import Text, unknown


def forget_set_again(body: tuple[Statement, ...], names: dict[str, Any], was: dict[str, Any]) -> set[str]:
    """Forget texts that were known before a block, and that it may have set to one of several; return their names.

    Args:
        body: the block.
        names: that hold what they were before the block, or what they came to.
        was: what they were before it.
    """
    changed = [name for name, value in was.items() if isinstance(value, Text) and value.known]
    changed = [name for name in changed if names.get(name) is not was[name]]
    found = set(changed) & _set_again(body) if changed else set()
    for name in found:
        names[name] = unknown(f"{name}, which is set more than once before an exception")
    return found


def _set_again(body: tuple[Statement, ...]) -> set[str]:
    """Return the last names of what statements assign at several places, or in loops."""
    once: set[str] = set()
    again: set[str] = set()
    waiting: list[tuple[Statement, bool]] = [(one, False) for one in body]
    while waiting:
        one, turns = waiting.pop()
        match one:
            case Assign(target=Name(name=name) | Member(name=name)) if not one.declared:
                (again if turns or name in once else once).add(name)
            case Branch():
                waiting += [(each, turns) for each in (*one.then, *one.otherwise)]
            case Loop():
                waiting += [(each, True) for each in (*one.body, *one.update)]
    return again

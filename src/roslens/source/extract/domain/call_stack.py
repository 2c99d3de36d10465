"""The calls around what is evaluated."""

from __future__ import annotations

from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.ir.program import Expression, Function

Key = tuple[str, int]
"""File and line of a function."""
_NONE: Key = ("", 0)


class CallStack:
    """The functions that are evaluated, the outermost first.

    Attributes:
        keys: of them.
        calls: where each is called, which it is, and its arguments as expressions.
    """

    __slots__ = ("calls", "keys")

    def __init__(self) -> None:
        """Begin outside of functions."""
        self.keys: list[Key] = []
        self.calls: list[tuple[Evidence, Function, tuple[Expression, ...]]] = []

    @property
    def running(self) -> Key:
        """The innermost function."""
        return self.keys[-1] if self.keys else _NONE

    def enter(self, key: Key, site: Evidence, what: Function, written: tuple[Expression, ...]) -> None:
        """Note that a function is called."""
        self.keys.append(key)
        self.calls.append((site, what, written))

    def leave(self) -> None:
        """Note that the innermost function is left."""
        self.keys.pop()
        self.calls.pop()

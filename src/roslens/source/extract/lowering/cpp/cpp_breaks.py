"""Choices of C++ that are left by ``break`` under a condition: what follows it there is done where it does not hold."""

from __future__ import annotations

from roslens.source.extract.ir.program import (
    Branch,
    Expression,
    Leave,
    Literal,
    Member,
    Name,
    Opaque,
    Return,
    Statement,
)
from roslens.source.extract.lowering.cpp.cpp_lowered import Lowered

_MOST_COPIES = 16
"""So often what follows is written down on two ways of a choice; a ``break`` after that is not seen."""
_MOST_FOLLOWING = 100
"""Statements that a case falls through to: each case holds them, so that they grow with the square of the cases."""
_SAYING_NOTHING = (Name, Opaque, Literal, Member)

Statements = tuple[Statement, ...]
Case = tuple[Expression | None, list[Statement], bool, int]
"""The condition of a case, None of the default one; its statements, whether they end it, and the line."""


def fallen_through(cases: list[Case], lowered: Lowered) -> list[tuple[Expression | None, Statements, int]]:
    """Return the condition, statements and line of each case; without ``break`` those of the next case follow."""
    found: list[tuple[Expression | None, Statements, int]] = []
    following: Statements = ()
    for condition, statements, ends, line in reversed(cases):
        if len(following) > _MOST_FOLLOWING:
            lowered.incomplete.add((line, f"falls through to more than {_MOST_FOLLOWING} statements"))
            following = ()
        following = without_breaks(tuple(statements), () if ends else following)
        found.append((condition, following, line))
    return found[::-1]


def without_breaks(statements: Statements, following: Statements) -> Statements:
    """Return the statements of a case and those that follow them without the ``break`` in the first ones.

    What leaves a loop in them is not meant.
    """
    if not any(isinstance(one, Leave) or (isinstance(one, Branch) and _breaks(one)) for one in statements):
        return (*statements, *following)
    return _Breaks().of((*statements, *following))


class _Breaks:
    def __init__(self) -> None:
        self._copies = 0

    def of(self, statements: Statements) -> Statements:
        for place, one in enumerate(statements):
            match one:
                case Leave() if not one.again:
                    return statements[:place]
                case Branch() if _breaks(one):
                    rest = statements[place + 1 :]
                    after = self._branched(one, rest)
                    if after is not None:
                        return (*statements[:place], *after)
                    return (*statements[:place], *_stripped(one), *self.of(rest))
        return statements

    def _branched(self, one: Branch, rest: Statements) -> Statements | None:
        """Return a branch with what follows it on each way that does not end; None where that would be too much."""
        open_ = [way for way in (one.then, one.otherwise) if not _ends(way)]
        if rest and len(open_) > 1:
            self._copies += 1
            if self._copies > _MOST_COPIES:
                return None
        then, otherwise = (self.of(way if _ends(way) else (*way, *rest)) for way in (one.then, one.otherwise))
        if then or otherwise or not isinstance(one.condition, _SAYING_NOTHING):
            return (Branch(one.condition, then, otherwise, one.line),)
        return ()


def _breaks(one: Branch) -> bool:
    """Whether a way of a branch leaves the choice around."""
    return any(
        not each.again if isinstance(each, Leave) else isinstance(each, Branch) and _breaks(each)
        for each in (*one.then, *one.otherwise)
    )


def _ends(statements: Statements) -> bool:
    return any(isinstance(one, Leave | Return) for one in statements)


def _stripped(one: Branch) -> Statements:
    """Return a branch as if nothing left the choice."""
    ways = [
        tuple(
            inner
            for each in way
            if not isinstance(each, Leave) or each.again
            for inner in (_stripped(each) if isinstance(each, Branch) else (each,))
        )
        for way in (one.then, one.otherwise)
    ]
    return (Branch(one.condition, ways[0], ways[1], one.line),)

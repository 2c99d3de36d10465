"""What either way of an open condition changes in objects, lists and tables: after it they hold the one or the other.

The names of a function and the members of its own object are held by its frame. What a way changes in other objects,
by whichever function, is written down here as it is changed, so that it can be taken back for the other way.
"""

from __future__ import annotations

from typing import Any

from roslens.source.extract.domain.abstract_value import QosValue, Unknown, Value
from roslens.source.extract.domain.frame import join, one_of
from roslens.source.extract.domain.quality import one_of as one_quality
from roslens.source.extract.symbolic.text import Condition

_MISSING = object()
_ITEMS, _FEWER = object(), object()
_WHOLE = (_ITEMS, _FEWER)

Test = Condition | None
Way = dict[tuple[int, Any], tuple[Any, Any, Any]]
"""What one way changed, by its place: what holds it, under which key, and what it is at the end of the way."""


class Store:
    """What is changed while ways of open conditions are followed.

    Attributes:
        open: how many open conditions and loops are around what is evaluated.
        count: how much of it was changed in them.
        refined: what was changed under a name of several, and what it became, by its identity.
    """

    __slots__ = ("_done", "count", "open", "refined")

    def __init__(self) -> None:
        """Begin outside of any condition."""
        self.open = self.count = 0
        self.refined: dict[int, tuple[QosValue, QosValue]] = {}
        self._done: list[tuple[Any, Any, Any]] = []

    def put(self, held: dict[Any, Any], key: Any, value: Any) -> None:
        """Put a value into members of an object, or a table; what nothing was before is there after either way."""
        before = held.get(key, _MISSING) if self.open else _MISSING
        # Why a value is unknown does not matter for what it makes.
        if before is not _MISSING and (type(before) is not Unknown or type(value) is not Unknown):
            self._done.append((held, key, before))
            self.count += 1
        held[key] = value

    def refine(self, before: QosValue, after: QosValue) -> None:
        """Note what a quality of service became that may have several names."""
        if self.open:
            self._done.append((self.refined, id(before), self.refined.get(id(before), _MISSING)))
            self.count += 1
        self.refined[id(before)] = (before, after)

    def items(self, held: list[Any] | dict[Any, Any], *, less: bool = False) -> None:
        """Note that the items of a list or table are about to be changed, or with ``less`` that it may lose some."""
        if self.open:
            self._done.append((held, _FEWER if less else _ITEMS, held.copy()))
            self.count += 1

    def roll_back(self, since: int, own: Any = None) -> Way:
        """Take back what was changed since so many were, but for members of the frame's own object."""
        way: Way = {}
        mine = [one for one in self._done[since:] if one[0] is not own]
        for held, key, _ in mine:
            if (id(held), key) not in way:
                way[id(held), key] = (held, key, held.copy() if key in _WHOLE else held.get(key, _MISSING))
        for held, key, before in reversed(mine):
            _put(held, key, before)
        return way

    def merge(
        self, way: Way, since: int, own: Any, gone: tuple[bool, bool], why: tuple[Condition, Condition], test: Test
    ) -> None:
        """Let hold what either way came to: one that was taken back, and the other one.

        Args:
            way: that was taken back.
            since: how much was changed where the other one begins.
            own: members of the frame's own object.
            gone: whether the first one leaves the function or loop, and whether the other one does. What follows has
                not passed a way that leaves, but whoever comes later may have: only what that way changed is the one
                or the other.
            why: conditions of the two.
            test: what decides the first one, where that is known.
        """
        if gone == (False, True):
            other = self.roll_back(since, own)
            for held, key, value in way.values():
                _put(held, key, value)
            self._join(other, why[1], None)
            return
        if gone != (True, False):
            for held, key, before in self._done[since:]:
                if held is not own:
                    way.setdefault((id(held), key), (held, key, before))
        self._join(way, why[0], test)

    def made(self, held: Any, since: int) -> None:
        """Forget what was put into the members of an object that is new, so that neither way is without them."""
        self._done[since:] = [one for one in self._done[since:] if one[0] is not held]
        self.count = len(self._done)

    def close(self) -> None:
        """Note that an open condition or loop is behind; after the outermost one nothing is taken back any more."""
        self.open -= 1
        if not self.open and self.count:
            self.ended()

    def ended(self) -> None:
        """Note that all open conditions and loops are behind."""
        self._done.clear()
        self.count = 0

    def _join(self, way: Way, condition: Condition, test: Test) -> None:
        for held, key, value in way.values():
            if key in _WHOLE:
                self._join_items(held, value, condition, test, lost=key is _FEWER)
            elif held is self.refined:
                _join_refined(held, key, value, condition)
            elif value is not _MISSING and held.get(key) is not value:
                join(held, {key: value}, condition, test)

    def _join_items(self, held: Any, other: Any, condition: Condition, test: Test, *, lost: bool) -> None:
        if other == held:
            return
        reason = Unknown(f"an item of a list or dictionary that is changed if {condition}"[:200])
        match held:
            case dict():
                _put(held, _ITEMS, dict.fromkeys((*held, *other), reason))
                return
        both = reason if lost else self.joined(other, held, condition, test)
        match both:
            case Unknown():
                held[:] = [both] * max(len(held), len(other))
            case list() if both is not held:
                held[:] = both

    def joined(self, one: list[Value], other: list[Value], condition: Condition, test: Test) -> Value:
        """Return what is known of two lists of which a condition chooses; None where either may stand."""
        return one_of(one, other, condition, test)


def _put(held: Any, key: Any, value: Any) -> None:
    if key in _WHOLE:
        match held:
            case dict():
                held.clear()
                held.update(value)
            case _:
                held[:] = value
    elif value is _MISSING:
        held.pop(key, None)
    else:
        held[key] = value


def _join_refined(held: Any, key: Any, value: Any, condition: Condition) -> None:
    """Let what shared qualities of service became be one of two: each is kept with what it was."""
    now = held.get(key, _MISSING)
    before = (value if now is _MISSING else now)[0]
    one, other = (before if item is _MISSING else item[1] for item in (value, now))
    held[key] = (before, one_quality(one, other, condition))

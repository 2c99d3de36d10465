"""Calls that would do again what they did: heavy ones that made nothing, on the same object with equal values.

What computes or writes files may be called from hundreds of places, and from each would be followed into all that it
calls. If that made no fact of a node and gave no new callback away, it does not the next time either: what it returned,
and left in the members of its object, it returns and leaves again.
"""

from __future__ import annotations

from typing import Any

import msgspec

from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.domain.kinds import fields_of
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.ir.assigned_names import assigned_names
from roslens.source.extract.ir.program import Assign, Function, Member, Name

HEAVY = 100
"""So many steps are worth remembering; what takes fewer is followed each time."""

Key = tuple[str, int]
"""File and line of a function."""


Given = tuple[list[Any], tuple[str, ...]]
"""Arguments of a call, and its template arguments."""


class Summary:
    """What a call did.

    Attributes:
        result: what it returned.
        names: what it left in its parameters.
        cuts: functions around it that it would have called.
        site: the last call in it.
    """

    __slots__ = (
        "_after",
        "_before",
        "_depth",
        "_function",
        "_given",
        "_seen",
        "_thing",
        "cuts",
        "names",
        "result",
        "site",
    )

    def __init__(
        self,
        function: Function,
        thing: Any,
        given: Given,
        depth: int,
        frame: Frame,
        before: dict[str, Any],
        cuts: set[Key],
        site: Evidence,
    ) -> None:
        """Remember a call on ``thing`` in ``depth`` others; ``before`` is what the members of the object were."""
        self._thing = thing
        self._given = given
        self._depth = depth
        self.result = frame.result if frame.returned else None
        self.names = frame.names
        # What is asked of few calls is found out when it is asked.
        self._function, self._before = function, before
        self._after = dict(fields_of(thing))
        self._seen: dict[str, Any] | None = None
        self.cuts = cuts
        self.site = site

    def fits(self, thing: Any, given: Given, stack: list[Key]) -> bool:
        """Whether a call would do the same: why values are unknown does not matter for what it makes."""
        return (
            self._thing is thing
            and self._depth <= len(stack)
            and self._given[1] == given[1]
            and len(self._given[0]) == len(given[0])
            and all(map(same, self._given[0], given[0]))
            and self.cuts.issubset(stack)
            and self._sees_the_same(thing)
        )

    @property
    def fields(self) -> dict[str, Any]:
        """What it left in the members of its object that it assigns, or that were another before."""
        own, before = assigned_names(self._function.body), self._before
        return {
            name: value
            for name, value in self._after.items()
            if name in own or name not in before or before[name] is not value
        }

    def _sees_the_same(self, thing: Any) -> bool:
        if self._seen is None:
            named = _names(self._function.body)
            self._seen = {name: value for name, value in self._before.items() if name in named}
        fields = fields_of(thing)
        return all(name in fields and same(value, fields[name]) for name, value in self._seen.items())


class Summaries:
    """The heavy calls of an evaluation that made nothing.

    Attributes:
        touched: how often a word of the vocabulary was said, or a callback given away.
        cuts: functions that the current call would call, were they not around it.
    """

    def __init__(self) -> None:
        """Begin without any."""
        self.touched = 0
        self.cuts: set[Key] = set()
        self._done: dict[Key, list[Summary]] = {}

    def known(self, key: Key, thing: Any, given: Given, stack: list[Key]) -> Summary | None:
        """Return what a call did that would do the same again; None where there was none."""
        for one in self._done.get(key, ()):
            if one.fits(thing, given, stack):
                self.cuts |= one.cuts
                return one
        return None

    def touch(self) -> None:
        """Note that a word of the vocabulary is said, or a callback given away."""
        self.touched += 1

    def forget_all(self) -> None:
        """Forget what calls did: what all functions see is changed."""
        self.touched += 1
        self._done.clear()

    def keep(self, key: Key, done: Summary) -> None:
        """Remember what a call did."""
        self._done.setdefault(key, []).append(done)


def _names(one: Any) -> set[str]:
    """Return the last names of all that statements name, but for what they only assign."""
    found: set[str] = set()
    waiting = [one]
    while waiting:
        one = waiting.pop()
        match one:
            case tuple():
                waiting += one
            case Assign(target=Name()) if one.operator == "=":
                waiting.append(one.value)
            case Name() | Member():
                found.add(one.name)
                waiting += msgspec.structs.astuple(one)
            case msgspec.Struct():
                waiting += msgspec.structs.astuple(one)
    return found


def same(one: Any, other: Any) -> bool:
    """Whether values make the same: why they are unknown does not matter."""
    match one, other:
        case Unknown(), Unknown():
            return True
    return one is other or (type(one) is type(other) and bool(one == other))

"""An entity that is judged: its constraints, how they stand, and when to look again."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from roslens.live.standing.ready_constraint import ReadyConstraint
from roslens.live.standing.standing import Standing
from roslens.live.standing.verdict_state import NEVER
from roslens.live.window.traffic import MEASURES
from roslens.live.window.window import Window
from roslens.model.entity import EntityId
from roslens.model.verdict import State, Verdict


class Judged(Standing):
    """A constraint about a signal of an entity.

    Attributes:
        constraint: that is judged.
        at: number of the window that it takes.
        group: of the constraints that take the same value.
    """

    __slots__ = ("at", "constraint", "group")

    def __init__(self, entity: EntityId, constraint: ReadyConstraint, now: float) -> None:
        super().__init__(entity, constraint.details, constraint.key, constraint.written, now)
        self.constraint = constraint
        self.at = 0
        self.group: Group | None = None

    def forget(self, now: float, state: State) -> None:
        """Begin anew in ``state``, because time itself broke."""
        super().forget(now, state)
        if self.group is not None:
            self.group.calm = self.group.entity.calm = False

    def verdict(self) -> Verdict:
        """Return how it stands, for others to read."""
        group = self.group
        if group is not None and group.calm:
            self.state.value, self.state.time, self.window = group.value, group.entity.looked, group.window
        verdict = super().verdict()
        remark = group.entity.remark(self.quantity, self.at) if group is not None else ""
        return msgspec.structs.replace(verdict, evidence=verdict.evidence + remark) if remark else verdict


class Group:
    """Constraints about one entity that take the same value, so that one look tells whether all are fine still.

    Attributes:
        entity: that is judged.
        key: of the signal.
        measure: that takes it from a window; None where windows do not tell it.
        at: number of the window.
        percentile: of the values in the window, 0 for the window itself.
        low: the highest of the lower bounds.
        high: the lowest of the upper bounds.
        judged: the constraints.
        calm: whether all are ok, and stay so as long as the value is between both.
        value: at the last look at a calm group.
        window: that showed it.
    """

    __slots__ = ("at", "calm", "entity", "high", "judged", "key", "low", "measure", "percentile", "value", "window")

    def __init__(self, entity: Measured, judged: list[Judged]) -> None:
        first = judged[0]
        self.entity = entity
        self.measure = MEASURES.get(first.constraint.key)
        self.key, self.at, self.percentile = first.constraint.key, first.at, first.constraint.percentile
        self.low = max(one.constraint.bounds.low for one in judged)
        self.high = min(one.constraint.bounds.high for one in judged)
        self.judged = judged
        self.calm = False
        self.value = 0.0
        self.window: Window | None = None
        for one in judged:
            one.group = self

    def settle(self) -> float:
        """Find out whether all are calm; return when one of them may change without news."""
        due = min(one.state.due for one in self.judged)
        self.calm = due == NEVER and all(one.state.state is State.OK for one in self.judged)
        return due


class Measured:
    """An entity with signals.

    Attributes:
        id: of the entity.
        judged: constraints about it.
        groups: these by the value that they take.
        looked: when it was judged last.
        calm: whether everything about it was fine when it was judged last.
        appeared: from when grace counts.
        due: when it has to be judged again without any news; NEVER where only news can change it.
        planned: the earliest time at which it waits in the queue.
        seen: whether it was ever there.
        planless: whether its constraints have to be looked up again.
        waiting: whether it waits to be judged in the next tick.
    """

    __slots__ = (
        "appeared",
        "calm",
        "due",
        "groups",
        "id",
        "judged",
        "looked",
        "planless",
        "planned",
        "seen",
        "waiting",
    )

    def __init__(self, entity: EntityId, now: float) -> None:
        self.id = entity
        self.judged: list[Judged] = []
        self.groups: list[Group] = []
        self.looked = -NEVER
        self.appeared = now
        self.due = self.planned = NEVER
        self.seen = False
        self.planless = True
        self.waiting = False
        self.calm = False

    def remark(self, key: str, at: int) -> str:  # noqa: ARG002 - most entities have nothing to say
        """Return what is to be said beside the value of a signal over a window; empty where nothing is."""
        return ""

    def resume(self, time: float) -> None:
        """Be judged again from ``time``: earlier data is no evidence about later data."""
        self.appeared = self.due = time

    def adopt(self, constraints: Iterable[ReadyConstraint], now: float) -> list[Judged]:
        """Be judged by these constraints from now on; return those judged no more. Unchanged ones keep their state."""
        self.planless = False
        old = {id(judged.constraint): judged for judged in self.judged}
        self.judged = []
        for constraint in constraints:
            kept = old.pop(id(constraint), None) or Judged(self.id, constraint, now)
            kept.details = constraint.details
            self.judged.append(kept)
        return list(old.values())

    def gather(self) -> None:
        """Group the constraints by the value they take."""
        groups: dict[tuple[str, int, float], list[Judged]] = {}
        for one in self.judged:
            groups.setdefault((one.constraint.key, one.at, one.constraint.percentile), []).append(one)
        self.groups = [Group(self, judged) for judged in groups.values()]
        self.calm = False

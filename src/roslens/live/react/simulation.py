"""What a reactor would have decided over recorded or scripted steps, with nothing done."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import msgspec

from roslens.judge.reading.read_time_line import Expected, TimeLine
from roslens.live.join.session import Step
from roslens.live.react.reactor import Reactor
from roslens.live.react.scripted import BEFORE_S, scripted_steps
from roslens.model.acting.reaction import Checked, Decision, Outcome, Reaction, Result
from roslens.model.entity import EntityId


class Compared(msgspec.Struct, frozen=True):
    """Decisions that had to be made and were not, and those that were made and should not have been."""

    missing: tuple[Expected, ...] = ()
    surplus: tuple[Decision, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether all is as expected."""
        return not self.missing and not self.surplus


class Simulation:
    """Takes steps, and pretends that what is decided is done.

    Attributes:
        decisions: that were made, in their order.
        checks: what was found out about whether they helped.
        withheld: why reactions whose condition was true did nothing: the first instant, by reaction, entity and reason.
    """

    def __init__(
        self, reactions: Sequence[Reaction], *, start: float, results: Mapping[str, Result] | None = None
    ) -> None:
        """Begin at ``start``; ``results`` are the results of actions by kind; all others count as dry runs."""
        self.decisions: list[Decision] = []
        self.checks: list[Checked] = []
        self.withheld: dict[tuple[str, str, str], float] = {}
        self._reactor = Reactor(reactions, start=start)
        self._results = results or {}

    def take(self, step: Step) -> list[Decision]:
        """Take a step; return what is due."""
        found = self._reactor.look(step, step.time)
        for decision in found:
            result = self._results.get(decision.action.kind, Result.DRY_RUN)
            self._reactor.reported(decision.id, Outcome(result))
        self.decisions += found
        self.checks += self._reactor.checks()
        for (reaction, entity), reason in self._reactor.withheld.items():
            self.withheld.setdefault((reaction, entity, reason), step.time)
        return found


def simulate(reactions: Sequence[Reaction], line: TimeLine) -> Simulation:
    """Return what would have been decided along a time line."""
    simulation = Simulation(reactions, start=-BEFORE_S, results=line.results)
    for step in scripted_steps(line):
        simulation.take(step)
    return simulation


def compare(decisions: Iterable[Decision], expected: Iterable[Expected]) -> Compared:
    """Hold decisions against what is expected; each is used once, the nearest in time first."""
    left = list(decisions)
    missing = []
    for one in expected:
        fitting = [decision for decision in left if _fits(one, decision)]
        if not fitting:
            missing.append(one)
            continue
        left.remove(min(fitting, key=lambda decision: abs(decision.at_s - one.at_s)))
    return Compared(tuple(missing), tuple(left))


def _fits(expected: Expected, decision: Decision) -> bool:
    names = ("", decision.reaction, decision.reaction.partition(".")[2])
    return (
        abs(decision.at_s - expected.at_s) <= expected.within_s + 1e-6
        and expected.reaction in names
        and expected.action in ("", decision.action.kind)
        and expected.entity in ("", decision.entity)
        and expected.target in ("", _text(decision.action.target))
    )


def _text(entity: EntityId | None) -> str:
    return "" if entity is None else str(entity)

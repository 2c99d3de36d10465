"""Alarms: from when to when something was wrong, made from the verdicts that changed."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from roslens.model.verdict import State, Verdict


class Alarm(msgspec.Struct, frozen=True):
    """One stretch in which one constraint was broken of one entity.

    Attributes:
        first: the verdict with which it began.
        worst: the verdict of the worst state in it.
        since: when the fault began, in seconds.
        reported: when that was known.
        until: when it was over; infinity while it lasts.
    """

    first: Verdict
    worst: Verdict
    since: float
    reported: float
    until: float = float("inf")


_ORDER = {state: place for place, state in enumerate(State)}


class AlarmLog:
    """Collects verdicts that changed."""

    def __init__(self) -> None:
        self._open: dict[tuple[str, str], Alarm] = {}
        self._over: list[Alarm] = []

    def add(self, changes: Iterable[Verdict]) -> None:
        """Take the changes of a step."""
        for verdict in changes:
            key = (str(verdict.entity), verdict.expectation)
            alarm = self._open.get(key)
            if verdict.state.bad and alarm is None:
                self._open[key] = Alarm(verdict, verdict, verdict.since, verdict.time)
            elif verdict.state.bad and alarm is not None:
                # From low to absent it is the same fault, which has become worse.
                worse = _ORDER[verdict.state] > _ORDER[alarm.worst.state]
                self._open[key] = msgspec.structs.replace(alarm, worst=verdict if worse else alarm.worst)
            elif alarm is not None:
                self._over.append(msgspec.structs.replace(self._open.pop(key), until=verdict.since))

    def alarms(self) -> tuple[Alarm, ...]:
        """Return all of them, by when they began."""
        return tuple(sorted([*self._over, *self._open.values()], key=_when))


def _when(alarm: Alarm) -> tuple[float, str, str]:
    return alarm.since, str(alarm.first.entity), alarm.first.expectation

"""When which entity has to be looked at without any news."""

from __future__ import annotations

import heapq

from roslens.live.standing.measured import Measured
from roslens.live.standing.verdict_state import NEVER

_PER_SECOND = 20
"""Entities that are due within the same stretch wait together."""
_FAR = 2.0**60


def _stretch(time: float) -> int:
    number = time * _PER_SECOND
    if -_FAR < number < _FAR:
        return int(number)
    return int(_FAR if number > 0 else -_FAR)


class DueQueue:
    """Entities by their due time; each waits at most about once, however often its due time moves."""

    def __init__(self) -> None:
        self._stretches: dict[int, list[Measured]] = {}
        self._numbers: list[int] = []

    @property
    def first(self) -> float:
        """When the first one may be due; infinity when none is."""
        if not self._numbers:
            return NEVER
        return min(one.planned for one in self._stretches[self._numbers[0]])

    def put(self, entity: Measured) -> None:
        """Let an entity wait until its ``due``; a later due time costs nothing."""
        due = entity.due
        if due < entity.planned:
            entity.planned = due
            number = _stretch(due)
            waiting = self._stretches.get(number)
            if waiting is None:
                self._stretches[number] = [entity]
                heapq.heappush(self._numbers, number)
            else:
                waiting.append(entity)

    def take(self, now: float) -> list[Measured]:
        """Return the entities that are due, each once."""
        found: list[Measured] = []
        moved: list[Measured] = []
        again: dict[int, list[Measured]] = {}
        numbers = self._numbers
        while numbers and numbers[0] <= now * _PER_SECOND:
            number = heapq.heappop(numbers)
            early = self._sort_out(number, now, found, moved)
            if early:
                again[number] = early
        for number, early in again.items():
            self._stretches[number] = early
            heapq.heappush(numbers, number)
        for entity in moved:
            self.put(entity)
        return found

    def _sort_out(self, number: int, now: float, found: list[Measured], moved: list[Measured]) -> list[Measured]:
        """Take a stretch apart: what is due is found, what is due in another one moved, and the rest returned."""
        early: list[Measured] = []
        for entity in self._stretches.pop(number):
            planned, due = entity.planned, entity.due
            if planned == NEVER or _stretch(planned) != number:
                continue
            if due > now and _stretch(due) == number:
                entity.planned = due
                early.append(entity)
                continue
            entity.planned = NEVER
            (found if due <= now else moved).append(entity)
        return early

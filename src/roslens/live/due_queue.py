"""When which entity has to be looked at without any news."""

from __future__ import annotations

import heapq
from itertools import count

from roslens.live.measured import Measured
from roslens.live.verdict_state import NEVER


class DueQueue:
    """Entities by their due time; each waits at most about once, however often its due time moves."""

    def __init__(self) -> None:
        self._heap: list[tuple[float, int, Measured]] = []
        self._number = count()

    @property
    def first(self) -> float:
        """When the first one may be due; infinity when none is."""
        return self._heap[0][0] if self._heap else NEVER

    def put(self, entity: Measured) -> None:
        """Let an entity wait until its ``due``; a later due time costs nothing."""
        if entity.due < entity.planned:
            entity.planned = entity.due
            heapq.heappush(self._heap, (entity.due, next(self._number), entity))

    def take(self, now: float) -> list[Measured]:
        """Return the entities that are due, each once."""
        heap = self._heap
        found: list[Measured] = []
        while heap and heap[0][0] <= now:
            at, _, entity = heapq.heappop(heap)
            if at != entity.planned:
                continue
            entity.planned = NEVER
            if entity.due <= now:
                found.append(entity)
            else:
                self.put(entity)
        return found

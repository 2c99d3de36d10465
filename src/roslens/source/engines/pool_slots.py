"""What the workers of a pool have in hand, so that a file that ends one can be named."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ProcessPoolExecutor
from typing import TYPE_CHECKING, TypeVar

from roslens.intake.file_budget import Slot, share_memory, watch, why_ended
from roslens.source.engines.task_limits import TaskLimits, run_limited

if TYPE_CHECKING:
    from multiprocessing.process import BaseProcess

Task = TypeVar("Task")
Result = TypeVar("Result")

_shared: list[Slot] = []
"""Of the pool that runs: its workers are copies of this process, and have it from there."""


class PoolSlots:
    """A part of shared memory for each task that is under way in a pool."""

    def __init__(self, number: int) -> None:
        """Have room for so many tasks at once."""
        # One is free again a moment after its task is done.
        number *= 2
        self._slots = Slot(number)
        self._free = list(range(number))
        self._workers: dict[int, BaseProcess] = {}
        self._number = number
        _shared[:] = [self._slots]

    def submit(
        self, pool: ProcessPoolExecutor, function: Callable[[Task], Result], limits: TaskLimits, task: Task
    ) -> Future[Result]:
        """Give a task to the pool.

        Raises:
            BrokenProcessPool: a worker has died.
        """
        number = self._free.pop()
        future = pool.submit(_in_slot, number, function, limits, task)
        future.add_done_callback(lambda _: self._free.append(number))
        self._workers.update(getattr(pool, "_processes", None) or {})
        return future

    def exceeded(self) -> dict[str, str]:
        """Return what the workers had in hand that the kernel ended, each with the reason."""
        found = {}
        for number in range(self._number):
            pid, subject = self._slots.of(number).get()
            worker = self._workers.get(pid)
            if subject and worker is not None and (why := why_ended(worker.exitcode or 0)):
                found[subject] = why
        return found


def _in_slot(number: int, function: Callable[[Task], Result], limits: TaskLimits, task: Task) -> Result:
    """Run a task in a worker whose parent sees what it has in hand."""
    if _shared:
        watch(_shared[0].of(number))
        share_memory(limits.jobs)
    return run_limited(function, limits, task)

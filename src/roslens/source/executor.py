"""Where work runs: in this process or in a pool of processes, behind one seam.

Work is a list of independent tasks; results come back in the order in which they are done. A pool
that loses a worker (killed, out of memory) says which task it was and goes on with the others.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from typing import Protocol, TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")


class Executor(Protocol):
    """Runs a function over tasks and yields ``(task, result)`` or ``(task, error)``."""

    def run(
        self, function: Callable[[Task], Result], tasks: Sequence[Task]
    ) -> Iterator[tuple[Task, Result | BaseException]]:
        """Yield each task with its result, or with the exception that ended it."""


class InProcess:
    """One task after another, here. What tests and ``--jobs 1`` use."""

    def run(
        self, function: Callable[[Task], Result], tasks: Sequence[Task]
    ) -> Iterator[tuple[Task, Result | BaseException]]:
        """Yield each task with its result, or with the exception that ended it."""
        for task in tasks:
            try:
                yield task, function(task)
            except Exception as error:  # noqa: BLE001 - one task's error is a result, the others go on
                yield task, error


class ProcessPool:
    """Worker processes, started when the first task is there."""

    def __init__(self, jobs: int) -> None:
        """Use ``jobs`` worker processes (at least one)."""
        self.jobs = max(1, jobs)

    def run(
        self, function: Callable[[Task], Result], tasks: Sequence[Task]
    ) -> Iterator[tuple[Task, Result | BaseException]]:
        """Yield each task with its result, or with the exception that ended it.

        When a worker dies, the tasks that were under way run again one by one in pools of their
        own, so that only the task that kills its worker is lost.
        """
        lost: list[Task] = []
        yield from self._run_pool(function, tasks, lost)
        for task in lost:
            again: list[Task] = []
            yield from ProcessPool(1)._run_pool(function, [task], again)  # noqa: SLF001 - the same class
            if again:
                yield task, RuntimeError("the worker process died twice on this task")

    def _run_pool(
        self, function: Callable[[Task], Result], tasks: Sequence[Task], lost: list[Task]
    ) -> Iterator[tuple[Task, Result | BaseException]]:
        from concurrent.futures import as_completed
        from concurrent.futures.process import BrokenProcessPool

        from roslens.children.worker_pool import worker_pool
        from roslens.intake.held_signals import held_signals

        with worker_pool(min(self.jobs, len(tasks)) or 1, "forkserver" if os.name == "posix" else "spawn") as pool:
            # A worker that an interrupt catches while it is begun is not known yet, and would not be ended.
            with held_signals():
                futures = {pool.submit(function, task): task for task in tasks}
            for future in as_completed(futures):
                task = futures.pop(future)
                try:
                    yield task, future.result()
                except BrokenProcessPool:
                    lost.append(task)
                except Exception as error:  # noqa: BLE001 - one task's error is a result, the others go on
                    yield task, error


def executor_for(jobs: int) -> Executor:
    """Return what runs ``jobs`` tasks at once; 0 means one per processor."""
    wanted = jobs or os.cpu_count() or 1
    return InProcess() if wanted == 1 else ProcessPool(wanted)

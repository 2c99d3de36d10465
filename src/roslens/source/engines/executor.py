"""Where work runs: in this process, in a pool of processes, or on a cluster, behind one seam.

Work is a list of independent tasks; results come back in the order in which they are done. An engine holds only as many
tasks and results as its workers keep busy with (back-pressure), and one that loses a worker (killed, out of memory, out
of time) runs its task again elsewhere; a task that ends its worker twice is lost, and said to be, and the others go on.
"""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

import msgspec

from roslens.intake.file_budget import most_jobs, refuse, refused
from roslens.model.errors import UsageError
from roslens.source.engines.task_engine import Executor, Result, Task
from roslens.source.engines.task_limits import TaskLimits, died_twice

if TYPE_CHECKING:
    from concurrent.futures import Future

    from roslens.children.worker_pool import Method
    from roslens.source.engines.cluster_ahead import ClusterAhead

ENGINES = ("in-process", "processes")
"""Names of engines; besides, the address of a scheduler is one."""

_AHEAD = 2
"""Tasks that wait for each worker, so that none waits for this process."""


class InProcess:
    """One task after another, here. What tests and ``--jobs 1`` use; no limits, for this process is the user's."""

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

    def __init__(self, jobs: int, limits: TaskLimits | None = None) -> None:
        """Use ``jobs`` worker processes (at least one), each within the limits and its share of the memory."""
        self.jobs = max(1, jobs)
        self.limits = limits or TaskLimits()

    def run(
        self, function: Callable[[Task], Result], tasks: Sequence[Task]
    ) -> Iterator[tuple[Task, Result | BaseException]]:
        """Yield each task with its result, or with the exception that ended it.

        When a worker dies on a file that exceeds its budget, that file is left out from then on. The tasks that were
        under way run again one by one in pools of their own, so that only a task that kills its worker twice without
        such a file is lost; those that had not begun go on in a new pool.
        """
        waiting = list(tasks)
        while waiting:
            lost: list[Task] = []
            done, waiting = waiting, []
            yield from self._run_pool(function, done, lost, waiting)
            for task in lost:
                yield from self._run_alone(function, task)

    def _run_alone(
        self, function: Callable[[Task], Result], task: Task
    ) -> Iterator[tuple[Task, Result | BaseException]]:
        single = ProcessPool(1, msgspec.structs.replace(self.limits, jobs=self.jobs))
        while True:
            left_out = len(refused())
            again: list[Task] = []
            yield from single._run_pool(function, [task], again, again)
            if not again:
                return
            if len(refused()) == left_out:
                yield task, died_twice(self.limits)
                return

    def _run_pool(
        self, function: Callable[[Task], Result], tasks: Sequence[Task], lost: list[Task], left: list[Task]
    ) -> Iterator[tuple[Task, Result | BaseException]]:
        """Run tasks in one pool; where it breaks, ``lost`` gets those under way and ``left`` the others."""
        from concurrent.futures import FIRST_COMPLETED, wait
        from concurrent.futures.process import BrokenProcessPool

        from roslens.children.worker_pool import worker_pool
        from roslens.intake.held_signals import held_signals
        from roslens.source.engines.pool_slots import PoolSlots

        limits = msgspec.structs.replace(self.limits, jobs=self.limits.jobs or self.jobs)
        coming = iter(tasks)
        slots = PoolSlots(self.jobs * (1 + _AHEAD))
        with worker_pool(min(self.jobs, len(tasks)) or 1, _method()) as pool:
            futures: dict[Future[Result], Task] = {}
            broken = False
            while True:
                # A worker that an interrupt catches while it is begun is not known yet, and would not be ended.
                with held_signals():
                    submit = partial(slots.submit, pool, function, limits)
                    broken = broken or self._submit(submit, coming, futures, left)
                if not futures:
                    break
                for future in wait(futures, return_when=FIRST_COMPLETED).done:
                    task = futures.pop(future)
                    try:
                        yield task, future.result()
                    except BrokenProcessPool:
                        lost.append(task)
                        broken = True
                    except Exception as error:  # noqa: BLE001 - one task's error is a result, the others go on
                        yield task, error
            left.extend(coming)
        if broken:
            refuse(slots.exceeded())

    def _submit(
        self,
        submit: Callable[[Task], Future[Result]],
        coming: Iterator[Task],
        futures: dict[Future[Result], Task],
        left: list[Task],
    ) -> bool:
        """Keep the workers of a pool busy; return whether it is broken, and ``left`` has the task that it refused."""
        from concurrent.futures.process import BrokenProcessPool

        while len(futures) < self.jobs * (1 + _AHEAD):
            task = next(coming, None)
            if task is None:
                break
            try:
                futures[submit(task)] = task
            except BrokenProcessPool:
                left.append(task)
                return True
        return False


def _method() -> Method:
    """Return how workers are started: a copy of this process has imported all that they need.

    One of several threads may hold a lock that a copy would wait for; what macOS itself runs does not survive a fork.
    """
    if os.name != "posix":
        return "spawn"
    return "fork" if sys.platform == "linux" and threading.active_count() == 1 else "forkserver"


def is_cluster(engine: str) -> bool:
    """Return whether an engine is the address of a scheduler."""
    return engine.startswith(("tcp://", "tls://"))


def executor_for(jobs: int, engine: str | ClusterAhead = "", *, folder: str = "", useful: int = 0) -> Executor:
    """Return what runs tasks.

    Args:
        jobs: how many at once; 0 means one per processor. A cluster has as many as it has threads.
        engine: one of :data:`ENGINES`, the address of a scheduler (``tcp://…`` or ``tls://…``), or empty for what fits
            ``jobs``; or a cluster that is being connected to already.
        folder: that workers of a cluster have to see, as this process does; empty for none.
        useful: more worker processes than this are not worth starting; 0 for any number.

    Raises:
        UsageError: there is no such engine.
    """
    # Each has its share of the memory, and none less than what a file may take.
    wanted = min(jobs or os.cpu_count() or 1, most_jobs())
    address = engine if isinstance(engine, str) else engine.address
    if is_cluster(address):
        from roslens.source.engines.dask_engine import DaskEngine

        connection = None if isinstance(engine, str) else engine.client
        return DaskEngine(address, folder=folder, rest=ProcessPool(wanted), connection=connection)
    if engine not in ("", *ENGINES):
        raise UsageError(
            f"engine {engine!r}",
            expected=f"one of {', '.join(ENGINES)}, or the address of a scheduler of Dask, as tcp://host:8786",
        )
    if engine == "in-process" or (wanted == 1 and not engine):
        return InProcess()
    return ProcessPool(min(wanted, useful or wanted))

"""Processes that read for the threads of a worker of a cluster: a file that ends one costs neither worker nor package.

No process watches a worker of a cluster for the files that it reads, and in its threads neither a signal nor the
kernel interrupts what takes too long. So each thread that has work lends a process that it watches.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any, TypeVar

from roslens.intake.file_budget import share_memory
from roslens.source.engines.task_limits import TaskLimits, died_twice, run_limited
from roslens.source.engines.watched_reader import LostReaderError, WatchedReader

Task = TypeVar("Task")
Result = TypeVar("Result")

IDLE_S = 60.0
"""Without work for so long, a process ends; the worker, which may be others' as well, goes on without it."""

_idle: list[WatchedReader] = []


@contextmanager
def lent_reader(root: str) -> Iterator[WatchedReader]:
    """Lend a process that reads, which no other thread has meanwhile.

    Args:
        root: folder to which paths of files are relative.
    """
    try:
        reader = _idle.pop()
    except IndexError:
        reader = WatchedReader(idle_s=IDLE_S)
    reader.root = root
    try:
        yield reader
    finally:
        _idle.append(reader)


def ask_limited(reader: WatchedReader, function: Callable[[Task], Result], limits: TaskLimits, task: Task) -> Result:
    """Return what a function makes of a task in a process that reads; where it loses the process, in another one.

    Raises:
        RuntimeError: the task ended both.
        Exception: whatever the function raises.
    """
    work: Callable[[], Result] = partial(reader.ask, _limited, function, limits, task)
    with suppress(LostReaderError):
        return work()
    try:
        return work()
    except LostReaderError as error:
        raise died_twice(limits) from error


def make_readers_ready(prepare: Callable[[], None], dask_worker: Any = None) -> None:
    """Start the processes of a worker, and have each prepare itself while the worker waits for work.

    Args:
        prepare: is called in each of them.
        dask_worker: the worker, which Dask passes by this name.
    """
    # In this thread, which goes on: they end with the one that starts them.
    while len(_idle) < dask_worker.state.nthreads:
        reader = WatchedReader(idle_s=IDLE_S)
        reader.start()
        _idle.append(reader)
        threading.Thread(target=_prepared, args=(reader, prepare), name="prepare", daemon=True).start()


def _prepared(reader: WatchedReader, prepare: Callable[[], None]) -> None:
    # What fails here fails again in the first task, which tells it.
    with suppress(Exception):
        reader.ask(prepare)


def _limited(function: Callable[[Task], Result], limits: TaskLimits, task: Task) -> Result:
    share_memory(limits.jobs)
    return run_limited(function, limits, task)

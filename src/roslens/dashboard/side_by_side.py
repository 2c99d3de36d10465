"""The same for many tasks, by several processes at once, each a copy of this one that knows all that this one knows."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

Task = TypeVar("Task")

FEWEST = 200
"""Fewer tasks than this are done sooner than processes are started."""

_BATCH = 24


def each(work: Callable[[Task], None], tasks: Sequence[Task], jobs: int) -> Iterator[Task]:
    """Do ``work`` for every task and yield each when it is done; with several processes in no certain order.

    Args:
        work: what it leaves behind must be in files: what it changes in memory is lost.
        tasks: neighbours are done by the same process as far as possible.
        jobs: so many processes; 0 is one per processor. Where a system copies no processes, this one does all.

    Raises:
        Exception: what ``work`` raised; some of the others are then done, others not.
    """
    wanted = jobs or os.cpu_count() or 1
    if wanted > 1 and len(tasks) >= FEWEST and sys.platform == "linux":
        yield from _by_copies(work, tasks, wanted)
        return
    for task in tasks:
        work(task)
        yield task


def _by_copies(work: Callable[[Task], None], tasks: Sequence[Task], jobs: int) -> Iterator[Task]:
    from concurrent.futures import as_completed
    from concurrent.futures.process import BrokenProcessPool

    from roslens.children.worker_pool import worker_pool

    # The one way to hand copies of this process what cannot be written down.
    global _share

    def share(first: int) -> None:
        for task in tasks[first : first + _BATCH]:
            work(task)

    _share = share
    lost: list[int] = []
    try:
        with worker_pool(jobs, "fork") as pool:
            futures = {pool.submit(_do_share, first): first for first in range(0, len(tasks), _BATCH)}
            for future in as_completed(futures):
                first = futures[future]
                try:
                    future.result()
                except BrokenProcessPool:
                    # A process was killed, for want of memory as a rule: one alone needs less.
                    lost.append(first)
                    continue
                yield from tasks[first : first + _BATCH]
    finally:
        _share = None
    for first in sorted(lost):
        share(first)
        yield from tasks[first : first + _BATCH]


_share: Callable[[int], None] | None = None


def _do_share(first: int) -> None:
    if _share is not None:
        _share(first)

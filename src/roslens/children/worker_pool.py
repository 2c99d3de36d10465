"""A pool of worker processes: safe to start in any folder, gone when the process that made it is."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from typing import Literal

from roslens.children.lifeline import leave_interrupts, watch_parent
from roslens.children.safe_path import elsewhere

Method = Literal["fork", "forkserver", "spawn"]


def worker_pool(jobs: int, method: Method) -> ProcessPoolExecutor:
    """Return a pool of ``jobs`` workers that are started by ``method``.

    The helper processes of ``multiprocessing`` are started here, in a neutral folder: later they would be started in
    the current one, and import what lies there.
    """
    import multiprocessing
    import multiprocessing.resource_tracker

    with elsewhere():
        if method != "spawn":
            multiprocessing.resource_tracker.ensure_running()
        if method == "forkserver":
            from multiprocessing import forkserver

            forkserver.ensure_running()
        return ProcessPoolExecutor(jobs, mp_context=multiprocessing.get_context(method), initializer=_begin)


def _begin() -> None:
    leave_interrupts()
    watch_parent()

"""A pool of worker processes: safe to start in any folder, gone when the process that made it is."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager, suppress
from typing import Literal

from roslens.children.lifeline import leave_interrupts, watch_parent
from roslens.children.safe_path import elsewhere
from roslens.children.scratch_folder import ScratchFolder

Method = Literal["fork", "forkserver", "spawn"]

_LONGEST_FOLDER = 107 - len("/listener-abcdefgh")
"""Bytes of the path of a folder of sockets, whose paths may have 107; multiprocessing gives it a shorter name."""


@contextmanager
def worker_pool(jobs: int, method: Method) -> Iterator[ProcessPoolExecutor]:
    """Lend a pool of ``jobs`` workers that are started by ``method``; where the block ends by an error, so do they.

    The helper processes of ``multiprocessing`` are started here, in a neutral folder: later they would be started in
    the current one, and import what lies there.
    """
    import multiprocessing

    with elsewhere():
        _own_temporary_folder()
        if method == "forkserver":
            from multiprocessing import forkserver, resource_tracker

            resource_tracker.ensure_running()
            # Only this one: the tracker sees to it itself, and lets interrupts through again.
            with _without_interrupts():
                forkserver.ensure_running()
        pool = ProcessPoolExecutor(jobs, mp_context=multiprocessing.get_context(method), initializer=_begin)
    try:
        yield pool
    except BaseException:
        # An interrupt is left to this process, so what workers are at has to be ended here.
        for worker in list((getattr(pool, "_processes", None) or {}).values()):
            worker.kill()
        pool.shutdown(wait=True, cancel_futures=True)
        raise
    pool.shutdown(wait=True)


def _own_temporary_folder() -> None:
    """Keep sockets of ``multiprocessing`` in a folder that the next run removes where this process is killed."""
    from multiprocessing import process, util

    # multiprocessing makes one of its own, which tells nothing of its owner, unless this is set.
    config: dict[str, str | None] = getattr(process.current_process(), "_config", {})
    before = config.get("tempdir")
    if before is not None:
        # What cleans up temporary folders of a machine may have removed one that was long unused.
        if os.path.isdir(before):  # noqa: PTH112 - a text
            return
        config["tempdir"] = None
        _stop_server()
    folder = ScratchFolder("mp")
    if len(os.fsencode(folder.name)) > _LONGEST_FOLDER:
        folder.cleanup()
        return
    config["tempdir"] = folder.name
    util.Finalize(None, folder.cleanup, exitpriority=-100)


def _stop_server() -> None:
    """End the server that starts workers: nobody reaches it any more, as its socket is gone."""
    from multiprocessing import forkserver

    stop = getattr(getattr(forkserver, "_forkserver", None), "_stop", None)
    if stop is not None:
        with suppress(FileNotFoundError):
            stop()


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Have processes that are started meanwhile ignore interrupts, on which Python would print a traceback."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _begin() -> None:
    for name in ("SIGTERM", "SIGHUP", "SIGUSR2"):
        # What this process does about them is not for its copies, which the pool ends by them.
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_DFL)
    leave_interrupts()
    watch_parent()

"""A child process ends with the one that started it, however that one ended."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from collections.abc import Sequence
from functools import cache

_PR_SET_PDEATHSIG = 1

_SETPRIV, _SHELL = "/usr/bin/setpriv", "/bin/sh"
_STILL_CHILD = 'test "$PPID" = "$0" && exec "$@"'
"""The parent may be gone before the kernel is told to end its child with it."""


def end_with_parent(parent: int = 0) -> None:
    """Have the kernel end this process when the one that started it is gone; Linux only, elsewhere nothing.

    Args:
        parent: its process number, to see that it is not gone already; 0 where that is not known.
    """
    if sys.platform != "linux":
        return
    import ctypes

    with contextlib.suppress(OSError, AttributeError):
        ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
    if parent and os.getppid() != parent:
        os._exit(1)


def words_with_lifeline(words: Sequence[str]) -> list[str] | None:
    """Return the command that runs ``words`` so that they end with this process; None if the system has none.

    It takes two milliseconds, a Python that calls :func:`end_with_parent` first twenty.
    """
    if not _has_setpriv():
        return None
    return [_SETPRIV, "--pdeathsig", "KILL", _SHELL, "-c", _STILL_CHILD, str(os.getpid()), *words]


@cache
def _has_setpriv() -> bool:
    return sys.platform == "linux" and all(os.access(path, os.X_OK) for path in (_SETPRIV, _SHELL))


def watch_parent() -> None:
    """End this process of a ``multiprocessing`` pool once the process that made the pool is gone.

    A worker waits for tasks on a queue whose other end its siblings hold open, so it would wait for ever. The death of
    its direct parent does not do: that is the forkserver, or a thread.
    """
    import multiprocessing
    import threading
    from multiprocessing.connection import wait

    parent = multiprocessing.parent_process()
    if parent is None:
        return

    def wait_for_end(sentinel: int) -> None:
        wait([sentinel])
        os._exit(1)

    threading.Thread(target=wait_for_end, args=(parent.sentinel,), name="lifeline", daemon=True).start()


def leave_interrupts() -> None:
    """Leave an interrupt of the terminal, which reaches all processes, to the one that waits for this one."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)

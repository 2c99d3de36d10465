"""A command that reads files of strangers runs in a process that another one watches.

A file whose reading exceeds its budget in a way that only the kernel ends takes the process with it. The one that
watches it knows which file was in hand, and starts the command again without that file: what was written until then is
whole, as after any kill, and what was learned of other files is in the cache. So nothing else is lost.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Sequence

from roslens.children.lifeline import end_with_parent
from roslens.cli.terminal.boundary import INTERRUPTED, ask_to_end, be_asked
from roslens.cli.terminal.standard_streams import say
from roslens.intake.file_budget import Slot, refuse, watch, why_ended

WATCHED = frozenset(
    {
        "accept", "check", "compare", "completion", "doctor", "evidence", "explain", "graph", "history", "init",
        "interfaces", "percentile", "plugins", "port", "reference", "report", "roles", "study", "trend", "trust", "why",
    }
)  # fmt: skip
"""Commands that read a workspace and end."""

UNWATCHED = frozenset(
    {
        # These go on, and have a process of its own read it, which they watch (`WatchedReader`).
        "lsp", "serve",
        # These read no file of a workspace but configuration and YAML, which their own limits keep small.
        "agent", "clean", "env", "fetch", "journal", "react", "run", "top", "watch",
    }
)  # fmt: skip

DEAF_S = 5.0
"""After which a process that was asked to end, and has a file in hand, is ended."""

_LOOK_S = 0.2


def watched(run: Callable[[], int], arguments: Sequence[str]) -> int:
    """Run a command and return its exit code; what reads files of strangers in a process of its own.

    The process that watches never returns: it ends as the other one did.
    """
    if not arguments or arguments[0] not in WATCHED or not _can_watch():
        return run()
    slot, left_out = Slot(), dict[str, str]()
    ending = {signal.SIGINT, signal.SIGTERM, signal.SIGHUP}
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {*ending, signal.SIGCHLD})
    parent = os.getpid()
    while True:
        sys.stdout.flush()
        sys.stderr.flush()
        pid = os.fork()
        if pid == 0:
            be_asked()
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
            end_with_parent(parent)
            refuse(left_out)
            watch(slot)
            return run()
        status, asked = _followed(pid, slot, ending)
        if os.WIFEXITED(status):
            os._exit(os.WEXITSTATUS(status))
        number = os.WTERMSIG(status)
        _, subject = slot.get()
        why = why_ended(-number)
        if asked or not why or not subject or subject in left_out:
            _end_like(number, asked)
        left_out[subject] = why
        slot.put("")


def _can_watch() -> bool:
    return sys.platform == "linux" and threading.active_count() == 1


def _followed(pid: int, slot: Slot, ending: set[signal.Signals]) -> tuple[int, int]:
    """Return how a process ended, and by which signal this one was asked to end, 0 for none; it is asked likewise."""
    asked, deadline = 0, 0.0
    while True:
        found, status = os.waitpid(pid, os.WNOHANG)
        if found:
            return status, asked
        came = signal.sigtimedwait({*ending, signal.SIGCHLD}, _LOOK_S if asked else 3600.0)
        if came is not None and came.si_signo in ending:
            asked, deadline = came.si_signo, deadline or time.monotonic() + DEAF_S
            ask_to_end(pid)
        if asked and time.monotonic() > deadline and slot.get()[1]:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)


def _end_like(number: int, asked: int) -> None:
    """End this process as the one that it watched, or as one that was asked to end."""
    if asked:
        say("roslens: interrupted; the last complete run is untouched")
        os._exit(INTERRUPTED)
    signal.signal(number, signal.SIG_DFL) if number not in (signal.SIGKILL, signal.SIGSTOP) else None
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {number})
    os.kill(os.getpid(), number)
    os._exit(128 + number)

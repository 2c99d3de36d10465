"""How a process ended, as text: ``exit 0``, ``signal 9``, or ``unknown`` where nobody saw it."""

from __future__ import annotations

import os
import signal

UNKNOWN = "unknown"
"""It ended, and nobody saw how."""
_IN_ORDER = frozenset({"exit 0", *(f"signal {one:d}" for one in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP))})
"""Who stops a robot sends SIGINT (Ctrl-C, launch files) or SIGTERM (systemd, containers), or closes its terminal; a
node that handles them ends with 0."""


def end_of_status(status: int) -> str:
    """Return the end that a wait status (``waitpid(2)``) tells."""
    if os.WIFSIGNALED(status):
        return f"signal {os.WTERMSIG(status)}"
    return f"exit {os.WEXITSTATUS(status)}" if os.WIFEXITED(status) else UNKNOWN


def in_order(ended: str) -> bool | None:
    """Return whether a process ended because it was asked to, or was done; None where that is not known."""
    return None if ended in ("", UNKNOWN) else ended in _IN_ORDER


def end_words(ended: str) -> str:
    """Return an end for people: signals by their name."""
    what, _, number = ended.partition(" ")
    if what == "signal" and number.isdecimal():
        try:
            return signal.Signals(int(number)).name
        except ValueError:
            return ended
    return ended

"""Ctrl-C and requests to end, as something to look at rather than as an exception."""

from __future__ import annotations

import contextlib
import signal


def when_stopped(stack: contextlib.ExitStack) -> list[int]:
    """Return a list that holds something once a signal asked to end; leaving ``stack`` gives the signals back."""
    ended: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        before = signal.signal(number, lambda number, _: ended.append(number))
        stack.callback(signal.signal, number, before)
    return ended

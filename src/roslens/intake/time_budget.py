"""How much processor time one input may take: a file that is made to take for ever costs its budget, and is named.

Time of the processor and not of the clock, so that a busy machine finds what an idle one does. Two things look at it:
the parser, which asks :func:`is_spent` as it goes, in every thread; and a timer of the system, which interrupts
whatever Python does, expressions included, in the main thread of a process, where signals can be had.
"""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from math import inf

SOURCE_FILE_S = 10.0
"""For one source file: most take less than a second, a hundred kilobytes a tenth of one."""

_AGAIN_S = 0.5


class OverBudgetError(Exception):
    """An input exceeds its budget: the message states of what, and how much is allowed.

    Attributes:
        subject: path of the file, where it is known.
    """

    def __init__(self, message: str, subject: str = "") -> None:
        """Take both."""
        super().__init__(message)
        self.subject = subject


class _Budget(threading.local):
    seconds = 0.0
    deadline = inf
    earliest = inf


_budget = _Budget()


@contextmanager
def time_budget(seconds: float) -> Iterator[None]:
    """Let what is done inside take ``seconds`` of this thread's processor time.

    The budget of what it is done for stands still meanwhile.

    Raises:
        OverBudgetError: it takes more.
    """
    outer, left = _budget.seconds, _budget.deadline - time.thread_time()
    _begin(seconds, seconds)
    timed = _timer(seconds)
    try:
        try:
            yield
        finally:
            _budget.deadline = inf
    finally:
        # The timer may interrupt the line above; it rings again only later.
        _budget.deadline = inf
        if left != inf:
            _begin(outer, left)
        if timed:
            signal.setitimer(signal.ITIMER_PROF, *((max(left, 0.001), _AGAIN_S) if left != inf else (0,)))


def _begin(seconds: float, left: float) -> None:
    """Begin a budget of which some is left."""
    _budget.seconds, _budget.deadline = seconds, time.thread_time() + left
    _budget.earliest = time.monotonic() + left


def is_spent() -> bool:
    """Return whether the budget of this thread is spent."""
    # A thread has no more of a processor than the clock has gone on, and the clock is the cheaper question by far.
    return time.monotonic() > _budget.earliest and time.thread_time() > _budget.deadline


def spent() -> OverBudgetError:
    """Return the error for that."""
    return OverBudgetError(f"it takes more than {_budget.seconds:g} s of processor time")


def _timer(seconds: float) -> bool:
    if not hasattr(signal, "ITIMER_PROF") or threading.current_thread() is not threading.main_thread():
        return False
    if signal.getsignal(signal.SIGPROF) is not _interrupt:
        signal.signal(signal.SIGPROF, _interrupt)
    # It rings again in case that the first ring was caught on its way.
    signal.setitimer(signal.ITIMER_PROF, seconds, _AGAIN_S)
    return True


def _interrupt(_number: int, _frame: object) -> None:
    if is_spent():
        raise spent()

"""Signals held back while C code calls back into Python and cannot bear an exception.

An interrupt raises in whatever Python runs in the main thread; where that is a callback whose caller does not look, as
in the binding of tree-sitter, the process ends by a segmentation fault.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGPROF", "SIGALRM", "SIGUSR1", "SIGUSR2")
_RAISING = tuple(getattr(signal, name) for name in _NAMES if hasattr(signal, name))

_get = getattr(signal.getsignal, "__wrapped__", signal.getsignal)
_set = getattr(signal.signal, "__wrapped__", signal.signal)
"""The functions of C below those of Python, which make enumerations of all they take and give: that takes longer."""


@contextmanager
def held_signals() -> Iterator[list[int]]:
    """Only note which signals come, in the list that is lent; afterwards what they should have done is done."""
    came: list[int] = []
    if threading.current_thread() is not threading.main_thread():
        yield came
        return

    def note(number: int, _frame: object) -> None:
        came.append(number)

    before = {}
    try:
        for number in _RAISING:
            handler = _get(number)
            if callable(handler):
                before[number] = handler
                _set(number, note)
        yield came
    finally:
        for number, handler in before.items():
            _set(number, handler)
        for number in dict.fromkeys(came):
            signal.raise_signal(number)

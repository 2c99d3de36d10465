"""What the preloaded library leaves to Python where it is in the process: to say when a thread begins something else.

The library counts messages, their sizes and the stamps in their headers at a tenth of what counting in Python costs. It
sees what a thread takes and publishes, and services, but neither timers nor guard conditions nor waitables: what is
published by one of them would seem to answer the message that was taken before.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Callable
from typing import Any

UNSEEN = ("_take_timer", "_take_guard_condition", "_take_waitable")
"""Methods of an executor by which it begins what the library does not see."""


def forgets() -> Callable[[], object] | None:
    """Return what tells the library that this thread does something else from now on; it counts answers from then on.

    None where the library is not in this process, or is one that counts none: then Python has to count.
    """
    if not os.environ.get("LD_PRELOAD"):
        return None
    try:
        import ctypes

        # Without releasing the lock of the interpreter, which takes longer than the call.
        loaded = ctypes.PyDLL(None)
        begin, forget = loaded.roslens_count_answers, loaded.roslens_forget_taken
    except (ImportError, OSError, AttributeError):
        return None
    begin.restype = forget.restype = None
    begin()
    return forget


def forgetting(take: Callable[..., Any], forget: Callable[[], object]) -> Callable[..., Any]:
    """Return a method of an executor that forgets what was taken before it takes something else."""

    @functools.wraps(take)
    def forget_and_take(self: Any, entity: Any) -> Any:
        forget()
        return take(self, entity)

    return forget_and_take

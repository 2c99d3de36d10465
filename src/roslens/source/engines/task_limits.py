"""What one task may take of the machine that it runs on: beyond it the worker process ends, and is replaced.

A thread cannot be ended from outside, and neither can parsing that hangs in C: only its process can.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from typing import TypeVar

import msgspec

from roslens.children.limits import limit_process

Task = TypeVar("Task")
Result = TypeVar("Result")

EXIT_CODE = 124
"""Of a worker whose task took too long, as of ``timeout``."""


class TaskLimits(msgspec.Struct, frozen=True):
    """Bounds of one task.

    Attributes:
        seconds: by the clock; 0 for none. Each file has a bound of its own besides.
        memory_bytes: that its process may write to; beyond it Python raises MemoryError. 0 for none.
        jobs: how many processes share the memory that files may take; 0 for one for each processor.
    """

    seconds: float = 1800.0
    memory_bytes: int = 4_000_000_000
    jobs: int = 0


def died_twice(limits: TaskLimits) -> RuntimeError:
    """Return the error of a task that ended its process and then another one."""
    within = f", which may take {limits.seconds:g} s and {limits.memory_bytes / 1e9:g} GB"
    return RuntimeError(f"the worker process died twice on this task{within}")


def run_limited(function: Callable[[Task], Result], limits: TaskLimits, task: Task) -> Result:
    """Return what the function makes of the task; where that takes too long, this process ends.

    Raises:
        MemoryError: the task needs more memory than it may take.
        Exception: whatever the function raises.
    """
    if limits.memory_bytes:
        limit_process(limits.memory_bytes)
    if not limits.seconds:
        return function(task)
    end = threading.Timer(limits.seconds, os._exit, (EXIT_CODE,))
    end.daemon = True
    end.start()
    try:
        return function(task)
    finally:
        end.cancel()

"""What a process that runs foreign code may take of the machine; programs that it starts inherit it."""

from __future__ import annotations

import contextlib
import sys
from math import ceil

MEMORY_BYTES = 4_000_000_000
"""Of memory that is written, as the kernel counts it (``RLIMIT_DATA``): reserved addresses, of Java's say, are free."""

FILE_BYTES = 512_000_000
"""Of each file that is written, standard output among them."""


def limit_process(memory_bytes: int = MEMORY_BYTES, file_bytes: int = FILE_BYTES) -> None:
    """Bound this process and all that it starts from now on; a bound that is lower already stays.

    Beyond them Python raises ``MemoryError``, or ``OSError`` for a file that is too large. Nothing is bounded where
    the system knows no such limits.
    """
    if sys.platform == "win32":
        return
    import resource

    for limit, most in (
        (resource.RLIMIT_DATA, memory_bytes),
        (resource.RLIMIT_FSIZE, file_bytes),
        (resource.RLIMIT_CORE, 0),
    ):
        _, hard = resource.getrlimit(limit)
        bound = most if hard == resource.RLIM_INFINITY else min(most, hard)
        # macOS does not let every limit be set.
        with contextlib.suppress(OSError, ValueError):
            resource.setrlimit(limit, (bound, bound))


def limit_processor(pid: int, seconds: float) -> None:
    """Bound the time of a processor that a process may take: at its end a signal ends it (``SIGXCPU``).

    The kernel counts whole seconds. Nothing is bounded where the system cannot bound another process.
    """
    if sys.platform != "linux":
        return
    import resource

    # A process that has ended meanwhile has no limits.
    with contextlib.suppress(OSError, ValueError):
        _, hard = resource.prlimit(pid, resource.RLIMIT_CPU)
        resource.prlimit(pid, resource.RLIMIT_CPU, (max(1, ceil(seconds)), hard))

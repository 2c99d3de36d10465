"""How many processes a session has, so that a program that starts itself again and again is seen in time."""

from __future__ import annotations

import os
from contextlib import suppress


def number_in_session(leader: int) -> int:
    """Return how many processes the session has that a process began; 0 if the kernel does not provide it."""
    try:
        names = os.listdir("/proc")  # noqa: PTH208 - many times
    except OSError:
        return 0
    found = 0
    for name in names:
        if name.isdigit():
            with suppress(OSError):
                found += os.getsid(int(name)) == leader
    return found

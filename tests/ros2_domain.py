"""A domain of ROS 2 for one test alone, below those whose ports the system hands out to anybody."""

from __future__ import annotations

import fcntl
import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from itertools import count
from pathlib import Path

FIRST, LAST = 61, 100
"""Where tests look. Ports of domains above 101 are among those that any program may be given (32768 to 60999)."""
_PORT, _PORTS = 7400, 250
CLAIMED_S = 60.0
"""Who was given a domain listens by then, or never will."""
_CLAIMS = Path(tempfile.gettempdir(), f"roslens-domains-{os.getuid()}")
_CLAIMS.mkdir(exist_ok=True)
_turn = count(os.getpid())


def own_domain() -> str:
    """Return a domain in which nobody on this machine listens, another one at each call.

    Workers of one test run have neighbouring process ids, and so begin at different domains. Who is given one has a
    while to begin to listen in which nobody else is.
    """
    with (_CLAIMS / "lock").open("a") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        taken = set(_taken_ports())
        for _ in range(FIRST, LAST + 1):
            domain = FIRST + next(_turn) % (LAST + 1 - FIRST)
            begin = _PORT + _PORTS * domain
            if taken.isdisjoint(range(begin, begin + _PORTS)) and _claim(_CLAIMS / str(domain)):
                return str(domain)
    raise AssertionError(f"somebody listens in each of the domains {FIRST} to {LAST}, or is about to")


def _claim(claim: Path) -> bool:
    """Return whether a domain was given to nobody else of late, and is claimed now."""
    mine = str(os.getpid())
    with suppress(FileNotFoundError):
        if claim.read_text() != mine and 0 <= time.time() - claim.stat().st_mtime < CLAIMED_S:
            return False
    claim.write_text(mine)
    return True


def _taken_ports() -> Iterator[int]:
    for table in ("/proc/net/udp", "/proc/net/udp6"):
        if Path(table).exists():
            for line in Path(table).read_text().splitlines()[1:]:
                yield int(line.split()[1].rpartition(":")[2], 16)

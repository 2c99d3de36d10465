"""A domain of ROS 2 for one test alone, below those whose ports the system hands out to anybody."""

from __future__ import annotations

import os
from collections.abc import Iterator
from itertools import count
from pathlib import Path

FIRST, LAST = 61, 100
"""Where tests look. Ports of domains above 101 are among those that any program may be given (32768 to 60999)."""
_PORT, _PORTS = 7400, 250
_turn = count(os.getpid())


def own_domain() -> str:
    """Return a domain in which nobody on this machine listens, another one at each call.

    Workers of one test run have neighbouring process ids, and so begin at different domains.
    """
    taken = set(_taken_ports())
    for _ in range(FIRST, LAST + 1):
        domain = FIRST + next(_turn) % (LAST + 1 - FIRST)
        begin = _PORT + _PORTS * domain
        if taken.isdisjoint(range(begin, begin + _PORTS)):
            return str(domain)
    raise AssertionError(f"somebody listens in each of the domains {FIRST} to {LAST}")


def _taken_ports() -> Iterator[int]:
    for table in ("/proc/net/udp", "/proc/net/udp6"):
        if Path(table).exists():
            for line in Path(table).read_text().splitlines()[1:]:
                yield int(line.split()[1].rpartition(":")[2], 16)

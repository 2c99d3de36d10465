"""A clock offset for programs of a host that are started with `faked`.

Debian's faketime is preloaded and reads the offset from a file of the host, so that it can change while programs run.
Cleanest is an offset that is in force before they start: at a change, faketime moves their monotonic clock too, once.
(Its setting to leave that one alone makes sleeping fail in Python 3.11 and newer with faketime 0.9.10.)
"""

import contextlib
from collections.abc import Iterator
from pathlib import Path

from testbed.faults import Fault, in_force
from testbed.hosts import Host
from testbed.machine import BedError

LIBRARY = "faketime/libfaketime.so.1"


def library() -> Path | None:
    """Where faketime's library is, None where it is not installed."""
    return next(iter(sorted(Path("/usr/lib").glob(f"*/{LIBRARY}"))), None)


def faked(host: Host) -> dict[str, str]:
    """The environment for programs whose clock `shifted` shall move; they start with the offset in force."""
    preloaded = library()
    if preloaded is None:
        raise BedError(f"no {LIBRARY!r} found below /usr/lib; install faketime")
    offset = host.folder / "clock"
    if not offset.exists():
        offset.write_text("+0\n")
    return {
        "LD_PRELOAD": str(preloaded),
        "FAKETIME_TIMESTAMP_FILE": str(offset),
        "FAKETIME_CACHE_DURATION": "1",
    }


@contextlib.contextmanager
def shifted(host: Host, seconds: float) -> Iterator[Fault]:
    """Moves the clock of the host's `faked` programs by `seconds`, ahead when positive; they see it within a second."""
    offset = host.folder / "clock"

    def write(value: float) -> None:
        fresh = offset.with_suffix(".new")
        fresh.write_text(f"{value:+.6f}\n")
        fresh.replace(offset)

    with in_force("clock offset", host.name, lambda: write(seconds), lambda: write(0.0)) as fault:
        yield fault

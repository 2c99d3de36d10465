"""How a process ended that is no child of this one.

The kernel keeps the wait status of a process for whoever holds a descriptor of it (``PIDFD_GET_INFO`` of
``linux/pidfd.h``, Linux 6.15 and later) as soon as its parent has reaped it. Until then it is a zombie, whose status is
the last field of ``/proc/PID/stat`` for its user and for root. On an older kernel a parent that is quicker leaves
nothing to be seen.
"""

from __future__ import annotations

import fcntl
import struct
import time
from pathlib import Path

from roslens.model.acting.process_end import UNKNOWN, end_of_status

_INFO_BYTES = 64
_GET_INFO = 3 << 30 | _INFO_BYTES << 16 | 0xFF << 8 | 11
_EXIT = 1 << 3
_CODE_AT = 60
_TRIES = 5
_PAUSE_S = 0.001
_STATE_FIELD = 0


def how_it_ended(pid: int, handle: int, proc: Path = Path("/proc")) -> str:
    """Return how the process of a descriptor ended (`model/acting/process_end.py`); it has become readable."""
    for _ in range(_TRIES):
        status = _kept(handle)
        if status is None:
            status = _of_zombie(pid, proc)
        if status is not None:
            return end_of_status(status)
        # Between the two a parent reaps it.
        time.sleep(_PAUSE_S)
    return UNKNOWN


def _kept(handle: int) -> int | None:
    """Return the status that the kernel keeps of a process that was reaped."""
    info = bytearray(_INFO_BYTES)
    struct.pack_into("Q", info, 0, _EXIT)
    try:
        fcntl.ioctl(handle, _GET_INFO, info)
    except OSError:
        return None
    (mask,) = struct.unpack_from("Q", info, 0)
    (status,) = struct.unpack_from("i", info, _CODE_AT)
    return int(status) if mask & _EXIT else None


def _of_zombie(pid: int, proc: Path) -> int | None:
    try:
        fields = (proc / str(pid) / "stat").read_bytes().rpartition(b")")[2].split()
        return int(fields[-1]) if fields[_STATE_FIELD] == b"Z" else None
    except (OSError, IndexError, ValueError):
        return None

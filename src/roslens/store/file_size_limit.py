"""The limit on the size of a file (`ulimit -f`): SQLite reports a file that reached it as a disk that failed."""

from __future__ import annotations

import os
from pathlib import Path

_BESIDE = ("", "-wal", "-journal", "-shm")
_AT_ONCE = 128 * 1024
"""Bytes that SQLite adds to a file in one step, with room to spare."""


def process_limit() -> int:
    """Return how many bytes a file of this process may have; 0 where there is no limit."""
    if os.name != "posix":
        return 0
    import resource

    most = resource.getrlimit(resource.RLIMIT_FSIZE)[0]
    return 0 if most == resource.RLIM_INFINITY else most


def file_size_limit(path: Path) -> int:
    """Return the limit in bytes if a database at ``path``, or what SQLite keeps beside it, has come to it; else 0."""
    most = process_limit()
    if not most:
        return 0
    return most if max(_size(path.with_name(path.name + suffix)) for suffix in _BESIDE) + _AT_ONCE > most else 0


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0

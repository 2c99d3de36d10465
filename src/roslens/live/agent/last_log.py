"""The last lines of the log that a node of ROS 2 writes: `PROGRAM_PID_MILLISECONDS.log` in its folder of logs.

A program chooses that folder by its environment, so that what is there is trusted no more than the program: only plain
files of its own user are read, no links are followed, and little is read of them.
"""

from __future__ import annotations

import os
import stat
from itertools import islice
from pathlib import Path

LINES = 3
_TAIL_BYTES = 4096
_LONGEST_LINE = 300
_MOST_FILES = 20_000
"""Of a folder so many files are looked through: nobody removes old logs."""


def log_folder(environment: bytes) -> Path | None:
    """Return where a process with an environment, as `/proc/PID/environ` shows it, writes its logs."""
    known = dict(one.partition(b"=")[::2] for one in environment.split(b"\0"))
    for name, below in ((b"ROS_LOG_DIR", ""), (b"ROS_HOME", "log"), (b"HOME", ".ros/log")):
        if known.get(name, b"").startswith(b"/"):
            return Path(os.fsdecode(known[name])) / below
    return None


def last_lines(folder: Path, pid: int, owner: int) -> tuple[str, ...]:
    """Return the last lines that a process of the user ``owner`` logged; none where they cannot be read."""
    try:
        with os.scandir(folder) as entries:
            names = [one.name for one in islice(entries, _MOST_FILES) if _is_of(one.name, pid)]
        newest = max(names, key=_milliseconds, default="")
        return _tail(folder / newest, owner) if newest else ()
    except OSError:
        return ()


def _is_of(name: str, pid: int) -> bool:
    parts = name.removesuffix(".log").split("_")
    return name.endswith(".log") and len(parts) > 2 and parts[-2] == str(pid) and parts[-1].isdecimal()


def _milliseconds(name: str) -> int:
    return int(name.removesuffix(".log").rpartition("_")[2][:20])


def _tail(path: Path, owner: int) -> tuple[str, ...]:
    descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    with os.fdopen(descriptor, "rb") as file:
        about = os.fstat(descriptor)
        if not stat.S_ISREG(about.st_mode) or about.st_uid != owner:
            return ()
        file.seek(max(about.st_size - _TAIL_BYTES, 0))
        lines = file.read(_TAIL_BYTES).decode("utf-8", "replace").splitlines()
    return tuple([line[:_LONGEST_LINE] for line in lines if line.strip()][-LINES:])

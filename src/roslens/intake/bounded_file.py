"""A file of a stranger's folder, read if it is a plain file and no larger than what is expected of its kind."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path


class TooLargeError(OSError):
    """A file has more bytes than are read of its kind."""

    def __init__(self, path: Path, size: int, most: int) -> None:
        """Say which file, its size and the bound, in bytes."""
        super().__init__(errno.EFBIG, f"a file of {size:,} bytes; at most {most:,} are read", str(path))


def read_bounded(path: Path, most_bytes: int) -> bytes:
    """Return the content of a plain file.

    Nothing is waited for: a pipe, a device or a folder is refused, whatever it is by the time that it is opened. Of a
    file that says it is empty, as those of ``/proc`` do, no more than the bound is read.

    Raises:
        TooLargeError: it has more bytes.
        OSError: it cannot be read, or is no plain file.
    """
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0))
    with os.fdopen(descriptor, "rb") as stream:
        found = os.fstat(descriptor)
        if not stat.S_ISREG(found.st_mode):
            raise OSError(errno.EINVAL, "no plain file", str(path))
        if found.st_size > most_bytes:
            raise TooLargeError(path, found.st_size, most_bytes)
        content = stream.read(most_bytes + 1)
    if len(content) > most_bytes:
        raise TooLargeError(path, len(content), most_bytes)
    return content

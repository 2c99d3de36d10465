"""A file of a stranger's folder, read if it is a plain file and no larger than what is expected of its kind."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Callable
from pathlib import Path

MOST_SOURCE_BYTES = 5_000_000
"""Of one file of source, and of whatever else a workspace has that is read as a whole."""

MOST_DOCUMENT_BYTES = 256_000_000
"""Of one document that roslens itself wrote: a graph, a reference, a result."""

_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
_PIECE = 1 << 20


class TooLargeError(OSError):
    """A file has more bytes than are read of its kind."""

    def __init__(self, path: str | Path, size: int, most: int) -> None:
        """Take the file, its size and the bound, in bytes."""
        super().__init__(errno.EFBIG, f"a file of {size:,} bytes; at most {most:,} are read", str(path))


def read_bounded(path: str | Path, most_bytes: int = MOST_SOURCE_BYTES) -> bytes:
    """Return the content of a plain file.

    Nothing is waited for: a pipe, a device or a folder is refused, whatever it is by the time that it is opened. Of a
    file that says it is empty, as those of ``/proc`` do, no more than the bound is read.

    Raises:
        TooLargeError: it has more bytes.
        OSError: it cannot be read, or is no plain file.
    """
    descriptor = os.open(path, _FLAGS)
    try:
        found = os.fstat(descriptor)
        if stat.S_ISDIR(found.st_mode):
            raise OSError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        if not stat.S_ISREG(found.st_mode):
            raise OSError(errno.EINVAL, "no plain file", str(path))
        if found.st_size > most_bytes:
            raise TooLargeError(path, found.st_size, most_bytes)
        read = _named(descriptor, path)
        content = read(found.st_size + 1)
        if len(content) == found.st_size:
            return content
        pieces = [content]
        size = len(content)
        while size <= most_bytes and (piece := read(_PIECE)):
            pieces.append(piece)
            size += len(piece)
    finally:
        os.close(descriptor)
    if size > most_bytes:
        raise TooLargeError(path, size, most_bytes)
    return b"".join(pieces)


def _named(descriptor: int, path: str | Path) -> Callable[[int], bytes]:
    def read(most: int) -> bytes:
        try:
            return os.read(descriptor, most)
        except OSError as error:
            # A file without data yet, such as `/proc/kmsg`, would block.
            raise OSError(error.errno or errno.EIO, error.strerror or str(error), str(path)) from None

    return read

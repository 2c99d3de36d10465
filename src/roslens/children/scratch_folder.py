"""Temporary folders of one process, which a later one removes where it was killed.

The process that makes a folder holds a lock on it, which the kernel releases however the process ends. So whether the
owner still lives is known even where its number means another process, as in a container with the same ``$TMPDIR``.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from contextlib import suppress
from types import TracebackType

if os.name == "posix":
    import fcntl

_PREFIX = "roslens."
"""Only for these folders: those of earlier versions have no lock, and begin with ``roslens-``."""
_FLAGS = os.O_RDONLY | getattr(os, "O_DIRECTORY", 0) | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_CLOEXEC", 0)


class ScratchFolder:
    """A new folder below ``$TMPDIR``, removed at the end of the block or by :meth:`cleanup`."""

    def __init__(self, purpose: str) -> None:
        """Make it; ``purpose`` is part of its name.

        Raises:
            OSError: it cannot be made.
        """
        self._lock: int | None = None
        while True:
            self._folder = tempfile.TemporaryDirectory(prefix=f"{_PREFIX}{purpose}.")
            self.name = self._folder.name
            if os.name != "posix":
                return
            self._lock = _locked(self.name)
            # Before it was locked, another process may have taken it for one whose owner is gone.
            if os.path.isdir(self.name):  # noqa: PTH112 - a text
                return
            self.cleanup()

    def __enter__(self) -> str:
        """Return its path."""
        return self.name

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Remove it."""
        self.cleanup()

    def cleanup(self) -> None:
        """Remove it with all that is in it."""
        try:
            self._folder.cleanup()
        finally:
            if self._lock is not None:
                os.close(self._lock)
                self._lock = None


def sweep_scratch() -> None:
    """Remove folders of this user whose owner has ended; what cannot be removed stays."""
    if os.name != "posix":
        return
    place = tempfile.gettempdir()
    with suppress(OSError):
        for name in [name for name in os.listdir(place) if name.startswith(_PREFIX)]:  # noqa: PTH208 - names suffice
            _remove_left(f"{place}/{name}")


def _remove_left(path: str) -> None:
    try:
        own = os.lstat(path).st_uid == os.geteuid()
        lock = _locked(path) if own else None
    except OSError:
        return
    if lock is not None:
        shutil.rmtree(path, ignore_errors=True)
        os.close(lock)


def _locked(path: str) -> int | None:
    """Return the open folder with a lock on it; None where another process has it, or it cannot be locked."""
    try:
        file = os.open(path, _FLAGS)
    except OSError:
        return None
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(file)
        return None
    return file

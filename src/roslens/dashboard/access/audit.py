"""What was asked to be done through the pages, by whom, and what came of it: a line each."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

import msgspec

LARGEST = 8_000_000
"""Bytes after which a file is set aside as ``<name>.1``, over the one that was there."""


class Entry(msgspec.Struct, frozen=True, omit_defaults=True):
    """An acting request, a sign-in, or one that was refused.

    Attributes:
        time: seconds since the epoch.
        peer: address that it came from.
        name: of the sender; empty if unknown.
        role: of them.
        method: of HTTP.
        path: without what was asked, which may hold a token.
        status: of the answer; 0 of an act that is about to be tried.
        why: it was refused.
    """

    time: float
    peer: str
    name: str
    role: str
    method: str
    path: str
    status: int
    why: str = ""


class AuditFile:
    """Appends entries to a file that its owner alone can read."""

    def __init__(self, path: Path) -> None:
        """``path`` is made with the first entry."""
        self._path = path

    def __call__(self, entry: Entry) -> None:
        """Write an entry down.

        Raises:
            OSError: it cannot be written; what would have been done is then not done.
        """
        with suppress(FileNotFoundError):
            if self._path.stat().st_size > LARGEST:
                self._path.replace(self._path.with_name(self._path.name + ".1"))
        held = os.open(self._path, os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC, 0o600)
        try:
            os.write(held, msgspec.json.encode(entry) + b"\n")
        finally:
            os.close(held)


def forgotten(_: Entry) -> None:
    """Write nothing down."""

"""Answers of forges that were kept, with the tags by which a forge confirms that they are still valid."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded

MOST_BYTES = 50_000_000
"""A larger file of answers is forgotten."""


class Answer(msgspec.Struct, frozen=True):
    """What a forge answered: ``etag`` names its state, ``headers`` are those that are of use, ``body`` is JSON."""

    etag: str
    headers: dict[str, str]
    body: bytes


class Answers:
    """The last answer to each address, in one file; losing it costs questions, never a result."""

    def __init__(self, path: Path | None) -> None:
        """Read what was kept at ``path``; None, and a file that cannot be read, remember nothing."""
        self._path = path
        self._known: dict[str, Answer] = {}
        self._changed = False
        if path is not None:
            with suppress(OSError, msgspec.DecodeError, msgspec.ValidationError):
                self._known = msgspec.msgpack.decode(read_bounded(path, MOST_BYTES), type=dict[str, Answer])

    def last(self, url: str) -> Answer | None:
        """Return the last answer to an address."""
        return self._known.get(url)

    def keep(self, url: str, answer: Answer) -> None:
        """Keep an answer in place of the one before."""
        self._known[url] = answer
        self._changed = True

    def write(self) -> None:
        """Write the file, whole or not at all."""
        if self._path is None or not self._changed:
            return
        part = self._path.with_name(f"{self._path.name}.{os.getpid()}")
        with suppress(OSError):
            part.write_bytes(msgspec.msgpack.encode(self._known))
            part.replace(self._path)
        part.unlink(missing_ok=True)

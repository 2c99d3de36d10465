"""Reads a journal: all of it, what comes next, and whether anything in it was changed."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import msgspec

from roslens.model.errors import StoreError
from roslens.store.journals.journal import TORN
from roslens.store.journals.journal_entry import MOST_BYTES, Entry, EntryError, read

_PIECE = 1 << 20


class Verified(msgspec.Struct, frozen=True):
    """What a look at the hashes of a journal found.

    Attributes:
        entries: that are as they were written, from the first on.
        head: hash of the last of them; keep it elsewhere, so that a journal whose end is cut off shows.
        wrong: what is not as it was written, and in which line; empty where all is.
    """

    entries: int
    head: str
    wrong: tuple[str, ...] = ()


class JournalReader:
    """Reads entries as they come; a line that is not complete yet is left for the next call."""

    def __init__(self, path: Path) -> None:
        """Read the journal at ``path``.

        Raises:
            StoreError: it cannot be read.
        """
        try:
            self._file = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        except OSError as error:
            raise StoreError(
                f"cannot read the journal: {error.strerror or error}", where=str(path), expected="a journal",
                advice="`roslens react` writes one; name it with --journal",
            ) from None  # fmt: skip
        self._waiting = b""
        self.line = 0

    def lines(self) -> Iterator[bytes]:
        """Yield lines that are complete, each once."""
        while piece := os.read(self._file, _PIECE):
            *whole, self._waiting = (self._waiting + piece).split(b"\n")
            for line in whole:
                self.line += 1
                yield line
            if len(self._waiting) > 2 * MOST_BYTES:  # no journal: it would be kept for ever
                self.line += 1
                yield self._waiting
                self._waiting = b""

    def entries(self) -> Iterator[Entry]:
        """Yield entries that can be read, each once; what follows from others is :func:`verify`'s to say."""
        for line in self.lines():
            try:
                yield read(line)
            except EntryError:
                continue

    @property
    def rest(self) -> bytes:
        """What stands behind the last complete line."""
        return self._waiting

    def close(self) -> None:
        """Close the file."""
        os.close(self._file)


def verify(path: Path, head: str = "") -> Verified:
    """Look at every hash of a journal.

    Args:
        path: of the journal.
        head: a hash that was kept of it before, which has to be in it; empty for none.

    Raises:
        StoreError: it cannot be read.
    """
    reader = JournalReader(path)
    try:
        return _verified(reader, head)
    finally:
        reader.close()


def _verified(reader: JournalReader, head: str) -> Verified:
    wrong: list[str] = []
    last: Entry | None = None
    torn = b""
    seen = not head
    good = 0
    for line in reader.lines():
        try:
            entry = read(line)
        except EntryError as error:
            if torn:
                wrong.append(f"line {reader.line - 1}: no entry")
            torn = line
            torn_why = str(error)
            continue
        if torn:
            # The writer ended within that line, and whoever came next said so with its text.
            if entry.what != TORN or entry.fields.get("bytes") != len(torn):
                wrong.append(f"line {reader.line - 1}: {torn_why}")
            torn = b""
        number, before = (last.n + 1, last.hash) if last else (0, "")
        if entry.before != before or entry.n != number:
            found = f"entry {entry.n} does not follow entry {last.n}" if last else f"it begins with entry {entry.n}"
            wrong.append(f"line {reader.line}: {found}: something was changed, left out or put in")
        last = entry
        good += not wrong
        seen = seen or entry.hash == head
    if torn:
        wrong.append(f"line {reader.line}: {torn_why}")
    if reader.rest:
        wrong.append(f"line {reader.line + 1}: not complete; its writer ended within it, or still writes")
    if not seen:
        wrong.append(f"no entry has the hash {head[:16]!r}: the end was cut off, or it is another journal")
    return Verified(good, last.hash if last else "", tuple(wrong))

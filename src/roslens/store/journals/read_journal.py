"""Reads a journal: all of it, what comes next, and whether anything in it was changed."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import msgspec

from roslens.model.errors import StoreError
from roslens.store.journals.journal import ANEW, TORN
from roslens.store.journals.journal_entry import MOST_BYTES, Entry, EntryError, read
from roslens.store.journals.signing import Signing

_PIECE = 1 << 20


class Verified(msgspec.Struct, frozen=True):
    """What a look at the hashes of a journal found.

    Attributes:
        entries: that are as they were written, from the first on.
        head: hash of the last of them; keep it elsewhere, so that a journal whose end is cut off shows.
        wrong: what is not as it was written, and in which line; empty where all is.
        signed: how many entries the key of the journal signed.
    """

    entries: int
    head: str
    wrong: tuple[str, ...] = ()
    signed: int = 0


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
        """Yield the readable entries, each once; :func:`verify` judges the others."""
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


def verify(path: Path, head: str = "", signing: Signing | None = None) -> Verified:
    """Look at every hash of a journal, and at every code.

    Entries of before it was signed have no code; what follows one that has is signed as well, up to the last that is
    known to be.

    Args:
        path: of the journal.
        head: a hash that was kept of it before, which has to be in it; empty for none.
        signing: what it was signed with; None looks at no code.

    Raises:
        StoreError: it cannot be read.
    """
    reader = JournalReader(path)
    try:
        return _verified(reader, _Chain(head, signing))
    finally:
        reader.close()


def _verified(reader: JournalReader, chain: _Chain) -> Verified:
    for line in reader.lines():
        try:
            entry = read(line)
        except EntryError as error:
            chain.tear(reader.line, line, str(error))
        else:
            chain.take(reader.line, entry)
    return chain.verified(reader)


class _Chain:
    """What was seen of a journal so far: its last entry, and what is wrong."""

    def __init__(self, head: str, signing: Signing | None) -> None:
        self._head = head
        self._signing = signing
        self._anchor = signing.anchor() if signing is not None else None
        self._signed = 0
        self._seen = not head
        self._wrong: list[str] = []
        self._last: Entry | None = None
        self._good = 0
        self._torn = b""
        self._torn_why = ""

    def tear(self, number: int, line: bytes, why: str) -> None:
        """Take a line that is no entry."""
        if self._torn:
            self._wrong.append(f"line {number - 1}: no entry")
        self._torn, self._torn_why = line, why

    def take(self, number: int, entry: Entry) -> None:
        """Take an entry, which has to follow the one before it."""
        # A writer ended within a torn line, and whoever came next said so with its text.
        if self._torn and (entry.what != TORN or entry.fields.get("bytes") != len(self._torn)):
            self._wrong.append(f"line {number - 1}: {self._torn_why}")
        self._torn = b""
        last = self._last
        if (entry.n, entry.before) != ((last.n + 1, last.hash) if last else (0, "")):
            found = f"entry {entry.n} does not follow entry {last.n}" if last else f"it begins with entry {entry.n}"
            self._wrong.append(f"line {number}: {found}: something was changed, left out or put in")
        self._last = entry
        self._look_at_code(number, entry)
        self._good += not self._wrong
        self._seen = self._seen or entry.hash == self._head

    def _look_at_code(self, number: int, entry: Entry) -> None:
        if self._signing is None:
            return
        if self._signing.made(entry.code, entry.hash):
            self._signed += 1
            if entry.what == ANEW and entry.n:
                self._wrong.append(f"line {number}: {entry.fields.get('text', '')}")
            if self._anchor is not None and (entry.n, entry.hash) == (self._anchor.n, self._anchor.hash):
                self._anchor = None
        elif self._signed:
            self._wrong.append(f"line {number}: entry {entry.n} is not signed with the key of this journal")

    def verified(self, reader: JournalReader) -> Verified:
        """Return what all lines of a reader come to."""
        wrong = list(self._wrong)
        if self._torn:
            wrong.append(f"line {reader.line}: {self._torn_why}")
        if reader.rest:
            wrong.append(f"line {reader.line + 1}: not complete; its writer ended within it, or still writes")
        if not self._seen:
            wrong.append(f"no entry has the hash {self._head[:16]!r}: the end was cut off, or it is another journal")
        if self._anchor is not None:
            lost = f"entry {self._anchor.n}, the last that was signed here, is not there as it was written"
            wrong.append(f"{lost}: the end was cut off, or entries were written anew")
        return Verified(self._good, self._last.hash if self._last else "", tuple(wrong), self._signed)

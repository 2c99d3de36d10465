"""The journal: an append-only file of what was decided and done, each entry bound to those before it by its hash.

An entry is on the disk before :meth:`Journal.add` returns, so that what is announced is known even where the machine
dies of what is done next. Several threads and processes may write to one journal: a lock is held for each entry.
"""

from __future__ import annotations

import contextlib
import os
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from roslens.model.errors import StoreError
from roslens.store.journals.journal_entry import MOST_BYTES, Entry, EntryError, read, written
from roslens.store.journals.signing import Anchor, Signing

if os.name == "posix":
    import fcntl

TORN = "torn"
"""The text of an entry that follows an incomplete line."""
ANEW = "anew"
"""The text of an entry that follows where entries were that are no longer there."""


class Journal:
    """A journal that is written to."""

    def __init__(self, path: Path, signing: Signing | None = None) -> None:
        """Open or begin a journal, for its user alone.

        Args:
            path: of the journal.
            signing: what entries are signed with; None signs none.

        Raises:
            StoreError: it cannot be written, or its end is no journal.
        """
        self._path = path
        self._signing = signing
        self._last: Entry | None = None
        self._size = 0
        self._turn = threading.Lock()
        flags = os.O_RDWR | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC | os.O_NONBLOCK
        try:
            path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            self._file = os.open(path, flags, 0o600)
        except OSError as error:
            raise _unwritten(path, error) from None
        try:
            with self._locked():
                self._catch_up()
        except BaseException:
            os.close(self._file)
            raise

    @property
    def path(self) -> Path:
        """Where it lies."""
        return self._path

    def __enter__(self) -> Journal:
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close it."""
        self.close()

    def add(self, what: str, time: float, **fields: Any) -> Entry:
        """Append an entry; it is on the disk when this returns.

        Raises:
            StoreError: it could not be written; nothing must be done that was not announced.
        """
        with self._turn, self._locked():
            self._catch_up()
            if (lost := self._lost()) is not None:
                text = f"{lost.n + 1} entries were here, up to {lost.hash}: they were put away, cut off or changed"
                self._write(time, ANEW, {"text": text, "entries": lost.n + 1, "head": lost.hash})
            return self._write(time, what, fields)

    def _lost(self) -> Anchor | None:
        """Return the last entry that was signed here, if the journal no longer ends with one that is."""
        if self._signing is None or (anchor := self._signing.anchor()) is None:
            return None
        last = self._last
        whole = last is not None and last.n >= anchor.n and self._signing.made(last.code, last.hash)
        return None if whole else anchor

    def _write(self, time: float, what: str, fields: dict[str, Any]) -> Entry:
        number, before = (self._last.n + 1, self._last.hash) if self._last else (0, "")
        entry, line = written(number, time, what, fields, before, self._signing)
        self._append(line)
        self._last = entry
        if self._signing is not None:
            self._signing.keep(entry.n, entry.hash)
        return entry

    def close(self) -> None:
        """Close the file."""
        os.close(self._file)

    @contextlib.contextmanager
    def _locked(self) -> Iterator[None]:
        if os.name != "posix":
            yield
            return
        fcntl.flock(self._file, fcntl.LOCK_EX)
        try:
            yield
        finally:
            fcntl.flock(self._file, fcntl.LOCK_UN)

    def _append(self, line: bytes) -> None:
        try:
            done = os.write(self._file, line)
            if done < len(line):
                os.ftruncate(self._file, self._size)
                raise OSError(28, f"only {done} of {len(line)} bytes could be written")  # noqa: TRY301 - ENOSPC
            os.fsync(self._file)
        except OSError as error:
            raise _unwritten(self._path, error) from None
        self._size += len(line)

    def _catch_up(self) -> None:
        """Learn the last entry, which another process may have written, and end a line that was never completed."""
        size = os.fstat(self._file).st_size
        if size == self._size:
            return
        start = max(size - 2 * MOST_BYTES, 0)
        tail = os.pread(self._file, size - start, start)
        self._size = size
        whole, newline, rest = tail.rpartition(b"\n")
        line = whole.rpartition(b"\n")[2] if newline else b""
        try:
            self._last = read(line) if line else None
        except EntryError as error:
            advice = "Look at it with `roslens journal --verify`, and put it away to begin a new one"
            raise StoreError(str(error), where=str(self._path), expected="a journal", advice=advice) from None
        if rest:
            if start and not newline:
                raise StoreError("no journal", where=str(self._path), expected="a line for each entry")
            self._append(b"\n")
            text = rest.decode("utf-8", "replace")
            self._write(self._last.time if self._last else 0.0, TORN, {"bytes": len(rest), "text": text})


def _unwritten(path: Path, error: OSError) -> StoreError:
    return StoreError(
        f"cannot write the journal: {error.strerror or error}", where=str(path), expected="a file that can be "
        "appended to",
        advice="Name another one with --journal, or free space: without a journal nothing is done",
    )  # fmt: skip

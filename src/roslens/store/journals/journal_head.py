"""The end of a journal, as it is published: a copy of it elsewhere shows when entries behind it are gone."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

import msgspec

from roslens.store.journals.journal_entry import MOST_BYTES, Entry, EntryError, read
from roslens.store.journals.signing import Signing

if os.name == "posix":
    import fcntl


class JournalHead(msgspec.Struct, frozen=True):
    """Where a journal ends.

    Attributes:
        path: of the journal.
        entries: that it has.
        hash: of the last of them; empty for none.
        wrong: why its end is not as it was written; empty where it is.
    """

    path: str
    entries: int
    hash: str
    wrong: str = ""


def journal_head(path: Path, signing: Signing) -> JournalHead | None:
    """Return where the journal at ``path`` ends; None where no journal is there, and none was signed there.

    Only its end is read: entries before it are for ``roslens journal --verify``.
    """
    # In this order: what is written meanwhile is in the journal before it is known to be signed.
    anchor = signing.anchor()
    try:
        last, wrong = _last(path), ""
    except FileNotFoundError:
        if anchor is None:
            return None
        last, wrong = None, "it is not there"
    except OSError as error:
        last, wrong = None, f"it cannot be read: {error.strerror or error}"
    except EntryError as error:
        last, wrong = None, str(error)
    if anchor is not None and not wrong and (last is None or last.n < anchor.n):
        wrong = f"entry {anchor.n} ({anchor.hash[:16]}…), the last that was signed, is not there: the end was cut off"
    elif anchor is not None and last is not None and not signing.made(last.code, last.hash):
        wrong = f"entry {last.n} is not signed with the key of this journal"
    elif anchor is not None and last is not None and last.n == anchor.n and last.hash != anchor.hash:
        wrong = f"entry {anchor.n} is not the one that was signed last ({anchor.hash[:16]}…)"
    return JournalHead(str(path), last.n + 1 if last else 0, last.hash if last else "", wrong)


def _last(path: Path) -> Entry | None:
    """Return the last entry; what its writer has not completed is not there yet.

    Raises:
        EntryError: the last line is no entry.
        OSError: it cannot be read.
    """
    opened = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    try:
        with suppress(EntryError):
            return _read_last(opened)
        # A writer that finds a torn line ends it, and says so in the next entry: both under its lock.
        if os.name == "posix":
            fcntl.flock(opened, fcntl.LOCK_SH)
        return _read_last(opened)
    finally:
        os.close(opened)


def _read_last(opened: int) -> Entry | None:
    size = os.fstat(opened).st_size
    start = max(size - 2 * MOST_BYTES, 0)
    whole, newline, _ = os.pread(opened, size - start, start).rpartition(b"\n")
    line = whole.rpartition(b"\n")[2]
    return read(line) if newline and line else None

"""What earlier runs learned of files: which content they have, and what one parse of that content yields.

Losing it costs time, never a result. Nothing here raises: what cannot be read is forgotten, what cannot be written is
not kept, what something else wrote is not used, and ``warnings`` says so.
"""

from __future__ import annotations

import os
import sqlite3
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import islice
from pathlib import Path
from types import TracebackType
from typing import TypeVar

import msgspec

from roslens.model.failure import Failure
from roslens.store.cache_file import cache_warning, foreign_entries, open_cache_file, remove_cache_file
from roslens.store.connect import roll_back, shrink
from roslens.store.sealing.cache_codes import CacheCodes

T = TypeVar("T")

MAX_BYTES = 256 * 1024 * 1024
"""How much is kept of what parses yield; what was not used for longest goes first."""

RACY_S = 2.0
"""A file that changed less than this before it was looked at may change again under the same time stamp."""

_BATCH = 500
_DAY_S = 86_400


class FileStat(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """What a look at a file reported: as long as size, time stamp and inode are these, so is the rest.

    ``rules`` is a key of the settings by which ``language`` and ``role`` were determined.
    """

    size: int
    mtime_ns: int
    inode: int
    content_hash: str
    language: str
    role: str
    rules: str = ""


_encode_stat = msgspec.msgpack.Encoder().encode
_decode_stat = msgspec.msgpack.Decoder(FileStat).decode


class Cache:
    """The cache in one SQLite file; a context manager."""

    def __init__(self, path: Path | None, *, writable: bool, now_s: float) -> None:
        """Use :meth:`open`."""
        self.path = path
        self._writable = writable
        self._day = int(now_s) // _DAY_S
        self._connection: sqlite3.Connection | None = None
        self._warnings: list[Failure] = []
        self._grown = False
        self._others = 0
        self._stats_by = CacheCodes("stat", os.environ)
        self._facts_by = CacheCodes("facts", os.environ)

    @classmethod
    def open(cls, path: Path | None, *, writable: bool = True, now_s: float | None = None) -> Cache:
        """Open the cache at ``path``, made if it is missing; None remembers nothing.

        A damaged file is replaced by an empty one.

        Args:
            path: of the SQLite file.
            writable: whether anything is kept; any number of processes may read at once.
            now_s: the time, in seconds since 1970; tells what was not used for long.
        """
        cache = cls(path, writable=writable, now_s=time.time() if now_s is None else now_s)
        if path is not None:
            cache._connect(path)
        return cache

    @property
    def warnings(self) -> tuple[Failure, ...]:
        """What went wrong with the cache itself."""
        return (*self._warnings, *([foreign_entries(self.path, self._others)] if self._others else []))

    def __enter__(self) -> Cache:
        """Return the cache itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the file."""
        self.close()

    def close(self) -> None:
        """Let go of what is too much and close the file."""
        if self._grown:
            self.prune(MAX_BYTES)
        if self._connection is not None:
            self._connection.close()
            self._connection = None

    def stats(self, *, now_s: float) -> dict[str, FileStat]:
        """Return what is known of files, by path.

        Left out are files that were changed less than :data:`RACY_S` before ``now_s`` (seconds since 1970), or later.
        """
        newest_ns = _trusted_ns(now_s)

        def read(connection: sqlite3.Connection) -> dict[str, FileStat]:
            kept = self._own(self._stats_by, connection.execute("SELECT path, CAST(stat AS BLOB) FROM stat"))
            known = {path: _decode_stat(packed) for path, packed in kept.items()}
            return {path: stat for path, stat in known.items() if stat.mtime_ns < newest_ns}

        return self._attempt(read, {})

    def put_stats(self, stats: Mapping[str, FileStat], *, now_s: float) -> None:
        """Keep what a look at files reported.

        Args:
            stats: by path.
            now_s: when the first of them was looked at, in seconds since 1970. A file that was changed less than
                :data:`RACY_S` before is not remembered: it could change again without its time stamp telling.
        """
        newest_ns = _trusted_ns(now_s)
        keep = [
            (path, self._stats_by.sealed(path, _encode_stat(stat)))
            for path, stat in stats.items()
            if stat.mtime_ns < newest_ns and _encodes(path)
        ]
        drop = [(path,) for path, stat in stats.items() if stat.mtime_ns >= newest_ns and _encodes(path)]

        def write(connection: sqlite3.Connection) -> None:
            connection.executemany("INSERT OR REPLACE INTO stat (path, stat) VALUES (?, ?)", keep)
            connection.executemany("DELETE FROM stat WHERE path = ?", drop)

        self._change(write)

    def forget(self, paths: Iterable[str]) -> None:
        """Remove what is known of files, for instance because they are gone."""
        gone = [(path,) for path in paths if _encodes(path)]
        self._change(lambda connection: connection.executemany("DELETE FROM stat WHERE path = ?", gone))

    def get(self, keys: Iterable[str]) -> dict[str, bytes]:
        """Return what is kept under those of the keys that are known."""

        def read(connection: sqlite3.Connection) -> dict[str, bytes]:
            found: dict[str, bytes] = {}
            for batch in _batches(keys):
                marks = ", ".join("?" * len(batch))
                kept = connection.execute(
                    f"SELECT key, CAST(content AS BLOB) FROM facts JOIN blob USING (number) WHERE key IN ({marks})",  # noqa: S608 - marks only
                    batch,
                )
                found.update(self._own(self._facts_by, kept))
            return found

        return self._attempt(read, {})

    def known(self, keys: Iterable[str]) -> frozenset[str]:
        """Return those of the keys under which something is kept that :meth:`get` returns."""
        return frozenset(self.get(keys))

    def put(self, items: Mapping[str, bytes]) -> None:
        """Keep content under keys; a key always means the same content."""
        if not items:
            return

        def write(connection: sqlite3.Connection) -> None:
            insert_key = "INSERT OR IGNORE INTO facts (key, size, day, number) VALUES (?, ?, ?, ?)"
            # What something else put there is replaced by what is right.
            of_key = "number = (SELECT number FROM facts WHERE key = ?)"
            before = f"SELECT CAST(content AS BLOB) FROM blob WHERE {of_key}"  # noqa: S608 - constants
            renew = f"UPDATE blob SET content = ? WHERE {of_key}"  # noqa: S608 - constants
            number = connection.execute("SELECT coalesce(max(number), 0) FROM blob").fetchone()[0]
            for key, content in items.items():
                number += 1
                kept = self._facts_by.sealed(key, content)
                if connection.execute(insert_key, (key, len(content), self._day, number)).rowcount:
                    connection.execute("INSERT OR REPLACE INTO blob (number, content) VALUES (?, ?)", (number, kept))
                else:
                    found = connection.execute(before, (key,)).fetchone()
                    if found is not None and self._facts_by.opened(key, found[0]) is None:
                        connection.execute(renew, (kept, key))

        self._change(write)
        self._grown = True

    def replace(self, items: Mapping[str, bytes]) -> None:
        """Keep content under keys whose content changes: what is kept says itself of what it holds."""
        if not items:
            return

        def write(connection: sqlite3.Connection) -> None:
            number = connection.execute("SELECT coalesce(max(number), 0) FROM blob").fetchone()[0]
            for key, content in items.items():
                number += 1
                connection.execute("DELETE FROM blob WHERE number IN (SELECT number FROM facts WHERE key = ?)", (key,))
                connection.execute(
                    "INSERT OR REPLACE INTO facts (key, size, day, number) VALUES (?, ?, ?, ?)",
                    (key, len(content), self._day, number),
                )
                kept = self._facts_by.sealed(key, content)
                connection.execute("INSERT INTO blob (number, content) VALUES (?, ?)", (number, kept))

        self._change(write)
        self._grown = True

    def touch(self, keys: Iterable[str]) -> None:
        """Note that what is kept under the keys is still of use."""
        used = [(self._day, key, self._day) for key in keys]
        self._change(
            lambda connection: connection.executemany("UPDATE facts SET day = ? WHERE key = ? AND day <> ?", used)
        )

    def prune(self, max_bytes: int) -> int:
        """Remove what was not used for longest until at most ``max_bytes`` are left; return how many keys went."""

        def write(connection: sqlite3.Connection) -> int:
            left = connection.execute("SELECT coalesce(sum(size), 0) FROM facts").fetchone()[0]
            gone = []
            for key, size, number in connection.execute("SELECT key, size, number FROM facts ORDER BY day, number"):
                if left <= max_bytes:
                    break
                left -= size
                gone.append((key, number))
            connection.executemany("DELETE FROM facts WHERE key = ?", [(key,) for key, _number in gone])
            connection.executemany("DELETE FROM blob WHERE number = ?", [(number,) for _key, number in gone])
            return len(gone)

        removed = self._change(write) or 0
        if removed:
            self._attempt(shrink, None)
        return removed

    def _own(self, codes: CacheCodes, rows: Iterable[tuple[str, object]]) -> dict[str, bytes]:
        """Return what is this user's, by name."""
        found = {}
        for name, kept in rows:
            content = codes.opened(name, kept)
            if content is None:
                self._others += 1
            else:
                found[name] = content
        return found

    def _connect(self, path: Path) -> None:
        try:
            self._connection = open_cache_file(path, writable=self._writable)
        except (sqlite3.Error, OSError) as error:
            self._failed(error)

    def _change(self, action: Callable[[sqlite3.Connection], T]) -> T | None:
        """Run ``action`` in one transaction of its own, unless nothing may be written."""
        if not self._writable:
            return None

        def whole(connection: sqlite3.Connection) -> T:
            connection.execute("BEGIN IMMEDIATE")
            result = action(connection)
            connection.execute("COMMIT")
            return result

        return self._attempt(whole, None)

    def _attempt(self, action: Callable[[sqlite3.Connection], T], otherwise: T) -> T:
        if self._connection is None:
            return otherwise
        try:
            return action(self._connection)
        except (sqlite3.Error, msgspec.DecodeError) as error:
            roll_back(self._connection)
            self._failed(error)
            return otherwise

    def _failed(self, error: Exception) -> None:
        """Go on without what failed: a damaged file is made anew, one that cannot be written is only read."""
        damaged = not isinstance(error, sqlite3.OperationalError | OSError)
        rebuild = damaged and self._writable and not self._warnings
        self._warnings.append(cache_warning(self.path, error, rebuilt=rebuild))
        self._writable = False
        if (damaged or isinstance(error, OSError)) and self._connection is not None:
            self._connection.close()
            self._connection = None
        if rebuild and self.path is not None:
            remove_cache_file(self.path)
            self._writable = True
            self._connect(self.path)


def _trusted_ns(now_s: float) -> int:
    return int((now_s - RACY_S) * 1_000_000_000)


def _encodes(path: str) -> bool:
    """Return whether SQLite takes the path; one with undecodable bytes is looked at each time."""
    try:
        path.encode()
    except UnicodeEncodeError:
        return False
    return True


def _batches(keys: Iterable[str]) -> Iterator[list[str]]:
    rest = iter(keys)
    while batch := list(islice(rest, _BATCH)):
        yield batch

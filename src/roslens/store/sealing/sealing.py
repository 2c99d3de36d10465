"""Whether a store is as roslens of this user left it: looked at when it is opened, written when it changes.

To read a store as a whole takes longer than most runs. So beside it stands which file was last found or made whole, by
its number, size and times, under a code of the key: a file that still is that one is not read again. Nobody can set
back when a file was changed last.
"""

from __future__ import annotations

import hmac
import sqlite3
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.store.connect import roll_back
from roslens.store.sealing.seals import is_as_sealed, is_empty, is_sealed, seal, seal_all

ENDING = ".seal"
_LARGEST = 1000
_BESIDE = ("-wal", "-journal")
_MOST_ASIDE = 1000


class Sealing(msgspec.Struct, frozen=True):
    """What a store is sealed with.

    Attributes:
        key: secret of its user, its folder and its name.
        adopts: whether a store without seals is one that an earlier version left here, and is sealed as it is.
        say: called with a line for the user.
    """

    key: bytes
    adopts: bool
    say: Callable[[str], None]


class _Seen(NamedTuple):
    """A file: its device, number, size and times, and what is known of the logs beside it that are not in it yet."""

    device: int
    number: int
    size: int
    modified_ns: int
    changed_ns: int
    log: tuple[int, ...]


class SealedFile:
    """The seals of one store while it is open."""

    def __init__(self, path: Path, sealing: Sealing) -> None:
        """Look at the file before it is opened."""
        self._path = path
        self._sealing = sealing
        self._noted = _look(path)
        self._is_known = self._noted is not None and not self._noted.log and self._stamp() == self._mark(self._noted)
        self._is_sure = True

    def is_own(self, connection: sqlite3.Connection) -> bool:
        """Return whether the store that was just opened is this user's, or empty; read as a whole where not known.

        Raises:
            sqlite3.OperationalError: it cannot be read now.
        """
        if self._is_known:
            return True
        try:
            # Another process may write meanwhile: all of it is looked at as it is at one moment.
            connection.execute("BEGIN")
            try:
                return self._is_whole(connection)
            finally:
                roll_back(connection)
        except sqlite3.OperationalError as error:
            if "no such" not in str(error):
                raise
            return False
        except (sqlite3.DatabaseError, TypeError, ValueError, KeyError):
            return False

    def _is_whole(self, connection: sqlite3.Connection) -> bool:
        if is_sealed(connection):
            return is_as_sealed(connection, self._sealing.key)
        if is_empty(connection):
            return True
        if self._sealing.adopts:
            self._sealing.say(
                f"the runs in {str(self._path)!r} are of an earlier version, which did not sign them: "
                "they are signed as they are now"
            )
        return self._sealing.adopts

    def before_writing(self) -> None:
        """See whether something else has changed the file since it was looked at."""
        if _look(self._path) != self._noted:
            self._is_sure = False

    def seal(self, connection: sqlite3.Connection, anew: Sequence[tuple[str, int]] = ()) -> None:
        """Seal what a transaction added or removed, within it.

        Raises:
            sqlite3.Error: the store cannot be written.
        """
        seal(connection, self._sealing.key, anew=anew)

    def written(self) -> None:
        """Note how the file is after a transaction."""
        self._noted = _look(self._path)

    def begin(self, connection: sqlite3.Connection, version_before: int) -> None:
        """Seal a store that has none yet, or was brought to another schema just now.

        Raises:
            sqlite3.Error: the store cannot be written.
        """
        version = connection.execute("PRAGMA user_version").fetchone()[0]
        if is_sealed(connection) and version == version_before:
            return
        connection.execute("BEGIN IMMEDIATE")
        try:
            if version != version_before or not is_sealed(connection):
                seal_all(connection, self._sealing.key)
            connection.execute("COMMIT")
        except BaseException:
            roll_back(connection)
            raise
        self.written()

    def closed(self) -> None:
        """Note which file is whole now that it was closed; one that anything else changed is read when next opened."""
        now = _look(self._path)
        if now is None or now.log or not self._is_sure or (self._is_known and now == self._noted):
            return
        # One that is torn is no code of any file.
        with suppress(OSError):
            self._place.write_bytes(self._mark(now))

    def put_aside(self) -> Path | None:
        """Rename a store that is not this user's, so that a new one can be made; None where that cannot be done."""
        now = _look(self._path)
        if now is None or self._noted is None or now.number != self._noted.number:
            # Another process has put it aside already, and made a new one.
            return self._path
        for number in range(1, _MOST_ASIDE):
            aside = self._path.with_name(f"{self._path.stem}.set-aside-{number}{self._path.suffix}")
            if not aside.exists():
                break
        changed = f"{str(self._path)!r} was changed by something other than roslens of this user"
        try:
            self._path.rename(aside)
        except OSError as error:
            self._sealing.say(f"{changed}: it is not used, and nothing is kept ({error.strerror})")
            return None
        for ending in (*_BESIDE, "-shm"):
            with suppress(OSError):
                self._path.with_name(self._path.name + ending).rename(aside.with_name(aside.name + ending))
        self._sealing.say(f"{changed}: it is set aside as {aside.name!r} and not used")
        return aside

    @property
    def _place(self) -> Path:
        return self._path.with_name(self._path.name + ENDING)

    def _stamp(self) -> bytes:
        try:
            return read_bounded(self._place, _LARGEST)
        except OSError:
            return b""

    def _mark(self, seen: _Seen) -> bytes:
        return hmac.new(self._sealing.key, b"as sealed\0" + repr(tuple(seen)).encode(), "sha256").hexdigest().encode()


def _look(path: Path) -> _Seen | None:
    """Return what is seen of a file without reading it; None where there is none."""
    log = []
    for ending in _BESIDE:
        with suppress(OSError):
            found = path.with_name(path.name + ending).lstat()
            if found.st_size:
                log += [found.st_ino, found.st_size, found.st_mtime_ns]
    try:
        found = path.stat()
    except OSError:
        return None
    return _Seen(found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns, found.st_ctime_ns, tuple(log))

"""What is known of a fetched set: its lock, and a journal of what an attempt did before its lock could be written."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from threading import Lock

import msgspec

from roslens.intake.bounded_file import MOST_DOCUMENT_BYTES, read_bounded
from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml
from roslens.model.errors import UsageError
from roslens.source.fetch.repos_file import lock_text, taken_of
from roslens.source.fetch.taken import LOCK, Taken

_JOURNAL = "journal.jsonl"
_BUSY = "busy"


class Journal:
    """Keeps what became of each repository as soon as it is known; any thread may write."""

    def __init__(self, into: Path, state: Path) -> None:
        """Use the lock in ``into``, and the folder ``state`` for what is only between two locks."""
        self._into = into
        self._path = state / _JOURNAL
        self._lock = Lock()
        self._encoder = msgspec.json.Encoder()

    def known(self) -> dict[str, Taken]:
        """Return what was fetched before, by name; a line that a kill cut off is passed over.

        Raises:
            UsageError: the lock cannot be read.
        """
        found = {one.wanted.name: one for one in read_lock(self._into)}
        try:
            lines = read_bounded(self._path, MOST_DOCUMENT_BYTES).splitlines()
        except OSError:
            lines = []
        for line in lines:
            with contextlib.suppress(msgspec.DecodeError):
                one = msgspec.json.decode(line, type=Taken)
                found[one.wanted.name] = one
        return found

    def note(self, taken: Taken) -> None:
        """Keep what became of a repository.

        Raises:
            OSError: it cannot be written.
        """
        with self._lock, self._path.open("ab") as stream:
            stream.write(self._encoder.encode(taken) + b"\n")
            stream.flush()

    def close(self, taken: Mapping[str, Taken]) -> None:
        """Write the lock, whole or not at all, and let go of the journal.

        Raises:
            OSError: it cannot be written.
        """
        part = self._path.with_name(LOCK)
        part.write_text(lock_text(taken.values()), "utf-8")
        part.replace(self._into / LOCK)
        self._path.unlink(missing_ok=True)


def read_lock(into: Path) -> list[Taken]:
    """Return the lock of a folder; nothing without one.

    Raises:
        UsageError: it cannot be read.
    """
    path = into / LOCK
    try:
        return taken_of(load_yaml(read_bounded(path)) or {})
    except FileNotFoundError:
        return []
    except (OSError, UnsafeYamlError, AttributeError) as error:
        raise UsageError(
            f"it cannot be read: {error}",
            where=str(path),
            expected="what `roslens fetch` writes",
            advice="Remove it; a new one is created from the existing clones",
        ) from error


@contextlib.contextmanager
def alone(state: Path) -> Iterator[None]:
    """Hold a folder of fetched repositories for this process; a process that is gone holds nothing.

    Raises:
        UsageError: another process is fetching into it.
    """
    if os.name != "posix":
        yield
        return
    import fcntl

    with (state / _BUSY).open("w") as stream:
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise UsageError(
                "another `roslens fetch` is at work there", where=str(state.parent), expected="one at a time"
            ) from None
        yield

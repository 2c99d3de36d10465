"""Notes of people on alerts: who acknowledged one, and who muted one until when."""

from __future__ import annotations

import os
from collections.abc import Mapping
from enum import Enum
from pathlib import Path
from threading import Lock

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.model.errors import StoreError

MOST = 10_000
"""Notes that are kept; older ones go."""
LONGEST_MUTE_S = 7 * 86_400.0


class How(str, Enum):
    """What was noted: ``acknowledged`` holds while the alert lasts, ``muted`` until its end."""

    ACKNOWLEDGED = "acknowledged"
    MUTED = "muted"


class Handled(msgspec.Struct, frozen=True):
    """One note.

    Attributes:
        key: of the alert.
        how: what was noted.
        by: who did.
        at: when, in seconds since the epoch.
        since: when the alert began that was acknowledged; a later one of the same constraint is another alert.
        until: when muting ends; 0 of what is acknowledged.
        name: of the entity.
    """

    key: str
    how: How
    by: str
    at: float
    since: float = 0.0
    until: float = 0.0
    name: str = ""


class HandledAlerts:
    """The notes of one watched system, in a file that outlives the watch; may be asked from any thread."""

    def __init__(self, path: Path | None) -> None:
        """Use the file at ``path``; None keeps them in memory.

        Raises:
            StoreError: the file holds something else.
        """
        self._path = path
        self._lock = Lock()
        self._notes: dict[str, Handled] = {}
        if path is None or not path.exists():
            return
        try:
            notes = msgspec.json.decode(read_bounded(path), type=list[Handled])
        except (OSError, ValueError) as error:
            raise StoreError(
                f"what was noted of alerts cannot be read: {error}",
                where=str(path),
                expected="a file that the live page wrote",
                advice="Move it away; muted alerts then show again",
            ) from None
        self._notes = {one.key: one for one in notes}

    def of(self, key: str, since: float, now: float) -> Handled | None:
        """Return what holds of an alert that began at ``since``."""
        found = self._notes.get(key)
        if found is None:
            return None
        holds = found.until > now if found.how is How.MUTED else abs(found.since - since) < 0.001
        return found if holds else None

    def put(self, note: Handled) -> None:
        """Note something; what was noted of the same alert before holds no more.

        Raises:
            ValueError: it is muted for longer than a week, or not at all.
            StoreError: the file cannot be written; nothing is noted then.
        """
        if note.how is How.MUTED and not 0 < note.until - note.at <= LONGEST_MUTE_S:
            raise ValueError(f"muted for {note.until - note.at:.0f} s; expected up to {LONGEST_MUTE_S:.0f} s (a week)")
        self._change({**self._notes, note.key: note}, note.at)

    def take_back(self, key: str, now: float) -> None:
        """Undo what was noted of an alert; nothing where nothing was.

        Raises:
            StoreError: the file cannot be written; it holds on then.
        """
        self._change({other: note for other, note in self._notes.items() if other != key}, now)

    def _change(self, notes: Mapping[str, Handled], now: float) -> None:
        with self._lock:
            kept = [one for one in notes.values() if one.how is How.ACKNOWLEDGED or one.until > now]
            kept = sorted(kept, key=lambda one: one.at)[-MOST:]
            if self._path is not None:
                _write(self._path, msgspec.json.encode(kept))
            self._notes = {one.key: one for one in kept}


def _write(path: Path, content: bytes) -> None:
    partial = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        partial.write_bytes(content)
        partial.replace(path)
    except OSError as error:
        raise StoreError(
            f"what was noted cannot be kept: {error.strerror or error}",
            where=str(path),
            expected="a file that can be written",
            advice="Free some space, or make the folder writable",
        ) from None

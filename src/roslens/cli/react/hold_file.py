"""The hold of this user on this host: while its file is there, nothing is done to any robot from here."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Mapping
from pathlib import Path

from roslens.intake.user_folder import state_folder, write_private

_MOST_BYTES = 10_000


def hold_path(environment: Mapping[str, str]) -> Path:
    """Return where the hold lies."""
    return state_folder(environment) / "hold.json"


def hold(environment: Mapping[str, str], by: str, why: str, until_s: float | None) -> None:
    """Hold everything.

    Args:
        environment: of this process.
        by: who holds.
        why: for everybody who looks; may be empty.
        until_s: seconds since the epoch at which it ends by itself; None until it is released.

    Raises:
        OSError: it cannot be written.
    """
    reported = {"by": by, "why": why, "since": time.time(), "until": until_s}
    write_private(hold_path(environment), json.dumps(reported).encode() + b"\n")


def release(environment: Mapping[str, str]) -> bool:
    """Hold no more; return whether anything was held."""
    try:
        hold_path(environment).unlink()
    except FileNotFoundError:
        return False
    return True


class Held:
    """Returns who has put everything on hold; reads the file at each call, which takes microseconds."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        self._path = hold_path(environment)
        self._stamp = (0, 0)
        self._said = ""
        self._until: float | None = None

    def __call__(self) -> str:
        """Return who has put everything on hold and why; empty without a hold. An unreadable file is a hold."""
        try:
            found = self._path.stat()
        except FileNotFoundError:
            self._stamp = (0, 0)
            return ""
        except OSError as error:
            return f"{self._path}: {error.strerror or error}"
        if (stamp := (found.st_mtime_ns, found.st_ino)) != self._stamp:
            self._said, self._until = self._read()
            self._stamp = stamp
        if self._until is not None and time.time() >= self._until:
            return ""
        return self._said

    def _read(self) -> tuple[str, float | None]:
        try:
            file = os.open(self._path, os.O_RDONLY | os.O_NONBLOCK)
            try:
                reported = json.loads(os.read(file, _MOST_BYTES))
            finally:
                os.close(file)
            why = f": {reported['why']}" if reported["why"] else ""
            until = reported["until"]
            return f"by {reported['by']}{why}", None if until is None else float(until)
        except (OSError, ValueError, KeyError, TypeError):
            return f"{self._path} exists, but its author cannot be read", None

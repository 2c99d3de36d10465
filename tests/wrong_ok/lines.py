"""What processes print, line by line, as it comes."""

from __future__ import annotations

import json
import queue
import subprocess
import threading
import time
from collections.abc import Callable
from typing import Any

WAIT_S = 60.0


class Printed:
    """The lines that a process prints."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self.process = process
        self._came: queue.SimpleQueue[str] = queue.SimpleQueue()
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self) -> None:
        for line in self.process.stdout or ():
            self._came.put(line.rstrip("\n"))

    def line(self, seconds: float) -> str | None:
        """Return the next line; None where there is none in time."""
        try:
            return self._came.get(timeout=max(seconds, 0.0))
        except queue.Empty:
            return None

    def says(self, word: str, times: int = 1, seconds: float = WAIT_S, pause_s: float = WAIT_S) -> bool:
        """Wait until it has said a word so many times from now on; return whether it has, with no longer pause."""
        while self._came.qsize():
            self._came.get()
        end = time.monotonic() + seconds
        said, longest_s = time.monotonic(), 0.0
        while times and (line := self.line(end - time.monotonic())) is not None:
            if line == word:
                times -= 1
                longest_s = max(longest_s, time.monotonic() - said)
                said = time.monotonic()
        return not times and longest_s <= pause_s


class Lines:
    """The lines of JSON that a monitor prints.

    Attributes:
        printed: the process.
        seen: what was read so far.
    """

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self.printed = Printed(process)
        self.seen: list[dict[str, Any]] = []

    def until(self, wanted: Callable[[dict[str, Any]], Any], seconds: float = WAIT_S) -> bool:
        """Read until a line is wanted; return whether it came in time."""
        end = time.monotonic() + seconds
        while (line := self.printed.line(end - time.monotonic())) is not None:
            self.seen.append(json.loads(line))
            if wanted(self.seen[-1]):
                return True
        return False

    def states(self, entity: str, quantity: str) -> list[str]:
        """Return the states of what is judged of an entity, one after the other, as reported so far."""
        return [
            one["state"] for one in self.seen
            if one.get("is") == "verdict" and one["entity"] == entity and one["quantity"] == quantity
        ]  # fmt: skip

    def comes_to(self, *wanted: tuple[str, str, str]) -> bool:
        """Wait until entities have states in quantities, all at once; return whether they came to that."""
        return self.until(lambda _: all(self.states(one, what)[-1:] == [state] for one, what, state in wanted))

    def said(self, what: str) -> list[dict[str, Any]]:
        """Return the entries of a kind of a journal."""
        return [one for one in self.seen if one.get("what") == what]

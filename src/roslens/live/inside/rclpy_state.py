"""The state of the hook of rclpy in one process: its counter file, what it replaced, and what it claims to count.

Loaded in the node's own Python, see the package.
"""

from __future__ import annotations

import os
import time
import weakref
from collections.abc import Callable
from typing import Any

from .counter_file import CounterFile
from .slots import Slot, folder_of

CLAIM = "ROSLENS_RCLPY_HOOK"
"""Tells the preloaded library, where there is one, which messages of which process are counted here and not by it."""


class Hook:
    """The state of the hook in this process."""

    def __init__(self) -> None:
        self.counters: CounterFile | None = None
        self.begun = False
        self.below = False
        self.claimed = ""
        self.undo: list[tuple[Any, str, Any]] = []

    def open(self) -> CounterFile:
        """Return the counter file, made when it is first asked for."""
        if self.counters is None:
            self.counters = CounterFile(folder_of(os.environ))
        return self.counters

    def slot(self, kind: int, gid: bytes, topic: str, node: str, other: str = "", now: int = 0) -> Slot | None:
        """Return a slot of the counter file."""
        self.begun = True
        return self.open().slot(kind, gid, topic, node, other, now)

    def ends_with(self, endpoint: Any, slots: list[Slot]) -> Callable[[], object]:
        """Give the slots of an endpoint back when it is collected, or when what is returned is called before."""
        counters = self.open()
        of = weakref.finalize(endpoint, lambda: counters.end(slots, time.time_ns()))
        of.atexit = False
        return of

    def replace(self, owner: Any, name: str, function: Any) -> None:
        """Put a function in the place of one that ``stop`` puts back."""
        self.undo.append((owner, name, getattr(owner, name)))
        setattr(owner, name, function)

    def claim(self, direction: str) -> None:
        """Tell the preloaded library to leave messages of a direction, "taken" or "published", to this hook."""
        self.claimed += f" {direction}" if direction else ""
        os.environ[CLAIM] = f"{os.getpid()}{self.claimed}"

    def leave(self) -> None:
        """Inform the preloaded library that nothing is counted here."""
        self.claimed = ""
        os.environ.pop(CLAIM, None)

    def say(self, state: str) -> None:
        """Write the state of the hook where readers see it."""
        self.open().say(state)

    def stop(self, error: Exception) -> None:
        """Take the hook out after an error in it."""
        for owner, name, function in self.undo:
            setattr(owner, name, function)
        self.undo = []
        self.leave()
        if self.counters is not None:
            self.counters.fault()
            self.counters.say(f"rclpy: stopped after {type(error).__name__}: {error}")

    def close(self) -> None:
        """Take the counter file away at the end of the process."""
        if self.counters is not None:
            self.counters.close()

    def after_fork(self) -> None:
        """Leave the file to the parent. A child that had counted before would count into it: it counts no more."""
        if self.counters is not None:
            self.counters.release()
            self.counters = None
        if self.begun:
            for owner, name, function in self.undo:
                setattr(owner, name, function)
            self.undo = []
            self.leave()
        elif self.claimed:
            self.claim("")

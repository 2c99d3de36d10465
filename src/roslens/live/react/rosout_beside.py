"""What nodes said on /rosout, kept all the time and put beside each snapshot."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec

from roslens.live.react.actor import CarriedOut
from roslens.live.react.ros_line import RosLine
from roslens.model.acting.order import OrderError, Reply
from roslens.model.acting.reaction import Reaction

BEFORE_S = 60.0
TOPIC = "/rosout"
_ID = "rosout/"
_ASKED = {"topics": [TOPIC], "before": BEFORE_S, "after": 0.0}


class RosoutBeside:
    """Has every line keep /rosout where any reaction takes a snapshot.

    A snapshot counts as done with what the monitor knows; where /rosout cannot be written, its text says so.
    """

    def __init__(self, lines: Sequence[RosLine]) -> None:
        self._lines = lines
        self._keeping = False
        self._waiting: dict[str, tuple[CarriedOut, int]] = {}

    def prepare(self, reactions: Sequence[Reaction]) -> None:
        """Begin to keep what is said, once a reaction asks for snapshots."""
        if self._keeping or not any(step.action.kind == "snapshot" for one in reactions for step in one.steps):
            return
        self._keeping = True
        for line in self._lines:
            line.prepare(f"{_ID}prepare", "record", "", _ASKED)

    def add(self, done: CarriedOut, folder: Path) -> bool:
        """Have it written into the folder of a snapshot that was taken; return whether :meth:`take` reports it."""
        asked = 0
        for line in self._lines if self._keeping and done.done else ():
            path = str(folder / f"rosout-ros{line.generation}.mcap")
            try:
                line.do(f"{_ID}{done.decision}", "record", "", {**_ASKED, "path": path})
            except OrderError:
                continue
            asked += 1
        if asked:
            self._waiting[done.decision] = done, asked
        return bool(asked)

    def take(self, reply: Reply) -> tuple[bool, CarriedOut | None]:
        """Return whether a reply is about this, and the snapshot once all of it was written."""
        if not reply.id.startswith(_ID):
            return False, None
        decision = reply.id.removeprefix(_ID)
        if decision not in self._waiting:
            return True, None
        done, left = self._waiting.pop(decision)
        text = reply.text if reply.done else f"without {TOPIC}: {reply.text}"
        done = msgspec.structs.replace(done, text=f"{done.text}; {text}")
        if left == 1:
            return True, done
        self._waiting[decision] = done, left - 1
        return True, None

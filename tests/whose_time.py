"""Whose programs had the processors: those of the process that started this one, or others.

What a test starts may take all processors, and everything then comes late; that is the test's own doing. So the time
that a process and all that it ever started took is subtracted from what was taken of the machine.
"""

from __future__ import annotations

import os
import time
from collections import deque
from typing import NamedTuple

MOSTLY = 0.85
"""Share of what was taken of the processors from which on it was the test that took them. A test that keeps eight
processes busy has less where two other workers are as busy."""
FULL = 0.7
"""Share of all processors that has to be taken for anything to be late because of it."""
_TICKS_A_SECOND = os.sysconf("SC_CLK_TCK")
_KEPT_S = 5.0


class Taken(NamedTuple):
    """Processor seconds that were taken up to a time: by all, and by a process and what it started."""

    time: float
    all: float
    own: float


class Family:
    """A process and all that it ever started; a process that lost its parent still belongs to it."""

    def __init__(self, root: int, without: int) -> None:
        self._root = root
        self._without = without
        self._known: set[tuple[int, str]] = set()
        self._looked: deque[Taken] = deque()

    def look(self) -> Taken:
        """Note what was taken up to now."""
        found = Taken(time.monotonic(), _taken_of_machine(), self._taken())
        self._looked.append(found)
        while self._looked[0].time < found.time - _KEPT_S:
            self._looked.popleft()
        return found

    def was_it(self, begun: float) -> bool:
        """Return whether it was the family that kept the processors from everybody since `begun`."""
        now = self.look()
        before = next((one for one in reversed(self._looked) if one.time <= begun), self._looked[0])
        return is_own(before, now, now.time - begun, len(os.sched_getaffinity(0)))

    def _taken(self) -> float:
        processes = {}
        for name in os.listdir("/proc"):  # noqa: PTH208 - as below
            if name.isdigit() and int(name) != self._without:
                try:
                    with open(f"/proc/{name}/stat") as file:  # noqa: PTH123 - once a second, of all processes
                        values = file.read().rpartition(")")[2].split()
                except OSError:
                    continue
                ticks = sum(int(value) for value in values[11:15])  # its own, and of those that it waited for
                processes[int(name)] = int(values[1]), values[19], ticks / _TICKS_A_SECOND
        own = {pid for pid, (_, born, _) in processes.items() if (pid, born) in self._known or pid == self._root}
        grown = True
        while grown:
            more = {pid for pid, (parent, _, _) in processes.items() if parent in own} - own
            own |= more
            grown = bool(more)
        self._known = {(pid, processes[pid][1]) for pid in own}
        return sum(processes[pid][2] for pid in own)


def is_own(before: Taken, now: Taken, late_s: float, processors: int) -> bool:
    """Return whether a family kept all processors so busy between two looks that others were late for so long."""
    own, of_all = now.own - before.own, now.all - before.all
    return own >= MOSTLY * of_all and own >= FULL * processors * late_s


def _taken_of_machine() -> float:
    """Return the processor seconds that were not idle, those included that the machine below had."""
    with open("/proc/stat") as file:  # noqa: PTH123 - as above
        user, nice, system, _, _, *rest = (int(value) for value in file.readline().split()[1:9])
    return (user + nice + system + sum(rest)) / _TICKS_A_SECOND

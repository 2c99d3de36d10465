"""Whether this machine gave a test its time, by a process that does nothing but sleep and look how late it wakes.

A test that talks to running nodes, to a browser or to a clock is about when things happen. On a machine that others use
too, everything may stand still for a second or take thrice its time, and nodes then lose messages as they should.
"""

from __future__ import annotations

import os
import select
import subprocess
import sys
import time

from pace import slowness

LATE_S = 0.1
"""A sleeper woken later than this means that no program got its time."""
SLOW = 1.6
"""Processor time for an empty loop, in that of a calm machine, from which on what shall happen in time may not."""
_SLEEPER = """
import select, sys, time
while not select.select([sys.stdin], [], [], 0)[0]:
    begun = time.monotonic()
    time.sleep(0.02)
    late = time.monotonic() - begun - 0.02
    if late > float(sys.argv[1]):
        sys.stdout.write(f"{time.monotonic()} {late}\\n")
        sys.stdout.flush()
"""


class Sleeper:
    """A process that tells when it was woken late; ends with its parent."""

    def __init__(self) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-S", "-c", _SLEEPER, str(LATE_S)], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        self._told: list[tuple[float, float]] = []
        self._rest = b""

    def worst_s(self, begun: float) -> float:
        """By how many seconds it was woken late at most since `begun`, a `time.monotonic()`."""
        assert self._process.stdout
        descriptor = self._process.stdout.fileno()
        while select.select([descriptor], [], [], 0)[0] and (read := os.read(descriptor, 65536)):
            *lines, self._rest = (self._rest + read).split(b"\n")
            for line in lines:
                moment, late = map(float, line.split())
                self._told.append((moment, late))
        return max((late for moment, late in self._told if moment >= begun), default=0.0)

    def end(self) -> None:
        """End the process."""
        assert self._process.stdin
        assert self._process.stdout
        self._process.stdin.close()
        self._process.wait(10)
        self._process.stdout.close()


class Watched:
    """What is known of the machine since the current test began."""

    def __init__(self, sleeper: Sleeper) -> None:
        self._sleeper = sleeper
        self._begun = time.monotonic()

    def begin(self) -> None:
        """Begin a test."""
        self._begun = time.monotonic()

    def starved(self) -> str:
        """What the machine did to the test, or nothing: then what failed is the test's own failure."""
        if (late := self._sleeper.worst_s(self._begun)) > LATE_S:
            return f"a sleeping process was woken {late:.2f} s late"
        if (slow := slowness()) > SLOW:
            return f"an empty loop takes {slow:.1f} times what it takes on a calm machine"
        return ""

"""Whether this machine gave a test its time, by a process that does next to nothing and looks how long that takes.

A test that talks to running nodes, to a browser or to a clock is about when things happen. On a machine that others use
too, everything may stand still for a second or take thrice its time, and nodes then lose messages as they should.
What the test itself took, with all that it started, is subtracted (`whose_time.py`): a test that starves itself fails.
"""

from __future__ import annotations

import os
import select
import subprocess
import sys
import time
from pathlib import Path

from pace import CALM_NS

HERE = Path(__file__).parent

WAKE_EVERY_S = 0.05
"""How long the sleeper sleeps at a time."""
LATE_S = 0.1
"""A sleeper woken later than this means that no program got its time."""
SLOW = 1.6
"""Processor time for an empty loop, in that of a calm machine, from which on what shall happen in time may not."""
CROWDED = 2.0
"""Time for a loop, in what it takes of a processor, from which on others have more of the machine than the test."""
LOOK_EVERY_S = 4.0
"""How often the sleeper turns a loop; takes half a hundredth of one processor."""
COUNT_EVERY_S = 1.0
"""How often the sleeper looks who took how much; takes half a hundredth of one processor."""
ANSWER_S = 20.0
"""A sleeper that answers later than this has told enough."""
_SLEEPER = """
import os, select, sys, time
sys.path.insert(0, HERE)
from whose_time import Family

family = Family(os.getppid(), os.getpid())

def look():
    begun, used, best = time.monotonic(), time.process_time(), 1.0
    while time.process_time() - used < 0.02:
        before = time.process_time()
        for _ in range(20_000):
            pass
        best = min(best, time.process_time() - before)
    taken = time.monotonic() - begun
    slow, crowded = best / 20_000 * 1e9 / CALM_NS, taken / (time.process_time() - used)
    own = "own " if (slow > SLOW or crowded > CROWDED) and family.was_it(begun) else ""
    tell(own + "slow", slow)
    tell(own + "crowded", crowded)

def tell(what, much):
    os.write(1, f"{what} {time.monotonic()} {much}\\n".encode())

def watch():
    looked = counted = 0.0
    while True:
        begun = time.monotonic()
        asked = select.select([0], [], [], WAKE_EVERY_S)[0]
        late = time.monotonic() - begun - WAKE_EVERY_S
        if late > LATE_S:
            tell("own late" if family.was_it(begun) else "late", late)
        elif begun - counted > COUNT_EVERY_S:
            counted = begun
            family.look()
        if asked and not os.read(0, 1):
            break
        if asked or begun - looked > LOOK_EVERY_S:
            looked = begun
            look()
        if asked:
            tell("that is all", 0.0)

try:
    watch()
except (BrokenPipeError, KeyboardInterrupt):
    pass  # nobody listens any more
"""


class Sleeper:
    """A process that tells when it was woken late, and how fast a loop turns; ends with its parent.

    What its parent did itself, and all that this started, is told with the word `own` before it.
    """

    def __init__(self) -> None:
        bounds = f"CALM_NS, LATE_S, LOOK_EVERY_S, WAKE_EVERY_S = {CALM_NS}, {LATE_S}, {LOOK_EVERY_S}, {WAKE_EVERY_S}\n"
        bounds += f"SLOW, CROWDED, COUNT_EVERY_S, HERE = {SLOW}, {CROWDED}, {COUNT_EVERY_S}, {str(HERE)!r}\n"
        self._process = subprocess.Popen(
            [sys.executable, "-S", "-c", bounds + _SLEEPER], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        assert self._process.stdin
        assert self._process.stdout
        self._ask = self._process.stdin.fileno()
        self._answers = self._process.stdout.fileno()
        self._told: list[tuple[str, float, float]] = []
        self._rest = b""

    def told(self, begun: float) -> dict[str, list[float]]:
        """What it noticed since `begun`, a `time.monotonic()`: seconds it was late, how slow, how crowded."""
        os.write(self._ask, b"?")
        while not self._read(ANSWER_S):
            pass
        found: dict[str, list[float]] = {}
        for what, moment, much in self._told:
            if moment >= begun:
                found.setdefault(what, []).append(much)
        return found

    def forget(self, before: float) -> None:
        """Forget what it noticed earlier, which it could not go on telling for ever if nobody read."""
        self._read(0.0)
        self._told = [one for one in self._told if one[1] >= before]

    def _read(self, wait_s: float) -> bool:
        """Read what it says; true if that was all, or if it says nothing."""
        if not select.select([self._answers], [], [], wait_s)[0]:
            if wait_s:
                self._told.append(("late", time.monotonic(), wait_s))
            return True
        if not (read := os.read(self._answers, 65536)):
            raise RuntimeError("the process that watches the machine has ended")
        *lines, self._rest = (self._rest + read).split(b"\n")
        ended = False
        for line in lines:
            what, moment, much = line.decode().rsplit(" ", 2)
            ended |= what == "that is all"
            self._told.append((what, float(moment), float(much)))
        return ended

    def end(self) -> None:
        """End the process."""
        assert self._process.stdin
        assert self._process.stdout
        self._process.stdin.close()
        self._process.stdout.close()
        self._process.wait(ANSWER_S)


class Watched:
    """What is known of the machine since the current test began."""

    def __init__(self, sleeper: Sleeper) -> None:
        self._sleeper = sleeper
        self._begun = time.monotonic()

    def begin(self, begun: float) -> None:
        """Watch a test for which counts what happened since `begun`, a `time.monotonic()`."""
        self._begun = begun
        self._sleeper.forget(begun)

    def starved(self) -> str:
        """What the machine did to the test, or nothing: then what failed is the test's own failure."""
        told = self._sleeper.told(self._begun)
        if (late := max(told.get("late", [0.0]))) > LATE_S:
            return f"a sleeping process was woken {late:.2f} s late"
        if (slow := max(told.get("slow", [1.0]))) > SLOW:
            return f"an empty loop took {slow:.1f} times what it takes on a calm machine"
        if (crowded := max(told.get("crowded", [1.0]))) > CROWDED:
            return f"a loop took {crowded:.1f} times what it took of a processor, for others had it"
        return ""

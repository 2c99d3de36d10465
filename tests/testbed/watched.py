"""The robot watched by roslens as a user would: nodes under `roslens run`, an agent on each host, a monitor on base."""

import json
import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple

from testbed.clock import faked
from testbed.hosts import HERE, Bed
from testbed.machine import BedError
from testbed.process import Process
from testbed.robot import HOSTS, Robot
from testbed.robot_ros1 import Ros1Robot
from testbed.robot_ros2 import Ros2Robot
from testbed.robot_ros2 import python as ros2_python

ROSLENS = str(Path(sys.executable).parent / "roslens")
REFERENCE = HERE / "faults.yaml"
MONITOR = "base"
PORT = 7411
BAD = frozenset(("low", "high", "absent"))
STEP = 0.02
CALM = 1.5
GRACE = 3.0
"""As in the reference: what is bad so soon after it came is not told, so that a fault has to wait until then."""
_AGENTS = tuple(name for name in HOSTS if name != MONITOR)  # the monitor samples its own host


class Told(NamedTuple):
    """One change of a verdict, as a line of `roslens watch --format json` has it."""

    time: float = 0.0
    entity: str = ""
    quantity: str = ""
    state: str = ""
    since: float = 0.0
    cause: str = ""
    value: float | None = None

    @property
    def key(self) -> tuple[str, str]:
        """What is judged: entity and quantity."""
        return self.entity, self.quantity

    @property
    def bad(self) -> bool:
        """Whether it is an alarm."""
        return self.state in BAD


class Watched:
    """A context manager: bed, robot, agents and monitor up on entry, gone on exit.

    Args:
        generation: "ros1" or "ros2".
        faked_clock: A host whose nodes and agent run under faketime.

    Attributes:
        reported: Every change of a verdict so far.
        failures: What could not be done, by the monitor's words, with the wall clock time at which it was read.
    """

    def __init__(self, generation: str, *, faked_clock: str = "") -> None:
        self.generation = generation
        self.bed = Bed(HOSTS, "shaped")
        self.robot: Robot
        self.monitor: Process
        self.agents: dict[str, Process] = {}
        self.reported: list[Told] = []
        self.failures: list[tuple[float, str]] = []
        self._faked = [faked_clock] if faked_clock else []
        self._read = 0
        self._rest = ""

    def __enter__(self) -> "Watched":
        self.bed.__enter__()
        try:
            self._start()
        except BaseException:
            self.bed.__exit__(None, None, None)
            raise
        return self

    def __exit__(self, *raised: type[BaseException] | BaseException | TracebackType | None) -> None:
        self.bed.__exit__()

    def _start(self) -> None:
        made = {"ros1": Ros1Robot, "ros2": Ros2Robot}[self.generation]
        self.robot = made(self.bed, before=[ROSLENS, "run", "--"], faked_clocks=self._faked)
        self.robot.start()
        base = self.bed[MONITOR]
        key = self.bed.folder / "key"
        base.run([ROSLENS, "agent", "--new-key", str(key)])
        address = f"{base.address}:{PORT}"
        words = [ROSLENS, "watch", f"--{self.generation}", "--listen", address, "--key-file", str(key)]
        words += ["--reference", str(REFERENCE), "--format", "json"]
        environment = {**self.robot.environment(base), "ROSLENS_ROS2_PYTHON": ros2_python()}
        self.monitor = base.start(words, environment, name="watch")
        for name in _AGENTS:
            host = self.bed[name]
            clock = faked(host) if name in self._faked else {}
            self.agents[name] = host.start([ROSLENS, "agent", address, "--key-file", str(key)], clock, name="agent")

    def read(self) -> list[Told]:
        """What the monitor has told since the last call."""
        with self.monitor.log.open() as log:
            log.seek(self._read)
            text = log.read()
            self._read = log.tell()
        *lines, self._rest = (self._rest + text).split("\n")
        fresh = [one for line in lines if line.startswith("{") and (one := self._line(json.loads(line)))]
        self.reported += fresh
        return fresh

    def _line(self, line: dict[str, Any]) -> Told | None:
        if line["is"] == "failure":
            self.failures.append((time.time(), line["what"]))
        if line["is"] != "verdict":
            return None
        known: dict[str, Any] = {name: line.get(name, usual) for name, usual in Told._field_defaults.items()}
        return Told(**known)

    def standing(self) -> dict[tuple[str, str], Told]:
        """The last that was told of each sentence."""
        self.read()
        return {one.key: one for one in self.reported}

    def wait(self, what: str, done: Callable[[], bool], limit: float) -> None:
        """Waits until `done()`; raises BedError after `limit` seconds with how everything stands."""
        until = time.monotonic() + limit
        while not done():
            if not self.monitor.running:
                raise BedError(f"the monitor ended with {self.monitor.code}: {self.monitor.output()[-2000:]}")
            if time.monotonic() > until:
                rest = sorted(f"{one.key} {one.state} {one.value}" for one in self.standing().values())
                raise BedError(f"waited {limit} s in vain until {what}; {rest}; {self.failures[-5:]}")
            time.sleep(STEP)

    def wait_until_ok(self, keys: Iterable[tuple[str, str]], limit: float = 40.0) -> None:
        """Waits until `keys` are ok, their grace is over, and nothing was bad for a while."""
        needed = set(keys)

        def ok() -> bool:
            standing = self.standing()
            if any(one.bad for one in standing.values()):
                return False
            if not all(key in standing and standing[key].state == "ok" for key in needed):
                return False
            if time.time() - max(standing[key].time for key in needed) < GRACE:
                return False
            # The last change that ended an alarm; what only became known does not count.
            alarms = (one.time for one in self.reported if one.key in self.alarmed)
            return time.time() - max(alarms, default=0.0) >= CALM

        try:
            self.wait("all is ok", ok, limit)
        except BedError as error:
            standing = self.standing()
            wrong = {key: standing.get(key) for key in needed | {one.key for one in standing.values() if one.bad}}
            missing = {key: one and one.state for key, one in wrong.items() if one is None or one.state != "ok"}
            raise BedError(f"not ok after {limit} s: {missing}; {error}") from None

    @property
    def silent(self) -> list[Told]:
        """When it was told that nothing is heard of an observer."""
        return [one for one in self.reported if one.entity.startswith("observer:") and one.state == "unknown"]

    @property
    def alarmed(self) -> set[tuple[str, str]]:
        """What was bad at any time."""
        return {one.key for one in self.reported if one.bad}

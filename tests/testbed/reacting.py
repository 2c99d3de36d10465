"""The robot watched by `roslens react` with agents that act: nothing of it is done by the test bed."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from testbed.clock import faked
from testbed.hosts import HERE
from testbed.machine import BedError
from testbed.robot import HOSTS
from testbed.robot_ros1 import Ros1Robot
from testbed.robot_ros2 import Ros2Robot
from testbed.robot_ros2 import python as ros2_python
from testbed.watched import MONITOR, PORT, REFERENCE, ROSLENS, STEP, Watched

REQUESTS = 7412
ACTIONS = HERE / "actions.yaml"
WORDS = {
    "ros1": {
        "STOP_TYPE": "std_msgs/Bool",
        "LATE_SIGNAL": "age",
        "LOSS_SELECTED": "host: sensor",
        "LOSS_SIGNAL": "resent",
    },
    "ros2": {
        "STOP_TYPE": "std_msgs/msg/Bool",
        "LATE_SIGNAL": "latency",
        "LOSS_SELECTED": "connection: /scan",
        "LOSS_SIGNAL": "loss",
    },
}
ALLOWED = """\
nodes:
  - name: "/{odometry,lidar,camera,planner}"
    actions: [start, restart, stop]
    program: "**"
commands:
  - name: tidy
    run: [/usr/bin/find, DISK, -name, "filler-*", -delete]
"""


@dataclass(frozen=True)
class Done:
    """One entry of the journal about an action: when, what, of which decision and reaction."""

    time: float
    what: str
    decision: str
    fields: dict[str, Any]

    @property
    def reaction(self) -> str:
        """The reaction's id, without the document's name."""
        return self.decision.partition("/")[0].partition(".")[2]


class Reacting(Watched):
    """As `Watched`, but the monitor is `roslens react --mode act`.

    Attributes:
        journal: Entries about decisions so far, in their order.
    """

    def __init__(self, generation: str, *, faked_clock: str = "") -> None:
        super().__init__(generation, faked_clock=faked_clock)
        self.journal: list[Done] = []
        self.words: list[str] = []
        self.environment: dict[str, str] = {}

    def _start(self) -> None:
        made = {"ros1": Ros1Robot, "ros2": Ros2Robot}[self.generation]
        self.robot = made(self.bed, before=[ROSLENS, "run", "--"], faked_clocks=self._faked)
        self.robot.start()
        base = self.bed[MONITOR]
        folder = self.bed.folder
        key, keys, actions = folder / "key", folder / "keys", folder / "actions.yaml"
        base.run([ROSLENS, "agent", "--new-key", str(key)])
        text = ACTIONS.read_text()
        for word, value in WORDS[self.generation].items():
            text = text.replace(word, value)
        actions.write_text(text)
        for name in HOSTS:
            allowed = ALLOWED.replace("DISK", str(self.bed[name].disk))
            if name == MONITOR:
                allow = folder / "allow.yaml"
            else:
                base.run([ROSLENS, "agent", "--enrol", str(keys), "--name", name])
                allow = keys / name / "allow.yaml"
            allow.write_text(allowed)
            allow.chmod(0o600)
        address = f"{base.address}:{PORT}"
        self.words = [
            *[ROSLENS, "react", str(REFERENCE), str(actions), "--mode", "act", "--json", "--verbose"],
            *[
                f"--{self.generation}",
                "--listen",
                address,
                "--key-file",
                str(key),
                "--allow",
                str(folder / "allow.yaml"),
            ],
            *["--enrolled", str(keys / "monitor"), "--agents", f"{base.address}:{REQUESTS}"],
            *["--journal", str(folder / "journal.jsonl"), "--cool-down", "5s", "--at-most", "1000"],
            *["--most-restarts", "1000"],
        ]
        self.environment = {**self.robot.environment(base), "ROSLENS_ROS2_PYTHON": ros2_python()}
        self.environment["XDG_STATE_HOME"] = str(folder / "state-base")
        self.monitor = base.start(self.words, self.environment, name="react")
        for name in HOSTS:
            if name == MONITOR:
                continue
            clock = faked(self.bed[name]) if name in self._faked else {}
            words = [ROSLENS, "agent", address, "--key-file", str(key), "--enrolled", str(keys / name), "--name", name]
            state = {"XDG_STATE_HOME": str(folder / f"state-{name}")}
            self.agents[name] = self.bed[name].start(words, {**clock, **state}, name="agent")

    def _line(self, line: dict[str, Any]) -> Any:
        if line["is"] == "journal":
            decision = line["fields"].get("decision", "")
            self.journal.append(Done(line["time"], line["what"], decision, line["fields"]))
        return super()._line(line)

    def well(self) -> bool:
        """Whether the monitor sees the robot, so that it may decide."""
        self.read()
        return any(one.what == "well" for one in self.journal)

    def announced(self, since: float) -> list[Done]:
        """What was begun since a moment of the wall clock."""
        return [one for one in self.journal if one.what == "announced" and one.time >= since]

    def of(self, decision: str, what: str) -> Done | None:
        """The last entry of a kind about a decision."""
        return next((one for one in reversed(self.journal) if (one.decision, one.what) == (decision, what)), None)

    def settle(self, needed: set[tuple[str, str]], limit: float = 60.0) -> None:
        """Waits until all is ok, and nothing was decided or is under way for a while."""
        self.wait_until_ok(needed, limit)

        def calm() -> bool:
            self.read()
            last = max((one.time for one in self.journal), default=0.0)
            return time.time() - last > 6.0

        until = time.monotonic() + limit
        while not calm():
            if time.monotonic() > until:
                raise BedError(f"something is done all the time: {self.journal[-5:]}")
            time.sleep(STEP)

    def look(self, done: Callable[[], bool], limit: float) -> bool:
        """Reads until something is so; returns whether it is in time."""
        until = time.monotonic() + limit
        while time.monotonic() < until:
            self.read()
            if done():
                return True
            time.sleep(STEP)
        return False

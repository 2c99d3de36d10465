"""A robot on three hosts: base (odometry), sensor (lidar, camera), brain (planner). The nodes are in examples/.

odometry --/odom 50 Hz--> planner --/cmd_vel 20 Hz--> odometry
lidar --/scan 25 Hz--> planner            camera --/camera/image 10 Hz, 60 kB--> planner
planner --/planner/status 0.3 Hz--> nobody
"""

import json
from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

from testbed.clock import faked
from testbed.hosts import Bed, Host
from testbed.process import Process

EXAMPLES = Path(__file__).parents[2] / "examples" / "robot"
HOSTS = ("base", "sensor", "brain")
START_LIMIT = 60.0


@dataclass(frozen=True)
class Node:
    """One node: where it runs, what it publishes and how often (topic to Hz)."""

    name: str
    host: str
    rates: Mapping[str, float]


NODES = (
    Node("odometry", "base", {"/odom": 50}),
    Node("lidar", "sensor", {"/scan": 25}),
    Node("camera", "sensor", {"/camera/image": 10}),
    Node("planner", "brain", {"/cmd_vel": 20, "/planner/status": 0.3}),
)
RATES = {topic: rate for node in NODES for topic, rate in node.rates.items()}


@dataclass(frozen=True)
class Heard:
    """What a listener heard: seconds until every topic had been heard once, and messages per second from then on."""

    waited: float
    rates: dict[str, float]


class Robot(ABC):
    """A context manager: the robot's nodes run in the hosts of a bed made with `HOSTS`.

    Args:
        bed: Where it runs; ends with it at the latest.
        loads: For a node's name, its load as `examples/robot/load.py` takes it: {"lidar": {"rate": 5, "burn": 0.5}}.
        before: Words to put before the command of each node, as in `roslens run -- COMMAND`.
        environment: Set for every node.
        faked_clocks: Hosts whose nodes run under faketime, for `clock.shifted`.

    Attributes:
        processes: The running programs by node name.
    """

    generation = ""

    def __init__(
        self,
        bed: Bed,
        *,
        loads: Mapping[str, Mapping[str, float]] | None = None,
        before: Sequence[str] = (),
        environment: Mapping[str, str] | None = None,
        faked_clocks: Collection[str] = (),
    ) -> None:
        self.bed = bed
        self.processes: dict[str, Process] = {}
        self._loads = loads or {}
        self._before = before
        self._environment = environment or {}
        self._faked_clocks = faked_clocks

    @abstractmethod
    def python(self) -> str:
        """The interpreter that runs the nodes."""

    @abstractmethod
    def environment(self, host: Host) -> dict[str, str]:
        """What a program in `host` needs in its environment to take part."""

    def __enter__(self) -> "Robot":
        try:
            self.start()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *raised: type[BaseException] | BaseException | TracebackType | None) -> None:
        self.stop()

    def start(self) -> None:
        """Starts all nodes."""
        for node in NODES:
            host = self.bed[node.host]
            load = [f"--{key}={value}" for key, value in self._loads.get(node.name, {}).items()]
            program = str(EXAMPLES / f"{self.generation}_{node.name}.py")
            clock = faked(host) if node.host in self._faked_clocks else {}
            changes = {"ROBOT_CHANGES": str(self.changes(node.name))}
            self.processes[node.name] = host.start(
                [*self._before, self.python(), program, *load],
                {**self.environment(host), **self._environment, **changes, **clock},
                name=node.name,
            )

    def changes(self, node: str) -> Path:
        """The file from which a running node takes delay, leak and burn; see `faults.loaded`."""
        return next(self.bed[one.host].folder / f"{node}.changes" for one in NODES if one.name == node)

    def stop(self) -> None:
        """Ends all nodes."""
        for process in reversed(self.processes.values()):
            process.kill()

    def listen(
        self, host: str, seconds: float = 3.0, *, topics: Collection[str] = tuple(RATES), limit: float = 20.0
    ) -> Heard:
        """Listens in `host`: waits for each topic's first message, then counts for `seconds`.

        Raises:
            BedError: A topic was silent for `limit` seconds; the message names it.
        """
        found = self._listen(host, [str(seconds), str(limit), *topics], seconds + limit)
        return Heard(found["waited"], found["rates"])

    def stamp_ages(self, host: str, topic: str, seconds: float, *, limit: float = 20.0) -> list[float]:
        """Seconds from time stamp to receipt in `host` of each message with a header, with the clocks as they are."""
        ages: list[float] = self._listen(host, ["--ages", str(seconds), str(limit), topic], seconds + limit)["ages"][
            topic
        ]
        return ages

    def _listen(self, host: str, words: Sequence[str], longest: float) -> dict[str, Any]:
        where = self.bed[host]
        listener = str(Path(__file__).parent / f"listen_{self.generation}.py")
        done = where.run([self.python(), listener, *words], self.environment(where), limit=longest + START_LIMIT)
        found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
        return found

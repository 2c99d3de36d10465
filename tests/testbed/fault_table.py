"""Runs every fault against the watched robot and prints the table of docs/faults.md.

sudo PYTHONPATH=tests .venv/bin/python -m testbed.fault_table [ros1|ros2] [FAULT...]
"""

import contextlib
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass

from testbed import clock, faults, robot_ros1, robot_ros2
from testbed.faults import Fault, in_force
from testbed.machine import BedError
from testbed.robot_ros1 import Ros1Robot
from testbed.watched import STEP, Told, Watched

Key = tuple[str, str]
BOTH = ("ros1", "ros2")
FAKED = "sensor"  # no node there receives: timed waits of Python 3.11 never end under faketime 0.9.10
ALARM_LIMIT = 15.0
HELD = 2.0
MISFIT = "gets nothing of what"

SCAN = "connection:/lidar > /scan > /planner"
NODES = ("/odometry", "/lidar", "/camera", "/planner")


@dataclass(frozen=True)
class Case:
    """A fault, and what has to be told of it.

    Attributes:
        name: Of the row.
        begin: Makes the fault in the watched robot.
        right: By generation, entity and quantity of which one has to be told first.
        says: A failure with these words has to be told, where no verdict is about such a fault.
        allowed: Seconds until the alarm at most: one window or one sample, one frame, 0.2 s.
    """

    name: str
    begin: Callable[[Watched], AbstractContextManager[Fault]]
    right: dict[str, frozenset[Key]]
    allowed: float
    says: str = ""


@dataclass(frozen=True)
class Row:
    """What came of a case; times in seconds, None for what was not told."""

    name: str
    generation: str
    told: str
    alarm: float | None
    ok: float | None
    consequences: tuple[str, ...]
    others: tuple[str, ...]
    allowed: float

    @property
    def right(self) -> bool:
        """Whether it was told, in time, and nothing else was."""
        return self.alarm is not None and self.alarm <= self.allowed and self.ok is not None and not self.others


def _both(*keys: Key) -> dict[str, frozenset[Key]]:
    return dict.fromkeys(BOTH, frozenset(keys))


@contextlib.contextmanager
def _crash_and_restart(watched: Watched) -> Iterator[Fault]:
    lidar = watched.robot.processes["lidar"]

    def again() -> None:
        lidar.kill()
        lidar.start_again()

    with in_force("crash and restart", "lidar", again, lambda: None) as fault:
        yield fault


@contextlib.contextmanager
def _master_restart(watched: Watched) -> Iterator[Fault]:
    robot = watched.robot
    assert isinstance(robot, Ros1Robot)
    master = robot.master
    assert master is not None

    def restart() -> None:
        master.stop()
        master.start_again()

    def renew_nodes() -> None:
        robot.wait_for_master()
        for process in robot.processes.values():
            process.kill()
            process.start_again()

    with in_force("master restart", "base", restart, renew_nodes) as fault:
        yield fault


@contextlib.contextmanager
def _misfit(watched: Watched, kind: str) -> Iterator[Fault]:
    host, robot = watched.bed["brain"], watched.robot
    program = str(faults.__file__).replace("faults.py", "misfit_ros2.py")
    started = []

    def start() -> None:
        started.append(host.start([robot.python(), program, kind], robot.environment(host), name=f"misfit-{kind}"))

    with in_force(f"{kind} misfit", "brain", start, lambda: started[0].kill()) as fault:
        yield fault


def _load(node: str, **load: float) -> Callable[[Watched], AbstractContextManager[Fault]]:
    return lambda watched: faults.loaded(watched.robot.changes(node), node, **load)


CASES = (
    # A window of 1 s, told once a second.
    Case("rate of the lidar drops, 25 to 10 Hz", _load("lidar", delay=0.1), _both(("topic:/scan", "rate")), 2.2),
    Case(
        "sensor's link is 20 ms slower", lambda w: faults.delay(w.bed, "sensor", 20),
        {"ros1": frozenset({(SCAN, "age")}), "ros2": frozenset({(SCAN, "latency")})}, 2.2,
    ),
    Case(
        "5 % loss on the sensor's link", lambda w: faults.loss(w.bed, "sensor", 5),
        {"ros1": frozenset({("host:sensor", "resent")}), "ros2": frozenset({(SCAN, "loss")})}, 8.0,
    ),
    # The time is asked for every 2 s, told every second; faketime looks at its file once a second.
    Case(
        "clock of the sensor host is 250 ms ahead", lambda w: clock.shifted(w.bed[FAKED], 0.25),
        _both((f"host:{FAKED}", "clock_offset")), 4.2,
    ),
    # Sampled every second.
    Case("camera burns a CPU", _load("camera", burn=0.95), _both(("node:/camera", "cpu")), 3.2),
    Case("camera leaks 60 MB/s", _load("camera", leak=60), _both(("node:/camera", "memory")), 5.0),
    Case("disk of the sensor host is full", lambda w: faults.full_disk(w.bed["sensor"]),
         _both(("host:sensor", "disk_free")), 1.2),
    Case("lidar freezes", lambda w: faults.frozen(w.robot.processes["lidar"]), _both(("topic:/scan", "rate")), 2.2),
    Case("lidar crashes", lambda w: faults.killed(w.robot.processes["lidar"]),
         _both(("node:/lidar", "presence")), 0.5),
    Case("lidar crashes and restarts", _crash_and_restart, _both(("node:/lidar", "presence")), 0.5),
    Case("subscription asks for more than is offered", lambda w: _misfit(w, "reliable"),
         {"ros2": frozenset()}, 5.0, MISFIT),
    Case("subscription of another type", lambda w: _misfit(w, "type"), {"ros2": frozenset()}, 5.0, MISFIT),
    # Counted from before it is asked to end, which takes it seconds.
    Case("ROS master restarts", _master_restart,
         {"ros1": frozenset((f"node:{node}", "presence") for node in NODES)}, 6.0),
)  # fmt: skip


def ready(generation: str, cases: Iterable[Case] = CASES) -> set[Key]:
    """What has to be ok before the first fault."""
    told = {key for case in cases for key in case.right.get(generation, ())}
    return told | {(f"node:{node}", "presence") for node in NODES}


def run_case(watched: Watched, case: Case, needed: set[Key]) -> Row:
    """Breaks the robot, mends it, and notes what was told; the robot has to be fine before and is afterwards."""
    right = case.right[watched.generation]
    watched.wait_until_ok(needed)
    first, failed = len(watched.told), len(watched.failures)
    began = time.time()
    with case.begin(watched) as fault:
        until = time.monotonic() + ALARM_LIMIT
        while time.monotonic() < until and (alarm := _alarm(watched, right, case.says, first, failed)) is None:
            time.sleep(STEP)
        time.sleep(HELD)
    assert fault.ended is not None
    ok: float | None = None
    with contextlib.suppress(BedError):
        watched.wait_until_ok(needed)
        ended = max((one.time for one in watched.told[first:] if one.key in watched.alarmed), default=fault.ended)
        ok = max(ended - fault.ended, 0.0)
    bad = [one for one in watched.told[first:] if one.bad and one.key not in right]
    entities = {entity for entity, _ in right}
    # A fault that is mended by the time it is told may have no cause left: only what is told of it counts.
    following = [one for one in bad if one.cause in entities or one.entity in entities]
    others = [one for one in bad if one not in following]
    if alarm is None:
        return Row(case.name, watched.generation, "", None, ok, (), _texts(others, began), case.allowed)
    return Row(
        case.name, watched.generation, alarm[1], max(alarm[0] - began, 0.0), ok,
        _texts(following, began), _texts(others, began), case.allowed,
    )  # fmt: skip


def _alarm(watched: Watched, right: frozenset[Key], says: str, first: int, failed: int) -> tuple[float, str] | None:
    watched.read()
    for one in watched.told[first:]:
        if one.bad and one.key in right:
            return one.time, f"{one.entity} {one.quantity} {one.state}"
    for moment, text in watched.failures[failed:] if says else ():
        if says in text:
            return moment, text
    return None


def _texts(told: Iterable[Told], began: float) -> tuple[str, ...]:
    found: dict[str, str] = {}
    for one in told:
        found.setdefault(
            f"{one.entity} {one.quantity}", f"{one.entity} {one.quantity} {one.state} ({one.time - began:.1f} s)"
        )
    return tuple(found.values())


def run_all(generation: str, names: Iterable[str] = (), *, exactly: bool = False) -> Iterator[Row]:
    """Yields a row for each fault of a generation, or for those whose names have one of the words, or are they."""
    wanted = list(names)
    cases = [case for case in CASES if generation in case.right]
    cases = [
        case
        for case in cases
        if not wanted or any(word == case.name or (not exactly and word in case.name) for word in wanted)
    ]
    faked = FAKED if clock.library() is not None else ""
    cases = [case for case in cases if faked or "clock" not in case.name]
    with Watched(generation, faked_clock=faked) as watched:
        for case in cases:
            yield run_case(watched, case, ready(generation, cases))


def line(row: Row) -> str:
    """The row in Markdown."""
    alarm = "missed" if row.alarm is None else f"{row.alarm:.1f}"
    ok = "not" if row.ok is None else f"{row.ok:.1f}"
    if row.alarm is None or MISFIT in row.told:
        ok = "-"  # nothing was bad that could become ok
    told = f"`{row.told}`" if row.told else ""
    cells = [row.name, row.generation.upper().replace("ROS", "ROS "), told, alarm, ok]
    return "| " + " | ".join([*cells, ", ".join(row.consequences), ", ".join(row.others)]) + " |"


HEAD = """\
| fault | | told | s to alarm | s to ok | told as its consequence | told besides |
| --- | --- | --- | --- | --- | --- | --- |"""


def main(words: list[str]) -> int:
    """Returns 1 where a fault was missed, told late or told along with something else."""
    generations = [word for word in words if word in BOTH] or list(BOTH)
    names = [word for word in words if word not in BOTH]
    reasons = {"ros1": robot_ros1.why_not, "ros2": robot_ros2.why_not}
    sys.stdout.write(HEAD + "\n")
    wrong = False
    for generation in generations:
        if reason := reasons[generation]():
            sys.stderr.write(f"{generation}: {reason}\n")
            wrong = True
            continue
        for row in run_all(generation, names):
            wrong |= not row.right
            sys.stdout.write(line(row) + "\n")
            sys.stdout.flush()
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Runs every fault against the watched robot and prints the table of docs/faults.md.

sudo PYTHONPATH=tests .venv/bin/python -m testbed.fault_table [ros1|ros2] [FAULT...]
"""

import contextlib
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass

from testbed import clock, facts, faults, robot_ros1, robot_ros2
from testbed.facts import Fact
from testbed.faults import Fault, in_force
from testbed.machine import BedError
from testbed.robot_ros1 import Ros1Robot
from testbed.watched import PORT, STEP, Told, Watched

Key = tuple[str, str]
BOTH = ("ros1", "ros2")
FAKED = "sensor"  # no node there receives: timed waits of Python 3.11 never end under faketime 0.9.10
ALARM_LIMIT = 15.0
HELD = 2.0
MISFIT = "gets nothing of what"
LATE = 0.2
"""Seconds after its window within which an alarm has to come."""

SCAN = "connection:/lidar > /scan > /planner"
RESENT, OF_SCAN = ("host:sensor", "resent"), ("topic:/scan", "rate")
MISFITS = frozenset({("topic:/scan", "misfits")})
NODES = ("/odometry", "/lidar", "/camera", "/planner")


@dataclass(frozen=True)
class Case:
    """A fault, and what has to be told of it.

    Attributes:
        name: Of the row.
        begin: Makes the fault in the watched robot.
        right: By generation, entity and quantity of which one has to be told first.
        allowed: Seconds from the beginning to the alarm at most, on a machine with other things to do.
        window: Seconds over which is judged what is told of it, or from one sample to the next; 0 of what is told at
            once. By generation where they differ.
        says: A failure with these words has to be told, where no verdict is about such a fault.
        fact: Finds out when the fault is there for anybody to see; None where that is when it begins.
        also: Entity and quantity of what it may break too, also when its cause has gone.
        lasts: Seconds for which who observes is struck, so that nothing bad may be told; 0 of faults of the robot.
        observer: Of which has to be told that nothing is heard of it, and nothing else; empty of none.
    """

    name: str
    begin: Callable[[Watched], AbstractContextManager[Fault]]
    right: dict[str, frozenset[Key]]
    allowed: float
    window: float | dict[str, float] = 1.0
    says: str = ""
    fact: Callable[[Watched, Fault], Fact] | None = None
    also: frozenset[Key] = frozenset()
    lasts: float = 0.0
    observer: str = ""

    def window_of(self, generation: str) -> float:
        """Return the window of a generation."""
        return self.window[generation] if isinstance(self.window, dict) else self.window


@dataclass(frozen=True)
class Row:
    """What came of a case; times in seconds, None for what was not told.

    Attributes:
        alarm: From just before the fault began.
        over: From its fact to the alarm, less the window.
        load: Processes of the machine that ran or wanted to, as a mean over the last minute.
    """

    name: str
    generation: str
    told: str
    alarm: float | None
    ok: float | None
    consequences: tuple[str, ...]
    others: tuple[str, ...]
    allowed: float
    window: float = 0.0
    over: float | None = None
    load: float = 0.0
    quiet: bool = False

    @property
    def right(self) -> bool:
        """Whether it was told, in time, and nothing else was."""
        if self.quiet:
            return not self.others and self.ok is not None and (self.alarm is None or self.alarm <= self.allowed)
        if self.over is None or self.alarm is None or self.ok is None or self.others:
            return False
        # How long the middleware takes to tell of a subscription is not ours to say.
        return self.alarm <= self.allowed and (self.over <= LATE or MISFIT in self.told or "misfits" in self.told)


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
def misfit(watched: Watched, kind: str) -> Iterator[Fault]:
    """A subscription on the brain that gets nothing of the scan, by what `kind` says; ROS 2 only."""
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
    Case("rate of the lidar drops, 25 to 10 Hz", _load("lidar", delay=0.1), _both(("topic:/scan", "rate")), 2.2),
    Case(
        "sensor's link is 20 ms slower", lambda w: faults.delay(w.bed, "sensor", 20),
        {"ros1": frozenset({(SCAN, "age")}), "ros2": frozenset({(SCAN, "latency")})}, 2.2,
    ),
    # TCP: over the last 5 s, for 1 s, sampled every second.
    Case(
        "5 % loss on the sensor's link", lambda w: faults.loss(w.bed, "sensor", 5),
        {"ros1": frozenset({RESENT}), "ros2": frozenset({(SCAN, "loss")})}, 8.0, {"ros1": 6.0, "ros2": 1.0},
        fact=facts.scan_missing, also=frozenset({RESENT}),
    ),
    # The time is asked for twice a second, told every second; faketime looks at its file once a second.
    Case(
        "clock of the sensor host is 250 ms ahead", lambda w: clock.shifted(w.bed[FAKED], 0.25),
        _both((f"host:{FAKED}", "clock_offset")), 4.2, 2.5,
    ),
    # Sampled every second.
    Case("camera burns a CPU", _load("camera", burn=0.95), _both(("node:/camera", "cpu")), 3.2,
         fact=facts.camera_busy),
    Case("camera leaks 60 MB/s", _load("camera", leak=60), _both(("node:/camera", "memory")), 5.0,
         fact=facts.camera_grown),
    Case("disk of the sensor host is full", lambda w: faults.full_disk(w.bed["sensor"]),
         _both(("host:sensor", "disk_free")), 1.2),
    Case("lidar freezes", lambda w: faults.frozen(w.robot.processes["lidar"]), _both(("topic:/scan", "rate")), 2.2,
         also=frozenset({("node:/lidar", "stopped")})),
    # Told when it happens.
    Case("lidar crashes", lambda w: faults.killed(w.robot.processes["lidar"]),
         _both(("node:/lidar", "presence")), 0.5, 0.0, also=frozenset({OF_SCAN})),
    Case("lidar crashes and restarts", _crash_and_restart, _both(("node:/lidar", "presence")), 0.5, 0.0,
         also=frozenset({OF_SCAN})),
    Case("subscription asks for more than is offered", lambda w: misfit(w, "reliable"),
         {"ros2": MISFITS}, 5.0, 0.0, MISFIT, facts.subscribed("misfit-reliable")),
    Case("subscription of another type", lambda w: misfit(w, "type"), {"ros2": MISFITS}, 5.0, 0.0, MISFIT,
         facts.subscribed("misfit-type")),
    # Counted from before it is asked to end, which takes it seconds; looked at every second.
    Case("ROS master restarts", _master_restart,
         {"ros1": frozenset((f"node:{node}", "presence") for node in NODES)}, 6.0, fact=facts.master_answers),
)  # fmt: skip


def _observing(name: str, begin: Callable[[Watched], AbstractContextManager[Fault]], lasts: float, of: str) -> Case:
    """Return a fault of who observes; after a second and a half, or three turns of a second, it is silent."""
    # That TCP sends again what was not answered meanwhile is true.
    also = frozenset({RESENT})
    return Case(name, begin, _both(*OBSERVED_KEYS), 4.0, SILENT, also=also, lasts=lasts, observer=of)


OBSERVED_KEYS = (OF_SCAN, ("topic:/odom", "rate"), ("topic:/cmd_vel", "rate"), ("host:sensor", "disk_free"))
"""What the agents and the observer of ROS tell of a robot that is fine."""
SILENT = 3.0
"""Seconds after which an observer that speaks once a second is silent."""
OBSERVED = (
    _observing("line to the agent of sensor is cut for 2 s", lambda w: faults.silent_line(w.bed["sensor"], PORT), 2.0,
               "observer:sensor/agent"),
    _observing("line to the agent of sensor is cut for 10 s", lambda w: faults.silent_line(w.bed["sensor"], PORT), 10.0,
               "observer:sensor/agent"),
    _observing("agent of sensor is stopped for 10 s", lambda w: faults.frozen(w.agents["sensor"]), 10.0,
               "observer:sensor/agent"),
    _observing("observer of ROS is stopped for 4 s", lambda w: faults.frozen_children(w.monitor), 4.0,
               "observer:base/ros"),
    _observing("observer of ROS is stopped for 10 s", lambda w: faults.frozen_children(w.monitor), 10.0,
               "observer:base/ros"),
    _observing("monitor is stopped for 8 s", lambda w: faults.frozen(w.monitor), 8.0, ""),
)  # fmt: skip
"""Faults of who observes, of which the robot knows nothing."""
EVERY = (*CASES, *OBSERVED)


def run_quiet(watched: Watched, case: Case, needed: set[Key]) -> Row:
    """Strikes who observes, and notes what was told: the robot is fine all the time."""
    watched.wait_until_ok(needed)
    first, began = len(watched.reported), time.time()
    with case.begin(watched) as fault:
        time.sleep(case.lasts)
        load = os.getloadavg()[0]
    assert fault.ended is not None
    ok: float | None = None
    with contextlib.suppress(BedError):
        watched.wait_until_ok(needed)
        after = [one.time for one in watched.reported[first:] if one.state == "ok" and one.time > fault.ended]
        ok = max(after, default=fault.ended) - fault.ended
    time.sleep(HELD)
    watched.read()
    fresh = watched.reported[first:]
    silent = [one for one in fresh if one.entity.startswith("observer:") and one.state == "unknown"]
    named = [one for one in silent if case.observer and one.entity.startswith(case.observer)]
    following = [one for one in fresh if one.bad and one.key in case.also]
    others = [one for one in fresh if one.bad and one not in following] + [one for one in silent if one not in named]
    alarm = named[0].time - began if named else None
    told = f"{named[0].entity} {named[0].state}" if named else ""
    if case.observer and not named and case.lasts > SILENT + LATE:
        ok = None
    over = max(alarm - case.window_of(watched.generation), 0.0) if alarm is not None else 0.0
    return Row(
        case.name, watched.generation, told, alarm, ok, _texts(following, began), _texts(others, began), case.allowed,
        case.window_of(watched.generation), over, load, quiet=True,
    )  # fmt: skip


def ready(generation: str, cases: Iterable[Case] = CASES) -> set[Key]:
    """What has to be ok before the first fault."""
    told = {key for case in cases for key in case.right.get(generation, ())}
    return told | {(f"node:{node}", "presence") for node in NODES}


def run_case(watched: Watched, case: Case, needed: set[Key]) -> Row:
    """Breaks the robot, mends it, and notes what was told; the robot has to be fine before and is afterwards."""
    right = case.right[watched.generation]
    watched.wait_until_ok(needed)
    first, failed = len(watched.reported), len(watched.failures)
    began = time.time()
    with case.begin(watched) as fault:
        until = time.monotonic() + ALARM_LIMIT
        fact = case.fact(watched, fault) if case.fact else lambda: began
        since: float | None = None
        while time.monotonic() < until and (alarm := _alarm(watched, right, case.says, first, failed)) is None:
            since = since or fact()
            time.sleep(STEP)
        load = os.getloadavg()[0]
        time.sleep(HELD)
    assert fault.ended is not None
    ok: float | None = None
    with contextlib.suppress(BedError):
        watched.wait_until_ok(needed)
        ended = max((one.time for one in watched.reported[first:] if one.key in watched.alarmed), default=fault.ended)
        ok = max(ended - fault.ended, 0.0)
    bad = [one for one in watched.reported[first:] if one.bad and one.key not in right]
    entities = {entity for entity, _ in right}
    # A fault that is mended by the time it is told may have no cause left: only what is told of it counts.
    following = [one for one in bad if one.cause in entities or one.entity in entities or one.key in case.also]
    others = [one for one in bad if one not in following]
    if alarm is None:
        return Row(case.name, watched.generation, "", None, ok, (), _texts(others, began), case.allowed, load=load)
    window = case.window_of(watched.generation)
    # An alarm may come before its fact was looked for.
    counted = since or (alarm[0] if case.fact else began)
    over = max(alarm[0] - counted - window, 0.0)
    return Row(
        case.name, watched.generation, alarm[1], max(alarm[0] - began, 0.0), ok,
        _texts(following, began), _texts(others, began), case.allowed, window, over, load,
    )  # fmt: skip


def _alarm(watched: Watched, right: frozenset[Key], says: str, first: int, failed: int) -> tuple[float, str] | None:
    watched.read()
    for one in watched.reported[first:]:
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
    cases = [case for case in EVERY if generation in case.right]
    cases = [
        case
        for case in cases
        if not wanted or any(word == case.name or (not exactly and word in case.name) for word in wanted)
    ]
    faked = FAKED if clock.library() is not None else ""
    cases = [case for case in cases if faked or "clock" not in case.name]
    with Watched(generation, faked_clock=faked) as watched:
        for case in cases:
            yield (run_quiet if case.lasts else run_case)(watched, case, ready(generation, cases))


def line(row: Row) -> str:
    """The row in Markdown."""
    alarm = f"{row.alarm:.1f}" if row.alarm is not None else "-" if row.quiet else "missed"
    ok = "not" if row.ok is None else f"{row.ok:.1f}"
    if not row.quiet and (row.alarm is None or MISFIT in row.told):
        ok = "-"  # nothing was bad that could become ok
    told = f"`{row.told}`" if row.told else ""
    late = "" if row.over is None else f"{row.over:.1f}"
    cells = [row.name, row.generation.upper().replace("ROS", "ROS "), told, f"{row.window:g}", alarm, late, ok]
    cells += [", ".join(row.consequences), ", ".join(row.others), f"{row.load:.1f}"]
    return "| " + " | ".join(cells) + " |"


HEAD = """\
| fault | | reported | window, s | s to alarm | over the window | s to ok | its consequences | besides | load |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"""


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

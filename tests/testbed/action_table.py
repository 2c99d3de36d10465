"""Breaks the robot that helps itself, and prints what was done about it: the second table of docs/faults.md.

sudo PYTHONPATH=tests .venv/bin/python -m testbed.action_table [ros1|ros2] [FAULT...]
"""

import contextlib
import os
import signal
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass

from testbed import clock, faults, robot_ros1, robot_ros2
from testbed.machine import BedError
from testbed.reacting import Done, Reacting
from testbed.robot import NODES as NODES_OF_ROBOT
from testbed.robot_ros1 import Ros1Robot

FAKED = "sensor"
LIMIT = 20.0
QUIET = 8.0
"""Seconds for which is looked whether anything is done about what is to be left alone."""
BOTH = ("ros1", "ros2")
NODES = ("/odometry", "/lidar", "/camera", "/planner")
NEEDED = {
    ("topic:/scan", "rate"),
    ("topic:/odom", "rate"),
    ("topic:/cmd_vel", "rate"),
    ("host:sensor", "disk_free"),
} | {(f"node:{one}", "presence") for one in NODES}
SPARE = 0.3
"""Seconds that an action may come after its hold time and one window."""


@dataclass(frozen=True)
class Case:
    """A fault, and what is to be done about it.

    Attributes:
        name: Of the row.
        begin: Makes the fault; what was done about it ends it, where it is the robot's own to mend.
        does: Id of the reaction that has to act; empty where nothing may be done.
        hold: Seconds that its condition has to hold, and of the window over which is judged.
        also: Reactions that may act too, for they follow from the fault.
        generations: For which it exists.
        lasts: Seconds of a fault that nobody acts upon.
        on: Nodes and hosts that it strikes; nothing may be done to any other.
    """

    name: str
    begin: Callable[[Reacting], AbstractContextManager[object]]
    does: str
    hold: float
    also: frozenset[str] = frozenset()
    generations: tuple[str, ...] = BOTH
    lasts: float = QUIET
    on: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Row:
    """What came of a case; times in seconds from when the fault began, None for what never came."""

    name: str
    generation: str
    done: str
    to_action: float | None
    to_result: float | None
    to_gone: float | None
    hold: float
    result: str
    others: tuple[str, ...]
    nothing: bool
    load: float

    @property
    def right(self) -> bool:
        """Whether what was to be done was, and worked, and nothing else was."""
        if self.others:
            return False
        return self.nothing or self.result == "done"


@contextlib.contextmanager
def _signalled(reacting: Reacting, node: str, number: signal.Signals) -> Iterator[None]:
    """The node that runs now, whoever started it, gets a signal; only processes of its own host are looked at."""
    host = reacting.bed[next(one.host for one in NODES_OF_ROBOT if one.name == node)]
    program = f"{reacting.generation}_{node}.py"
    host.run(["pkill", f"-{number.value}", "-f", f"python[^ ]* [^ ]*{program}"])
    yield


@contextlib.contextmanager
def _master_restart(reacting: Reacting) -> Iterator[None]:
    robot = reacting.robot
    assert isinstance(robot, Ros1Robot)
    assert robot.master is not None
    robot.master.stop()
    robot.master.start_again()
    robot.wait_for_master()
    yield
    for name, process in robot.processes.items():
        process.kill()
        if not any(one.reaction == "gone" and f"/{name}" in str(one.fields) for one in reacting.journal[-20:]):
            process.start_again()


@contextlib.contextmanager
def _crashed(reacting: Reacting, whose: str) -> Iterator[None]:
    process = reacting.monitor if whose == "monitor" else reacting.agents[whose]
    process.kill()
    process.start_again()
    yield


def _load(node: str, **load: float) -> Callable[[Reacting], AbstractContextManager[object]]:
    return lambda one: faults.loaded(one.robot.changes(node), node, **load)


LIDAR, ODOMETRY, CAMERA, SENSOR = (frozenset({one}) for one in ("/lidar", "/odometry", "/camera", "sensor"))
CASES = (
    Case(
        "lidar is killed (kill -9)", lambda r: _signalled(r, "lidar", signal.SIGKILL), "gone", 0.0,
        frozenset({"blind"}), on=LIDAR,
    ),
    Case(
        "odometry, on the monitor's host, is killed", lambda r: _signalled(r, "odometry", signal.SIGKILL), "gone", 0.0,
        on=ODOMETRY,
    ),
    Case(
        "lidar freezes (SIGSTOP)", lambda r: _signalled(r, "lidar", signal.SIGSTOP), "frozen", 1.0,
        frozenset({"blind", "gone"}), on=LIDAR,
    ),
    Case("rate of the lidar drops, 25 to 10 Hz", _load("lidar", delay=0.1), "blind", 0.5 + 1.0, on=LIDAR),
    Case("sensor's link is 20 ms slower", lambda r: faults.delay(r.bed, "sensor", 20), "late", 0.5 + 1.0, on=SENSOR),
    Case(
        "5 % loss on the sensor's link", lambda r: faults.loss(r.bed, "sensor", 5), "lossy", 1.0, frozenset({"late"}),
        ("ros2",), on=SENSOR,
    ),
    Case("camera burns a CPU", _load("camera", burn=0.95), "burns", 1.0 + 2.0, on=CAMERA),
    Case("camera leaks 60 MB/s", _load("camera", leak=60), "leaks", 3.0, on=CAMERA),
    Case("disk of the sensor host is full", lambda r: faults.full_disk(r.bed["sensor"]), "full", 1.0, on=SENSOR),
    Case(
        "sensor host is unplugged for 8 s", lambda r: faults.unplugged(r.bed, "sensor"), "blind", 0.5 + 1.0,
        frozenset({"lossy", "late"}), BOTH, 8.0, on=SENSOR,
    ),
    Case(
        "clock of the sensor host is 250 ms ahead", lambda r: clock.shifted(r.bed[FAKED], 0.25), "clock", 1.0 + 2.5,
        frozenset({"late"}), on=SENSOR,
    ),
    Case(
        "ROS master restarts", _master_restart, "", 0.0, frozenset({"gone", "blind"}), ("ros1",), on=frozenset(NODES)
    ),
    Case("agent of sensor crashes and begins again", lambda r: _crashed(r, "sensor"), "", 0.0),
    Case("agent of sensor is stopped for 10 s", lambda r: faults.frozen(r.agents["sensor"]), "", 0.0, lasts=10.0),
    Case("monitor is stopped for 8 s", lambda r: faults.frozen(r.monitor), "", 0.0, lasts=8.0),
    Case("monitor crashes and begins again", lambda r: _crashed(r, "monitor"), "", 0.0, lasts=15.0),
)  # fmt: skip


def run_case(reacting: Reacting, case: Case) -> Row:
    """Breaks the robot and notes what was done; it has to be fine before and is afterwards."""
    reacting.settle(NEEDED)
    began = time.time()
    with case.begin(reacting):
        load = os.getloadavg()[0]
        if not case.does:
            time.sleep(case.lasts)
        else:
            reacting.look(lambda: any(one.reaction == case.does for one in reacting.announced(began)), LIMIT)
            if (found := _first(reacting, case.does, began)) is not None:
                decision = found.decision
                reacting.look(lambda: reacting.of(decision, "outcome") is not None, LIMIT)
    if not case.does:
        time.sleep(QUIET / 2)
        reacting.read()
    with contextlib.suppress(BedError):
        reacting.settle(NEEDED)
    announced = reacting.announced(began)
    others = tuple(dict.fromkeys(one.reaction for one in announced if one.reaction not in {case.does, *case.also}))
    first = _first(reacting, case.does, began)
    done, result, ended, gone = "", "", None, None
    if first is not None:
        action = first.fields["action"]
        target = action.get("target") or {}
        done = f"{action['kind']} {target.get('name', '')}".strip()
        outcome, verified = reacting.of(first.decision, "outcome"), reacting.of(first.decision, "verified")
        result = outcome.fields["result"] if outcome else "nothing was told"
        if outcome is not None and result != "done":
            sys.stderr.write(f"{case.name}: {outcome.fields['text']}\n")
        ended = outcome.time - began if outcome else None
        gone = verified.time - began if verified and verified.fields["verification"] == "gone" else None
    elif announced:
        done = ", ".join(dict.fromkeys(one.reaction for one in announced))
    return Row(
        name=case.name,
        generation=reacting.generation,
        done=done,
        to_action=first.time - began if first else None,
        to_result=ended,
        to_gone=gone,
        hold=case.hold,
        result=result,
        others=others,
        nothing=not case.does,
        load=load,
    )


def _first(reacting: Reacting, reaction: str, since: float) -> Done | None:
    return next((one for one in reacting.announced(since) if reaction and one.reaction == reaction), None)


def run_all(generation: str, names: Iterable[str] = ()) -> Iterator[Row]:
    """Yields a row for each fault of a generation, or for those whose names have one of the words."""
    wanted = list(names)
    cases = [one for one in CASES if generation in one.generations]
    cases = [one for one in cases if not wanted or any(word in one.name for word in wanted)]
    faked = FAKED if clock.library() is not None else ""
    cases = [one for one in cases if faked or "clock" not in one.name]
    reacting = Reacting(generation, faked_clock=faked)
    with reacting:
        for case in cases:
            yield run_case(reacting, case)


def line(row: Row) -> str:
    """The row in Markdown."""

    def shown(value: float | None) -> str:
        return "" if value is None else f"{value:.1f}"

    over = "" if row.to_action is None else f"{max(row.to_action - row.hold, 0.0):.1f}"
    done = f"`{row.done}`" if row.done else "nothing"
    generation = row.generation.upper().replace("ROS", "ROS ")
    cells = [row.name, generation, done, f"{row.hold:g}", shown(row.to_action), over]
    cells += [row.result, shown(row.to_result), shown(row.to_gone), ", ".join(row.others), f"{row.load:.1f}"]
    return "| " + " | ".join(cells) + " |"


HEAD = """\
| fault | | done | hold, s | s to action | over it | result | s to result | s to gone | done besides | load |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"""


def main(words: list[str]) -> int:
    """Returns 1 where a fault was not acted upon, in vain, or something else was done."""
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

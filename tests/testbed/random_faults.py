"""Random faults strike the robot that helps itself, one or two at a time, and what is done about each is looked at.

sudo PYTHONPATH=tests .venv/bin/python -m testbed.random_faults [ros1|ros2] [--minutes N] [--seed N]
"""

import argparse
import contextlib
import os
import random
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path

from starved import CROWDED, LATE_S, Sleeper

from testbed import clock, fault_table, faults, robot_ros1, robot_ros2
from testbed.action_table import CASES, FAKED, LIMIT, NEEDED, QUIET, Case
from testbed.machine import BedError, wait_until
from testbed.reacting import Done, Reacting
from testbed.robot import NODES
from testbed.robot_ros1 import Ros1Robot
from testbed.watched import MONITOR, PORT, ROSLENS

_WATCHING = "begins again"
"""In the names of faults after which a monitor or an agent is another process."""
_PAIRED = 0.25
"""Share of strikes with two faults at a time."""
_HEALED_S = 30.0
SETTLED_S = 120.0
"""For so long is waited until the robot is fine, which on a busy machine takes a while."""
VERIFIED = frozenset(("gone", "frozen", "burns", "leaks", "full"))
"""Reactions that look whether they helped."""


@contextlib.contextmanager
def _mended_by_hand(reacting: Reacting) -> Iterator[None]:
    """The ROS master begins again, and who looks after the robot holds reactions, starts its nodes, and releases."""
    robot = reacting.robot
    assert isinstance(robot, Ros1Robot)
    assert robot.master is not None
    base = reacting.bed[MONITOR]
    react = [ROSLENS, "react"]
    base.run([*react, "--hold", "the master begins again"], reacting.environment)
    robot.master.stop()
    robot.master.start_again()
    robot.wait_for_master()
    for node in NODES:
        reacting.bed[node.host].run(["pkill", "-KILL", "-f", _program(reacting, node.name)], check=False)
        process = robot.processes[node.name]
        process.kill()
        process.start_again()
    reacting.wait_until_ok(NEEDED, 60.0)
    base.run([*react, "--release"], reacting.environment)
    yield


def _program(reacting: Reacting, node: str) -> str:
    return f"python[^ ]* [^ ]*{reacting.generation}_{node}.py"


MORE = (
    Case("ROS master restarts, and is mended by hand", _mended_by_hand, "", 0.0, generations=("ros1",), lasts=2.0,
         on=frozenset(f"/{node.name}" for node in NODES)),
    Case("line to the agent of sensor is cut", lambda r: faults.silent_line(r.bed["sensor"], PORT), "", 0.0),
    # Nodes that were started again on its host are children of the monitor, too.
    Case("observer of ROS is stopped for 4 s", lambda r: faults.frozen_children(r.monitor, "adapters"), "", 0.0,
         lasts=4.0),
    Case("subscription asks for more than is offered", lambda r: fault_table.misfit(r, "reliable"), "", 0.0,
         generations=("ros2",), lasts=3.0),
    Case("subscription of another type", lambda r: fault_table.misfit(r, "type"), "", 0.0, generations=("ros2",),
         lasts=3.0),
)  # fmt: skip
"""Faults of docs/faults.md that nobody has to act upon, beside those of the table of actions."""
LEFT_OUT = frozenset({"ROS master restarts"})
"""After which the table itself starts the nodes again; here an operator does."""


@dataclass(frozen=True)
class Strike:
    """One or two faults at a time; those that nobody acts upon last for `lasts` seconds."""

    cases: tuple[Case, ...]
    lasts: float

    @property
    def name(self) -> str:
        """Of its faults."""
        return " + ".join(one.name for one in self.cases)


@dataclass
class Found:
    """What was seen of a strike; it is as it should be where `wrong`, `missed` and `touched` are empty.

    Attributes:
        wrong: Actions that none of its faults calls for, or on what it did not strike.
        missed: Faults about which nothing was done, or in vain.
        touched: Healthy nodes that were another process afterwards.
        times: Seconds from the beginning to the action about each fault.
        starved: What kept the robot from the processors meanwhile, that was none of the bed's; empty of nothing. Its
            nodes were late themselves then, and what was done about that was right.
    """

    strike: Strike
    wrong: list[str] = field(default_factory=list)
    missed: list[str] = field(default_factory=list)
    touched: list[str] = field(default_factory=list)
    times: list[float] = field(default_factory=list)
    load: float = 0.0
    starved: str = ""

    @property
    def right(self) -> bool:
        """Whether what was to be done was, and nothing else."""
        return not (self.wrong or self.missed or self.touched)

    def __str__(self) -> str:
        """One line."""
        times = ", ".join(f"{one:.1f} s" for one in self.times)
        bad = [f"{what}: {'; '.join(told)}" for what, told in
               (("WRONG", self.wrong), ("MISSED", self.missed), ("TOUCHED", self.touched)) if told]  # fmt: skip
        starved = [f"starved: {self.starved}"] if self.starved else []
        return " | ".join([self.strike.name, times or "nothing", *bad, *starved, f"load {self.load:.1f}"])


def strikes(seed: int, generation: str, *, clocks: bool = True) -> Iterator[Strike]:
    """Yields strikes for ever, the same ones for a seed: each fault comes once before any comes again."""
    chance = random.Random(seed)
    all_of_it = [
        one
        for one in (*CASES, *MORE)
        if generation in one.generations and one.name not in LEFT_OUT and (clocks or "clock" not in one.name)
    ]
    while True:
        left = list(all_of_it)
        chance.shuffle(left)
        while left:
            first = left.pop()
            second = next((one for one in left if _together(first, one)), None)
            if second is None or chance.random() > _PAIRED:
                yield Strike((first,), _lasting(first, chance))
            else:
                left.remove(second)
                yield Strike((first, second), 0.0)


def _together(one: Case, other: Case) -> bool:
    """Whether two faults can be told apart when they come at once: both are of single nodes, and not of the same."""
    nodes = {f"/{node.name}" for node in NODES}
    return all(case.does and len(case.on) == 1 and case.on <= nodes for case in (one, other)) and one.on != other.on


def _lasting(case: Case, chance: random.Random) -> float:
    if _WATCHING in case.name or case.does:
        return case.lasts
    return chance.uniform(0.25, 1.25) * case.lasts


def strike(reacting: Reacting, what: Strike) -> Found:
    """Strikes a robot that is fine, waits until it is fine again, and returns what was done meanwhile."""
    found = Found(what)
    try:
        reacting.settle(NEEDED, SETTLED_S)
    except BedError as error:
        found.missed.append(f"the robot was not fine before: {str(error)[:300]}")
        return found
    before = processes(reacting)
    began = time.time()
    with ExitStack() as stack:
        for case in what.cases:
            stack.enter_context(case.begin(reacting))
        wanted = [one for one in what.cases if one.does]
        reacting.look(lambda: all(_answer(reacting, one, began) for one in wanted), LIMIT)
        reacting.look(lambda: all(_told(reacting, one, began, "outcome") for one in wanted), LIMIT)
        if not wanted:
            time.sleep(what.lasts)
        found.load = os.getloadavg()[0]
    if not wanted:
        reacting.look(lambda: False, QUIET / 2)
    reacting.look(lambda: all(one.does not in VERIFIED or _told(reacting, one, began, "verified") for one in wanted),
                  _HEALED_S)  # fmt: skip
    try:
        reacting.settle(NEEDED)
        with contextlib.suppress(BedError):
            wait_until("all nodes run", lambda: len(processes(reacting)) == len(before), 10.0)
    except BedError as error:
        found.missed.append(f"the robot did not become fine again: {str(error)[:300]}")
    _judge(reacting, found, began)
    after = processes(reacting)
    struck = frozenset[str]().union(*(one.on for one in what.cases))
    found.touched = [f"{node} {before[node]} {after.get(node)}" for node in before
                     if node not in struck and after.get(node) != before[node]]  # fmt: skip
    return found


def _judge(reacting: Reacting, found: Found, began: float) -> None:
    cases = found.strike.cases
    for one in reacting.announced(began):
        target = (one.fields["action"].get("target") or {}).get("name", "")
        called = [case for case in cases if one.reaction in {case.does, *case.also}]
        if not called or (target and not any(target in case.on for case in called)):
            found.wrong.append(f"{one.reaction}: {one.fields['action']['kind']} {target}".strip())
    for case in cases:
        if not case.does:
            continue
        answer = _answer(reacting, case, began)
        if answer is None:
            found.missed.append(f"{case.name}: nothing was done")
            continue
        found.times.append(answer.time - began)
        outcome = reacting.of(answer.decision, "outcome")
        if outcome is None or outcome.fields["result"] != "done":
            found.missed.append(f"{case.name}: {outcome.fields if outcome else 'no outcome'}")
        elif case.does in VERIFIED and _told(reacting, case, began, "verified") is None:
            found.missed.append(f"{case.name}: nobody looked whether it helped")


def _answer(reacting: Reacting, case: Case, since: float) -> Done | None:
    """What was done first about a fault: of its own reaction, on what it struck."""
    for one in reacting.announced(since):
        target = (one.fields["action"].get("target") or {}).get("name", "")
        if one.reaction == case.does and (not target or target in case.on):
            return one
    return None


def _told(reacting: Reacting, case: Case, since: float, what: str) -> Done | None:
    answer = _answer(reacting, case, since)
    return reacting.of(answer.decision, what) if answer is not None else None


def processes(reacting: Reacting) -> dict[str, str]:
    """The process of each node of the robot that runs, whoever started it, as its host numbers them."""
    found = {}
    for node in NODES:
        words = ["pgrep", "-f", _program(reacting, node.name)]
        if running := reacting.bed[node.host].run(words, check=False).stdout.split():
            found[f"/{node.name}"] = " ".join(running)
    return found


def watching(reacting: Reacting) -> dict[str, int]:
    """Process ids of who observes and acts, by what they are: monitor, its children, agents."""
    monitor = reacting.monitor.pid
    found = {"monitor": monitor, **{f"agent of {name}": one.pid for name, one in reacting.agents.items()}}
    for pid in _children(monitor):
        words = Path(f"/proc/{pid}/cmdline").read_bytes().decode(errors="replace")
        part = next((part for part in ("acting", "observing") if part in words), "observer")
        found[f"{part} {pid}"] = pid
    return found


def _children(pid: int) -> list[int]:
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    return [int(child) for one in tasks for child in one.read_text().split()]


def resident(pid: int) -> int:
    """Bytes of memory that are the process's own; 0 of one that ended."""
    try:
        lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    except OSError:
        return 0
    return 1024 * next((int(line.split()[1]) for line in lines if line.startswith("RssAnon")), 0)


class _Machine:
    """Whether others took the processors, by a process that does next to nothing (`tests/starved.py`)."""

    def __init__(self) -> None:
        self._sleeper = Sleeper()
        self._since = time.monotonic()

    def forget(self) -> None:
        """Begin to look anew."""
        self._since = time.monotonic()
        self._sleeper.forget(self._since)

    def starved(self) -> str:
        """What was noticed since; empty of nothing."""
        told = self._sleeper.told(self._since)
        # A slow processor alone makes nobody late here: nothing is bounded in processor time.
        worst = {what: max(told[what]) for what in ("late", "crowded") if what in told}
        bounds = {"late": LATE_S, "crowded": CROWDED}
        return ", ".join(f"{what} {much:.1f}" for what, much in worst.items() if much > bounds[what])

    def close(self) -> None:
        """End the process."""
        self._sleeper.end()


@dataclass
class Soaked:
    """What came of a soak.

    Attributes:
        found: Of each strike.
        grown: Bytes by which each process that observes or acts has grown since the first third was over.
        level_s: Seconds in which they were looked at.
    """

    found: list[Found]
    grown: dict[str, int]
    level_s: float


def soak(generation: str, seconds: float, seed: int) -> Iterator[Found | Soaked]:
    """Strikes for so long; yields what came of each strike, at the end what came of all.

    Monitors and agents crash in the first third only: afterwards they are the same processes, whose memory is measured.
    """
    faked = FAKED if clock.library() is not None else ""
    all_found = []
    reacting = Reacting(generation, faked_clock=faked)
    with reacting, contextlib.closing(_Machine()) as machine:
        reacting.settle(NEEDED, 90.0)
        began = time.monotonic()
        level: tuple[float, dict[str, tuple[int, int]]] | None = None
        for one in strikes(seed, generation, clocks=bool(faked)):
            passed = time.monotonic() - began
            if passed > seconds:
                break
            if passed > seconds / 3 and level is None:
                level = time.monotonic(), {name: (pid, resident(pid)) for name, pid in watching(reacting).items()}
            if level is not None and any(_WATCHING in case.name for case in one.cases):
                continue
            machine.forget()
            found = strike(reacting, one)
            found.starved = machine.starved()
            all_found.append(found)
            yield all_found[-1]
        since, before = level or (time.monotonic(), {})
        grown = {name: resident(pid) - size for name, (pid, size) in before.items()}
        yield Soaked(all_found, grown, time.monotonic() - since)


def main() -> int:
    """Returns 1 where something was wrong, missed or touched."""
    parser = argparse.ArgumentParser(prog="python -m testbed.random_faults", description="Random faults and actions.")
    parser.add_argument("generation", choices=["ros1", "ros2"])
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    chosen = parser.parse_args()
    reasons = {"ros1": robot_ros1.why_not, "ros2": robot_ros2.why_not}
    if reason := reasons[chosen.generation]():
        sys.stderr.write(f"{chosen.generation}: {reason}\n")
        return 2
    sys.stdout.write(f"seed {chosen.seed}\n")
    wrong = False
    for one in soak(chosen.generation, chosen.minutes * 60, chosen.seed):
        if isinstance(one, Soaked):
            right = sum(found.right for found in one.found)
            sys.stdout.write(
                f"{right} of {len(one.found)} strikes as they should be; memory over {one.level_s:.0f} s:\n"
            )
            sys.stdout.writelines(f"  {name} {size / 1e6:+.2f} MB\n" for name, size in one.grown.items())
        else:
            wrong |= not (one.right or one.starved)
            sys.stdout.write(f"{time.strftime('%H:%M:%S')} {one}\n")
        sys.stdout.flush()
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main())

"""When a fault is there for anybody to see, where that is after its beginning: from then on alarms are timed."""

import os
import time
from collections import deque
from collections.abc import Callable, Iterator
from pathlib import Path

from roslens.live.inside.counters import CounterReader
from roslens.live.inside.sequence import SETTLE_NS
from testbed.faults import Fault
from testbed.process import Process
from testbed.watched import Watched

Fact = Callable[[], float | None]
"""Asked again and again; returns the wall clock time in seconds, None as long as it is not there."""
TOO_BUSY_S = 0.2
"""CPU time in a second from where on the reference of the table calls the camera busy."""
TOO_LARGE_KB = 200_000
"""From where on the reference of the table calls the camera's memory high, in kB."""


def _processes(watched: Watched) -> Iterator[Process]:
    for host in watched.bed:
        yield from host.processes


def scan_missing(watched: Watched, fault: Fault) -> Fact:
    """When the message after the first missing one was taken, by the counters of the planner; in ROS 1 the begin."""
    if watched.generation == "ros1":
        return lambda: fault.began
    planner = watched.robot.processes["planner"]
    reader = CounterReader(f"/proc/{planner.pid}/root/dev/shm/roslens-0", tidy=False)
    reader.read(time.time())

    def fact() -> float | None:
        now = time.time()
        lost = [one for one in reader.read(now) if one.tally.topic == "/scan" and one.tally.lost > 0]
        return now - SETTLE_NS * 1e-9 if lost else None

    return fact


def camera_busy(watched: Watched, fault: Fault) -> Fact:
    """When the camera has used more of a processor, in the last second, than the reference allows."""
    stat = Path(f"/proc/{watched.robot.processes['camera'].pid}/stat")
    seen: deque[tuple[float, float]] = deque()

    def fact() -> float | None:
        fields = stat.read_text().rpartition(")")[2].split()
        now, used = time.time(), sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")
        seen.append((now, used))
        while len(seen) > 2 and seen[1][0] <= now - 1:
            seen.popleft()
        return now if used - seen[0][1] > TOO_BUSY_S else None

    return fact


def camera_grown(watched: Watched, fault: Fault) -> Fact:
    """When the camera has more memory than the reference allows."""
    status = Path(f"/proc/{watched.robot.processes['camera'].pid}/status")

    def fact() -> float | None:
        resident = next(line for line in status.read_text().splitlines() if line.startswith("VmRSS"))
        return time.time() if int(resident.split()[1]) * 1.024 > TOO_LARGE_KB else None

    return fact


def subscribed(name: str) -> Callable[[Watched, Fault], Fact]:
    """When the node of this name said that it has subscribed."""

    def of(watched: Watched, fault: Fault) -> Fact:
        process = next(one for one in _processes(watched) if one.name == name)
        return lambda: time.time() if "subscribed" in process.output() else None

    return of


def master_answers(watched: Watched, fault: Fault) -> Fact:
    """When the new master has said that it serves."""
    master = watched.robot.master  # type: ignore[attr-defined]
    return lambda: time.time() if master.output().count("started core service") > 1 else None

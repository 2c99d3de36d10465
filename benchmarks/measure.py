"""Time commands as whole processes, in turn, so that a drifting machine drifts for all of them."""

from __future__ import annotations

import contextlib
import os
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple


class Cost(NamedTuple):
    """What one run of a command took: CPU seconds of it and its children, wall seconds, peak memory in MB."""

    cpu_s: float
    wall_s: float
    peak_mb: float


def run(command: Sequence[str]) -> Cost:
    """Run a command to its end; what it prints is shown only when it ends with an error above 3."""
    with tempfile.TemporaryFile() as output:
        begun = time.monotonic()
        process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT, env=_as_installed())
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - begun
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode not in (0, 1, 3):
            output.seek(0)
            raise SystemExit(f"{command}: exit {process.returncode}\n{output.read().decode(errors='replace')}")
    return Cost(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024)


def _as_installed() -> dict[str, str]:
    """Return the environment without what keeps Python from remembering compiled modules, as installed ones are."""
    return {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}


_LOOK_S = 0.1


def peak_memory(command: Sequence[str]) -> tuple[float, float]:
    """Run a command; return the largest memory of one of its processes in MB, and of all together.

    That of one is its resident set; of all it is the sum of their proportional set sizes, as Linux tells them.
    """
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT, env=_as_installed())
        one = together = 0.0
        while process.poll() is None:
            found = [_memory_mb(pid) for pid in _family(process.pid)]
            one = max([one, *(resident for resident, _ in found)])
            together = max(together, sum(share for _, share in found))
            time.sleep(_LOOK_S)
    if process.returncode not in (0, 1, 3):
        raise SystemExit(f"{command}: exit {process.returncode}")
    return one, together


def _family(pid: int) -> list[int]:
    """Return a process and all that it started, those that these started too."""
    found = [pid]
    for place in Path("/proc", str(pid), "task").glob("*/children"):
        with contextlib.suppress(OSError):
            for child in place.read_text().split():
                found += _family(int(child))
    return found


def _memory_mb(pid: int) -> tuple[float, float]:
    """Return the resident and the proportional set size of a process; nothing of one that is gone."""
    kilobytes = {"Rss": 0, "Pss": 0}
    with contextlib.suppress(OSError):
        for line in Path("/proc", str(pid), "smaps_rollup").read_text().splitlines()[1:]:
            name, _, value = line.partition(":")
            if name in kilobytes:
                kilobytes[name] = int(value.split()[0])
    return kilobytes["Rss"] / 1024, kilobytes["Pss"] / 1024


def in_turn(
    commands: Mapping[str, Sequence[str]], rounds: int, before: Mapping[str, Callable[[], None]]
) -> dict[str, list[Cost]]:
    """Run each command once per round, in order; ``before`` prepares the ground for some of them."""
    costs: dict[str, list[Cost]] = {name: [] for name in commands}
    for _ in range(rounds):
        for name, command in commands.items():
            before.get(name, lambda: None)()
            costs[name].append(run(command))
    return costs


def ratio(costs: Mapping[str, Sequence[Cost]], name: str, peer: str) -> float:
    """Return the median over rounds of the CPU seconds of ``name`` by those of ``peer``."""
    pairs = zip(costs[name], costs[peer], strict=True)
    return statistics.median(mine.cpu_s / other.cpu_s for mine, other in pairs)


def middle(values: Sequence[float]) -> float:
    """Return the median."""
    return statistics.median(values)


def folder_size(path: Path) -> int:
    """Return the bytes of all files below a folder."""
    return sum(file.stat().st_size for file in path.rglob("*") if file.is_file())

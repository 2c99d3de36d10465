"""What the processes of ROS nodes on this host are busy with.

Reading is spread: processor time and memory of each process at every sweep, what is dearer (open files, context
switches, bytes read and written) of a part of them in turn.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable
from pathlib import Path

import msgspec

from roslens.children.exit_status import how_it_ended
from roslens.live.agent.kept_open import KeptOpen
from roslens.live.agent.last_log import last_lines, log_folder
from roslens.model.acting.process_end import UNKNOWN
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Change, Event, Process
from roslens.model.traffic.sample import Sample

IN_TURN = 10
"""The dear values of a process are read at every tenth sweep."""

FORGET_AFTER = 15
"""Programs without ROS are looked at again after so many searches."""

_MARKS = re.compile(rb"librmw_|libroscpp|librcl\.|/rospy/|/rclpy/|libfastrtps|libfastdds")
_SAID = re.compile(rb"(?:^|\0)(?:__name:=|__node:=|__ns:=|--ros-args\0|[^\0]*/(?:rosmaster|roscore|nodelet)\0)")
_LONGEST_COMMAND = 300
_FIELDS_AFTER_NAME = 22


NEVER = float("-inf")
NOT = float("inf")
_STOPPED = (b"T", b"t")
_HUNG = b"D"
_ENDED = (b"Z", b"X")
_MOST_TASKS = 64
"""Threads of a process that are asked how long they waited."""
_SCHEDSTAT_FIELDS = 3
_SCALES = {"cpu_wait": 1e-7}
"""From what is counted to the unit of the signal: nanoseconds per second to percent."""


class _Watched(msgspec.Struct):
    """A process under watch and its last counters."""

    pid: int
    started_ticks: int
    stat: KeptOpen
    handle: int
    entity: EntityId
    process: Process
    seen: float = NEVER
    ticks: int = 0
    slow_seen: float = NEVER
    slow: dict[str, int] = {}
    kept: dict[str, float] = {}
    stopped: float = NOT
    hung: float = NOT
    log: Path | None = None
    owner: int = -1


class ProcessSampler:
    """Finds the processes that hold ROS nodes and samples them."""

    def __init__(
        self,
        host: str,
        *,
        proc: Path = Path("/proc"),
        open_handle: Callable[[int], int] | None = None,
        ticks_per_second: int = os.sysconf("SC_CLK_TCK"),
        page_bytes: int = os.sysconf("SC_PAGE_SIZE"),
        memory_bytes: int = 0,
    ) -> None:
        """Watch ``host``; ``open_handle`` gives a descriptor that becomes readable when a process ends (pidfd)."""
        self._host = host
        self._proc = proc
        self._open_handle = open_handle if open_handle is not None else _pidfd
        self._hertz = ticks_per_second
        self._page = page_bytes
        self._memory = memory_bytes or _total_memory(proc)
        self._watched: dict[int, _Watched] = {}
        self._passed_over: set[int] = set()
        self._finds = 0
        self._sweep = 0
        self._named: frozenset[int] = frozenset()

    def name(self, pids: Iterable[int]) -> None:
        """Watch these processes too, because they are known to contain nodes; replaces those named before."""
        self._named = frozenset(pids)
        self._passed_over -= self._named

    def find(self, now: float) -> list[Event]:
        """Look for processes that came or went since the last call; returns what happened."""
        events = []
        there = set(_pids(self._proc))
        events += [self._gone(pid, now) for pid in sorted(set(self._watched) - there)]
        self._finds += 1
        if self._finds % FORGET_AFTER == 0:
            # A number may have gone and come back for another program between two looks.
            self._passed_over.clear()
        self._passed_over &= there
        told_when_they_end = {pid for pid, one in self._watched.items() if one.handle >= 0}
        for pid in sorted(there - self._passed_over - told_when_they_end):
            ticks = self._started(pid)
            known = self._watched.get(pid)
            if ticks is None or (known is not None and known.started_ticks == ticks):
                continue
            if known is not None:
                events.append(self._gone(pid, now))
            events += self._look_at(pid, ticks, now)
        return events

    def ended(self, pid: int, now: float) -> Event | None:
        """Return the end of a process, as its handle reported it; None if it is not watched."""
        return self._gone(pid, now) if pid in self._watched else None

    def handles(self) -> dict[int, int]:
        """Return the descriptors that become readable when a process ends, with its pid."""
        return {one.handle: pid for pid, one in self._watched.items() if one.handle >= 0}

    def processes(self) -> tuple[Process, ...]:
        """Return the processes under watch."""
        return tuple(sorted(one.process for one in self._watched.values()))

    def sample(self, now: float) -> list[Sample]:
        """Return what each process does at ``now``; rates are from the second sample on."""
        self._sweep += 1
        samples = []
        for number, one in enumerate(self._watched.values()):
            values = self._quick(one, now)
            if values is None:
                continue
            if number % IN_TURN == self._sweep % IN_TURN or one.slow_seen == NEVER:
                self._dear(one, now)
            values.update(one.kept)
            samples.append(Sample(one.entity, now, values))
        return samples

    def entity(self, pid: int) -> EntityId:
        """Return the id of a process of this host: ``<host>/<pid>``."""
        return EntityId(EntityKind.PROCESS, f"{self._host}/{pid}")

    def close(self) -> None:
        """Let all processes go."""
        for one in self._watched.values():
            _let_go(one)
        self._watched.clear()

    def _look_at(self, pid: int, ticks: int, now: float) -> list[Event]:
        folder = self._proc / str(pid)
        command = _bytes_of(folder / "cmdline")
        named = pid in self._named
        if not named and not _SAID.search(command) and not _MARKS.search(_bytes_of(folder / "maps")):
            # A program may load its ROS libraries a moment after it began: young ones are looked at again.
            if self._age(ticks) > 10.0:
                self._passed_over.add(pid)
            return []
        written = command.rstrip(b"\0").replace(b"\0", b" ").decode("utf-8", "replace")[:_LONGEST_COMMAND]
        inner = _inner(_bytes_of(folder / "status"))
        process = Process(self._host, pid, written, self._started_at(ticks), inner=inner if inner != pid else 0)
        entity = self.entity(pid)
        # In another namespace a path is that of another file.
        log = log_folder(_bytes_of(folder / "environ")) if inner in (0, pid) else None
        self._watched[pid] = _Watched(
            pid, ticks, KeptOpen(folder / "stat"), self._open_handle(pid), entity, process,
            log=log, owner=_owner(folder),
        )  # fmt: skip
        return [Event(now, Change.APPEARED, str(entity), written)]

    def _gone(self, pid: int, now: float) -> Event:
        one = self._watched.pop(pid)
        ended = how_it_ended(pid, one.handle, self._proc) if one.handle >= 0 else UNKNOWN
        _let_go(one)
        said = last_lines(one.log, pid, one.owner) if one.log is not None else ()
        return Event(now, Change.VANISHED, str(one.entity), one.process.command, ended, said)

    def _quick(self, one: _Watched, now: float) -> dict[str, float] | None:
        fields = _stat_fields(one.stat.read())
        if fields is None or int(fields[19]) != one.started_ticks:
            return None
        ticks = int(fields[11]) + int(fields[12])
        memory = float(int(fields[21]) * self._page)
        values = {"memory": memory, "threads": float(fields[17])}
        if self._memory:
            values["memory_share"] = 100 * memory / self._memory
        if one.seen != NEVER and now > one.seen:
            values["cpu"] = 100 * max(ticks - one.ticks, 0) / self._hertz / (now - one.seen)
        # Stopped since some time after the last look; waiting for the kernel is usual for a moment.
        one.stopped = min(one.stopped, one.seen if one.seen != NEVER else now) if fields[0] in _STOPPED else NOT
        one.hung = min(one.hung, now) if fields[0] == _HUNG else NOT
        values["stopped"], values["hung"] = max(now - one.stopped, 0.0), max(now - one.hung, 0.0)
        one.seen, one.ticks = now, ticks
        return values

    def _dear(self, one: _Watched, now: float) -> None:
        folder = self._proc / str(one.pid)
        counters = _counters_of(folder)
        passed = now - one.slow_seen
        if one.slow_seen != NEVER and passed > 0:
            for key, value in counters.items():
                if key in one.slow:
                    one.kept[key] = max(value - one.slow[key], 0) / passed * _SCALES.get(key, 1.0)
        try:
            one.kept["open_files"] = float(sum(1 for _ in (folder / "fd").iterdir()))
        except OSError:
            one.kept.pop("open_files", None)
        one.slow, one.slow_seen = counters, now

    def _started(self, pid: int) -> int | None:
        """Return when a process began; None where it has ended, also where its parent has not asked how yet."""
        fields = _stat_fields(_bytes_of(self._proc / str(pid) / "stat"))
        return None if fields is None or fields[0] in _ENDED else int(fields[19])

    def _age(self, ticks: int) -> float:
        uptime = _bytes_of(self._proc / "uptime").split()
        return float(uptime[0]) - ticks / self._hertz if uptime else 0.0

    def _started_at(self, ticks: int) -> float:
        for line in _bytes_of(self._proc / "stat").splitlines():
            if line.startswith(b"btime "):
                return int(line.split()[1]) + ticks / self._hertz
        return 0.0


def _let_go(one: _Watched) -> None:
    one.stat.close()
    if one.handle >= 0:
        os.close(one.handle)


def _counters_of(folder: Path) -> dict[str, int]:
    """Return what the system counts of a process beside its CPU time, as far as it may be read."""
    counters: dict[str, int] = {}
    for line in _bytes_of(folder / "status").splitlines():
        if line.startswith((b"voluntary_ctxt_switches:", b"nonvoluntary_ctxt_switches:")):
            counters["context_switches"] = counters.get("context_switches", 0) + int(line.split()[1])
    for line in _bytes_of(folder / "io").splitlines():
        for key, start in (("disk_read", b"read_bytes:"), ("disk_write", b"write_bytes:")):
            if line.startswith(start):
                counters[key] = int(line.split()[1])
    waited = _waited(folder)
    if waited is not None:
        counters["cpu_wait"] = waited
    return counters


def _waited(folder: Path) -> int | None:
    """Return for how many nanoseconds the threads of a process have waited for a processor; None where unknown."""
    try:
        tasks = sorted((folder / "task").iterdir())[:_MOST_TASKS]
    except OSError:
        return None
    fields = [_bytes_of(task / "schedstat").split() for task in tasks]
    known = [int(one[1]) for one in fields if len(one) == _SCHEDSTAT_FIELDS]
    return sum(known) if known else None


def _pids(proc: Path) -> Iterable[int]:
    return sorted(int(entry.name) for entry in proc.iterdir() if entry.name.isdigit())


def _stat_fields(text: bytes | None) -> list[bytes] | None:
    """Return the fields behind the name of a process, which may hold blanks and brackets itself."""
    fields = (text or b"").rpartition(b")")[2].split()
    return fields if len(fields) >= _FIELDS_AFTER_NAME else None


def _inner(status: bytes) -> int:
    """Return the id of a process in the innermost namespace, which it sees itself; 0 if that is unknown."""
    for line in status.splitlines():
        if line.startswith(b"NSpid:"):
            return int(line.split()[-1])
    return 0


def _bytes_of(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError:
        return b""


def _owner(folder: Path) -> int:
    try:
        return folder.stat().st_uid
    except OSError:
        return -1


def _total_memory(proc: Path) -> int:
    for line in _bytes_of(proc / "meminfo").splitlines():
        if line.startswith(b"MemTotal:"):
            return int(line.split()[1]) * 1024
    return 0


def _pidfd(pid: int) -> int:
    try:
        return os.pidfd_open(pid)
    except OSError:
        return -1

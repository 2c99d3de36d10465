"""How the processes of nodes were started: kept while they run, so that one that is gone can be started as it was.

What is kept stays in the memory of this process: environments may hold secrets.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

import msgspec

MOST_KEPT = 500
_MOST_BYTES = 1_000_000
_IDS = re.compile(rb"^(Uid|Gid|Groups):[ \t]*(.*)$", re.MULTILINE)
_SUPERVISORS = ("roslaunch", "ros2", "launch", "rosmon", "play_launch", "supervisord", "runit", "s6-supervise")


class Recorded(msgspec.Struct, frozen=True):
    """A process as it was started.

    Attributes:
        pid: its number.
        started_ticks: when it was started, in the kernel's ticks; a number and this are one process for ever.
        program: file that it runs.
        words: its command line.
        environment: that it was started with.
        folder: that it works in.
        user: numbers of user, group and further groups.
        parent: number of the process that started it.
        supervisor: name of that process, where it is one that starts again what ends; empty where it is not.
    """

    pid: int
    started_ticks: int
    program: str
    words: tuple[str, ...]
    environment: dict[str, str]
    folder: str
    user: tuple[int, int, tuple[int, ...]]
    parent: int = 0
    supervisor: str = ""

    @property
    def command(self) -> str:
        """The command line as one text."""
        return " ".join(self.words)


class ProcessRecords:
    """Keeps how processes were started, the most recent ones."""

    def __init__(self, proc: Path = Path("/proc"), most: int = MOST_KEPT) -> None:
        """Read below ``proc``."""
        self._proc = proc
        self._most = most
        self._kept: dict[int, Recorded] = {}
        self._counted: dict[int, set[str]] = {}

    def keep(self, pids: Iterable[int] | Mapping[int, Iterable[str]]) -> None:
        """Record processes that hold nodes, unless they are recorded; a mapping has the nodes that count in each."""
        counting = pids if isinstance(pids, Mapping) else {}
        for pid in pids:
            ticks = started_ticks(pid, self._proc)
            known = self._kept.get(pid)
            if ticks is None:
                continue
            if known is None or known.started_ticks != ticks:
                if (found := record(pid, self._proc)) is None:
                    continue
                self._kept.pop(pid, None)
                self._kept[pid] = known = found
                self._counted[pid] = set()
            self._counted.setdefault(pid, set()).update(counting.get(pid, ()))
        while len(self._kept) > self._most:
            gone = next((pid for pid in self._kept if not self.alive(self._kept[pid])), next(iter(self._kept)))
            del self._kept[gone]
            self._counted.pop(gone, None)

    def shows(self, one: Recorded, node: str) -> bool:
        """Whether this host itself saw that a process holds a node: it counts its traffic, or was started under it."""
        return node in self._counted.get(one.pid, ()) or names_node(one.words, node)

    def of(self, pid: int) -> Recorded | None:
        """Return how the last process of that number that held nodes was started."""
        return self._kept.get(pid)

    def alive(self, one: Recorded) -> bool:
        """Whether that very process is there, and no zombie."""
        return started_ticks(one.pid, self._proc) == one.started_ticks

    def again(self, one: Recorded) -> int:
        """Return a process that was started later with the same command line in the same folder; 0 for none."""
        for name in os.listdir(self._proc):  # noqa: PTH208 - names alone
            if name.isdigit() and int(name) != one.pid and (ticks := started_ticks(int(name), self._proc)) is not None:
                if ticks <= one.started_ticks:
                    continue
                found = record(int(name), self._proc)
                if found is not None and (found.words, found.folder) == (one.words, one.folder):
                    return found.pid
        return 0


def names_node(words: Iterable[str], node: str) -> bool:
    """Whether a command line gives its node this name, as launch files do (``__node:=``, ``__name:=``, ``__ns:=``)."""
    given = dict(word.split(":=", 1) for word in words if ":=" in word)
    name = given.get("__node") or given.get("__name") or ""
    if not name:
        return False
    if "__ns" in given:
        return f"/{given['__ns'].strip('/')}/{name}".replace("//", "/") == node
    return node.rpartition("/")[2] == name


def started_ticks(pid: int, proc: Path = Path("/proc")) -> int | None:
    """Return when a process was started, in the kernel's ticks; None where there is none, or it is a zombie."""
    try:
        fields = (proc / str(pid) / "stat").read_bytes().rpartition(b")")[2].split()
        return None if fields[0] in (b"Z", b"X") else int(fields[19])
    except (OSError, IndexError, ValueError):
        return None


def record(pid: int, proc: Path = Path("/proc")) -> Recorded | None:
    """Return how a process was started; None where that may not be seen, or it is gone."""
    place = proc / str(pid)
    try:
        words = _texts(place / "cmdline")
        environment = dict(one.partition("=")[::2] for one in _texts(place / "environ") if "=" in one)
        program, folder = os.readlink(place / "exe"), os.readlink(place / "cwd")  # noqa: PTH115 - as text
        status = (place / "status").read_bytes()
        parent = int((place / "stat").read_bytes().rpartition(b")")[2].split()[1])
        ids = {name: [int(one) for one in value.split()] for name, value in _IDS.findall(status)}
        user = (ids[b"Uid"][0], ids[b"Gid"][0], tuple(ids.get(b"Groups", ())))
        ticks = started_ticks(pid, proc)
    except (OSError, ValueError, IndexError, KeyError):
        return None
    if ticks is None or not words or program.endswith(" (deleted)") or folder.endswith(" (deleted)"):
        return None
    return Recorded(pid, ticks, program, words, environment, folder, user, parent, _supervisor(parent, proc))


def _supervisor(pid: int, proc: Path) -> str:
    """Return the name of a process that starts again what ends, as far as its command line shows it."""
    if pid <= 1:
        return ""
    try:
        words = _texts(proc / str(pid) / "cmdline")
    except OSError:
        return ""
    names = [one.rpartition("/")[2] for one in words[:3]]
    return next((name for name in names if name in _SUPERVISORS), "")


def _texts(path: Path) -> tuple[str, ...]:
    with path.open("rb") as file:
        content = file.read(_MOST_BYTES)
    return tuple(os.fsdecode(one) for one in content.removesuffix(b"\0").split(b"\0")) if content else ()

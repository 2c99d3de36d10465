"""What all nodes of a host count, for who has no ROS and hence knows publishers by their identifiers alone."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from roslens.live.inside import slots
from roslens.live.inside.call_times import CallTimes
from roslens.live.inside.counters import CounterReader, joined
from roslens.model.failure import Failure
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import BY_GID, Tally

SHARED = Path("/dev/shm")  # noqa: S108 - folders in it are looked at before use
BOOT = Path("/proc/sys/kernel/random/boot_id")
_LOOK_S = 0.9
_NOBODY = "0" * 32


def counter_folders(environment: Mapping[str, str], uid: int | None = None, shared: Path = SHARED) -> list[str]:
    """Return where nodes of this host count: of the user alone, of all users for root.

    A folder that is named after a user and belongs to somebody else is none.
    """
    user = os.getuid() if uid is None else uid
    folders = {slots.folder_of(environment, user)}
    if user == 0 and slots.VARIABLE not in environment:
        for place in shared.glob("roslens-*"):
            owner = place.name.removeprefix("roslens-")
            try:
                folders |= {str(place)} if owner.isdigit() and place.lstat().st_uid == int(owner) else set()
            except OSError:
                continue
    return sorted(folders)


def place_of(folder: str, boot: Path = BOOT) -> str:
    """Return what is the same for all who see a folder, in containers too, and differs from all others; else empty."""
    try:
        found = os.stat(folder)  # noqa: PTH116 - a Path would be made ten times a second
        return f"{boot.read_text('ascii').strip()}/{found.st_dev}/{found.st_ino}"
    except OSError:
        return ""


class HostCounters:
    """Reads the counters of all nodes of a host.

    Args:
        host: its name.
        environment: that says where counters are.
        beside: whether an observer of ROS runs beside, which reads the counters of its own user and tidies up: then
            those are read alone, and nothing is taken away.
    """

    def __init__(self, host: str, environment: Mapping[str, str], *, beside: bool = False) -> None:
        self._host = host
        self._environment = environment
        self._beside = beside
        self._readers: dict[str, CounterReader] = {}
        self._places: dict[str, str] = {}
        self._looked = float("-inf")
        self._calls: dict[str, CallTimes] = {}

    def read(self, now: float) -> list[tuple[str, list[Tally]]]:
        """Return what was counted since the last read, by place; ``now`` is seconds since the epoch on this host."""
        if not 0 <= now - self._looked < _LOOK_S:
            self._looked = now
            self._look(now)
        found = []
        for folder, reader in self._readers.items():
            tallies = joined(reader.read(now), _by_gid, self._host)
            self._calls[folder].add(reader.called())
            # A folder appears with the first node that counts.
            place = self._places[folder] = self._places.get(folder) or place_of(folder)
            if place:
                found.append((place, tallies))
        return found

    def look(self, now: float) -> None:
        """Find out who counts, which costs a fraction of reading what."""
        self._look(now)
        for reader in self._readers.values():
            reader.look(now)

    def calls(self, now: float) -> list[tuple[str, list[Sample]]]:
        """Return what was counted of services since this was last asked, by place."""
        found = [(self._places.get(folder, ""), calls.samples(now)) for folder, calls in self._calls.items()]
        return [(place, samples) for place, samples in found if place and samples]

    def nodes(self) -> dict[int, frozenset[str]]:
        """Return who counts in which process, by the id that the process sees itself."""
        found: dict[int, frozenset[str]] = {}
        for reader in self._readers.values():
            for pid, nodes in reader.nodes().items():
                found[pid] = found.get(pid, frozenset()) | nodes
        return found

    def places(self) -> list[str]:
        """Return where is counted."""
        return sorted(filter(None, self._places.values()))

    def failures(self) -> list[Failure]:
        """Return what went wrong since this was last asked."""
        return [failure for reader in self._readers.values() for failure in reader.failures()]

    def close(self) -> None:
        """Let go of all files."""
        for reader in self._readers.values():
            reader.close()

    def _look(self, now: float) -> None:
        """Find new folders: what lies in those that are there at the beginning was counted nobody knows when."""
        first = not self._readers
        known = [slots.folder_of(self._environment)] if self._beside else counter_folders(self._environment)
        for folder in known:
            if folder not in self._readers:
                reader = self._readers[folder] = CounterReader(folder, tidy=not self._beside)
                self._calls[folder] = CallTimes()
                if first:
                    reader.read(now)
            self._places[folder] = place_of(folder)


def _by_gid(gid: str) -> str:
    return "" if gid == _NOBODY else BY_GID + gid

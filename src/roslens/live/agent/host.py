"""What a host is busy with, read from ``/proc`` and ``/sys``.

A part that is not there, a sensor in a virtual machine for one, gives no value; it never gives 0. Values that are rates
need two readings, so the first sample has none of them.
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TypeVar

from roslens.live.agent.kept_open import KeptOpen
from roslens.model.entity import EntityId, EntityKind
from roslens.model.traffic.sample import Sample

Number = TypeVar("Number", int, float)
GpuReader = Callable[[], Mapping[str, float]]
"""Gives ``gpu``, ``gpu_memory_share`` and ``gpu_temperature``, as far as they are known."""

_SECTOR_BYTES = 512
_REAL_FILE_SYSTEMS = frozenset(
    b"ext2 ext3 ext4 xfs btrfs f2fs vfat exfat ntfs ntfs3 fuseblk jfs reiserfs zfs overlay bcachefs".split()
)
_RESENT_S = 5.0
_LEAST_SEGMENTS = 100
"""Of fewer, a single one that a busy host sends again would look like loss."""
_COLDEST, _HOTTEST = -60.0, 150.0
"""Sensors that are not connected report values beyond these, in degrees Celsius."""


class HostSampler:
    """Samples one host; keeps the last counters to turn them into rates."""

    def __init__(
        self,
        name: str,
        *,
        proc: Path = Path("/proc"),
        sys: Path = Path("/sys"),
        space: Callable[[bytes], os.statvfs_result] = os.statvfs,
        gpu: GpuReader | None = None,
    ) -> None:
        """Sample the host ``name``; the other arguments are the sources."""
        self._entity = EntityId(EntityKind.HOST, name)
        self._sys = sys
        self._space = space
        self._gpu = gpu
        self._files = {
            key: KeptOpen(proc / path)
            for key, path in {
                "stat": "stat",
                "memory": "meminfo",
                "disks": "diskstats",
                "network": "net/dev",
                "tcp": "net/snmp",
                "mounts": "mounts",
                "load": "loadavg",
                "pressure_cpu": "pressure/cpu",
                "pressure_memory": "pressure/memory",
                "pressure_io": "pressure/io",
            }.items()
        }
        self._sensors = [KeptOpen(path) for path in _sensor_files(sys)]
        self._cpu: dict[bytes, tuple[int, int]] = {}
        self._counters: dict[str, int] = {}
        self._segments: deque[tuple[float, int, int]] = deque()
        self._time = 0.0

    def sample(self, now: float) -> Sample:
        """Return what the host does at ``now``, in seconds."""
        values: dict[str, float] = {}
        for part in (self._processors, self._memory, self._space_left, self._pressure, self._load, self._heat):
            values.update(_survived(part))
        values.update(self._rates(now))
        values.update(_survived(lambda: self._resent(now)))
        if self._gpu is not None:
            values.update(_survived(self._gpu))
        return Sample(self._entity, now, {key: value for key, value in values.items() if value == value})

    def close(self) -> None:
        """Close every file."""
        for file in (*self._files.values(), *self._sensors):
            file.close()

    def _text(self, key: str) -> bytes:
        return self._files[key].read() or b""

    def _processors(self) -> dict[str, float]:
        shares: dict[bytes, float] = {}
        for line in self._text("stat").splitlines():
            if not line.startswith(b"cpu"):
                break
            name, *fields = line.split()
            ticks = [int(field) for field in fields[:8]]
            total, idle = sum(ticks), sum(ticks[3:5])
            before_total, before_idle = self._cpu.get(name, (total, idle))
            self._cpu[name] = (total, idle)
            if total > before_total:
                busy = (total - before_total) - (idle - before_idle)
                shares[name] = 100 * min(max(busy / (total - before_total), 0.0), 1.0)
        whole = shares.pop(b"cpu", None)
        values = {} if whole is None else {"cpu": whole}
        if shares:
            values["cpu_core_max"] = max(shares.values())
        return values

    def _memory(self) -> dict[str, float]:
        size = {}
        for line in self._text("memory").splitlines():
            key, _, rest = line.partition(b":")
            words = rest.split()
            if words:
                size[key] = int(words[0]) * 1024
        values = {}
        total, available = size.get(b"MemTotal", 0), size.get(b"MemAvailable")
        if total and available is not None:
            values["memory"] = float(total - available)
            values["memory_share"] = 100 * (total - available) / total
        swap, free = size.get(b"SwapTotal", 0), size.get(b"SwapFree")
        if swap and free is not None:
            values["swap_share"] = 100 * (swap - free) / swap
        return values

    def _space_left(self) -> dict[str, float]:
        free, used = [], []
        for place in _writable(self._text("mounts").splitlines()):
            try:
                found = self._space(place)
            except OSError:
                continue
            in_use, available = found.f_blocks - found.f_bfree, found.f_bavail
            if in_use + available > 0:
                free.append(float(available * found.f_frsize))
                used.append(100 * in_use / (in_use + available))
        return {"disk_free": min(free), "disk_share": max(used)} if free else {}

    def _pressure(self) -> dict[str, float]:
        values = {}
        for key in ("pressure_cpu", "pressure_memory", "pressure_io"):
            text = self._text(key)
            if text.startswith(b"some avg10="):
                values[key] = float(text.split(b" ", 2)[1].partition(b"=")[2])
        return values

    def _load(self) -> dict[str, float]:
        text = self._text("load")
        return {"load": float(text.split()[0])} if text else {}

    def _heat(self) -> dict[str, float]:
        found = []
        for sensor in self._sensors:
            text = (sensor.read() or b"").strip()
            if text.lstrip(b"-").isdigit() and _COLDEST < int(text) / 1000 < _HOTTEST:
                found.append(int(text) / 1000)
        return {"temperature": max(found)} if found else {}

    def _rates(self, now: float) -> dict[str, float]:
        counters = {**_survived(self._network), **_survived(self._disks)}
        passed = now - self._time
        before, self._counters, self._time = self._counters, counters, now
        if not before or passed <= 0:
            return {}
        rates = {}
        for key, value in counters.items():
            # A counter that went back was reset with its device: nothing is known of that stretch.
            if key in before and value >= before[key]:
                rates[key] = (value - before[key]) / passed
        return rates

    def _network(self) -> dict[str, int]:
        lines = self._text("network").splitlines()[2:]
        if not lines:
            return {}
        totals = {"network_in": 0, "network_out": 0, "network_drops": 0}
        for line in lines:
            name, _, rest = line.partition(b":")
            fields = rest.split()
            if name.strip() != b"lo" and len(fields) >= 12:
                totals["network_in"] += int(fields[0])
                totals["network_out"] += int(fields[8])
                totals["network_drops"] += int(fields[3]) + int(fields[11])
        return totals

    def _resent(self, now: float) -> dict[str, float]:
        """Return the share of TCP segments that were sent again over the last seconds; nothing of few segments."""
        lines = [line.split() for line in self._text("tcp").splitlines() if line.startswith(b"Tcp:")]
        if len(lines) < 2:
            return {}
        counts = dict(zip(lines[0], lines[1], strict=False))
        sent, again = int(counts[b"OutSegs"]), int(counts[b"RetransSegs"])
        kept = self._segments
        if kept and (sent < kept[-1][1] or again < kept[-1][2] or now <= kept[-1][0]):
            kept.clear()
        kept.append((now, sent, again))
        while len(kept) > 2 and kept[1][0] <= now - _RESENT_S:
            kept.popleft()
        sent, again = sent - kept[0][1], again - kept[0][2]
        return {"resent": min(100 * again / sent, 100.0)} if sent >= _LEAST_SEGMENTS else {}

    def _disks(self) -> dict[str, int]:
        totals = {"disk_read": 0, "disk_write": 0}
        whole = 0
        for line in self._text("disks").splitlines():
            fields = line.split()
            if len(fields) >= 10 and self._is_disk(fields[2]):
                whole += 1
                totals["disk_read"] += int(fields[5]) * _SECTOR_BYTES
                totals["disk_write"] += int(fields[9]) * _SECTOR_BYTES
        return totals if whole else {}

    def _is_disk(self, name: bytes) -> bool:
        """Whether it is a disk of its own: partitions and what is made of disks would count twice."""
        if name.startswith((b"loop", b"ram", b"dm-", b"md", b"zram", b"sr")):
            return False
        return (self._sys / "block" / name.decode("ascii", "replace")).exists()


def _survived(part: Callable[[], Mapping[str, Number]]) -> Mapping[str, Number]:
    """Return what ``part`` reads; nothing where the system writes it in a way that is not known."""
    try:
        return part()
    except (ValueError, LookupError, OSError, UnicodeError):
        return {}


def _writable(lines: Iterable[bytes]) -> list[bytes]:
    """Return where file systems are mounted that can be written, each device once."""
    places: dict[bytes, bytes] = {}
    for line in lines:
        fields = line.split()
        if len(fields) >= 4 and fields[2] in _REAL_FILE_SYSTEMS and b"rw" in fields[3].split(b","):
            places.setdefault(fields[0], _unescaped(fields[1]))
    return sorted(places.values())


def _unescaped(place: bytes) -> bytes:
    for written, meant in ((b"\\040", b" "), (b"\\011", b"\t"), (b"\\012", b"\n"), (b"\\134", b"\\")):
        place = place.replace(written, meant)
    return place


def _sensor_files(sys: Path) -> list[Path]:
    return sorted(
        [*sys.glob("class/thermal/thermal_zone*/temp"), *sys.glob("class/hwmon/hwmon*/temp*_input")],
    )

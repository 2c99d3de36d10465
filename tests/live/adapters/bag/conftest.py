"""Recordings written by rosbags, and what they hold counted again, slowly and plainly."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest
from rosbags.highlevel import AnyReader
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from roslens.model.traffic.tally import Moments, Observer, Tally

KINDS = ("ros1", "ros1_bz2", "ros1_lz4", "mcap", "mcap_zstd", "sqlite")
ROW = tuple[str, int, bytes]


def stamped(stamp_ns: int, generation: str, extra: int = 0) -> bytes:
    """Return a std_msgs/Header, which has its stamp where messages with a header have it."""
    first = b"\x00\x01\x00\x00" if generation == "ros2" else struct.pack("<I", 7)
    text = b"x" * extra + b"\x00" * (generation == "ros2")
    return first + struct.pack("<III", stamp_ns // 10**9, stamp_ns % 10**9, len(text)) + text


STORES = {"ros1": get_typestore(Stores.ROS1_NOETIC), "ros2": get_typestore(Stores.LATEST)}


def write_recording(
    path: Path, kind: str, rows: Iterable[ROW], chunk: int = 1 << 20, topics: Iterable[str] = ()
) -> Path:
    """Write messages of PoseStamped, whatever their bytes are; return the file."""
    rows = list(rows)
    names = sorted({topic for topic, _, _ in rows} | set(topics))
    message = "geometry_msgs/msg/PoseStamped"
    if kind.startswith("ros1"):
        writer = Writer1(path / f"{kind}.bag")
        writer.chunk_threshold = chunk
        if kind != "ros1":
            writer.set_compression(Writer1.CompressionFormat[kind.removeprefix("ros1_").upper()])
        with writer:
            lines = {
                name: writer.add_connection(name, message, typestore=STORES["ros1"], callerid=f"/node{name}")
                for name in names
            }
            for topic, time, content in rows:
                writer.write(lines[topic], time, content)
        return writer.path
    plugin = StoragePlugin.SQLITE3 if kind.startswith("sqlite") else StoragePlugin.MCAP
    folder = path / kind
    writer2 = Writer(folder, version=9, storage_plugin=plugin)
    if kind.endswith("_zstd"):
        writer2.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    if kind.endswith("_message"):
        writer2.set_compression(CompressionMode.MESSAGE, CompressionFormat.ZSTD)
    with writer2:
        lines = {name: writer2.add_connection(name, message, typestore=STORES["ros2"]) for name in names}
        written = 0
        for topic, time, content in rows:
            writer2.write(lines[topic], time, content)
            written += len(content)
            if plugin is StoragePlugin.MCAP and written > chunk:
                writer2.storage.close_chunk()
                written = 0
    return next(file for file in folder.iterdir() if file.suffix in {".mcap", ".db3"})


def plain_moments(values: list[float]) -> Moments:
    """Return moments as their definition says."""
    if not values:
        return Moments()
    return Moments(len(values), sum(values), sum(value * value for value in values), min(values), max(values))


def plain_tallies(rows: list[ROW], step_ns: int, generation: str, ages: bool) -> list[tuple[float, list[Tally]]]:
    """Count messages one by one."""
    if not rows:
        return []
    start = min(time for _, time, _ in rows)
    steps = (max(time for _, time, _ in rows) - start) // step_ns + 1
    found = []
    for number in range(steps):
        begin, end = start + number * step_ns, start + (number + 1) * step_ns
        tallies = []
        for topic in sorted({topic for topic, _, _ in rows}):
            mine = sorted((row for row in rows if row[0] == topic), key=lambda row: row[1])
            gaps, old, sizes, times = [], [], 0, []
            for index, (_, time, content) in enumerate(mine):
                if not begin <= time < end:
                    continue
                times.append(time)
                sizes += len(content)
                if index:
                    gaps.append((time - mine[index - 1][1]) / 10**9)
                seconds, nanoseconds = struct.unpack_from("<II", content, 4)
                if ages and (seconds or nanoseconds):
                    old.append((time - seconds * 10**9 - nanoseconds) / 10**9)
            publisher = f"/node{topic}" if generation == "ros1" else ""
            first, last = (times[0] / 10**9, times[-1] / 10**9) if times else (0.0, 0.0)
            tallies.append(
                Tally(
                    topic, publisher, "", begin / 10**9, end / 10**9, len(times), sizes, first, last,
                    plain_moments(gaps), age=plain_moments(old), observer=Observer.RECORDING,
                )
            )  # fmt: skip
        found.append((end / 10**9, tallies))
    return found


def library_rows(path: Path) -> list[ROW]:
    """Return what the rosbags library reads of a recording."""
    with AnyReader([path], default_typestore=STORES["ros2"]) as reader:
        return [(line.topic, time, bytes(content)) for line, time, content in reader.messages()]


@pytest.fixture
def recording() -> Callable[..., Path]:
    """Write a recording."""
    return write_recording


@pytest.fixture
def content_of() -> Callable[..., bytes]:
    """Return the bytes of a message with a stamp."""
    return stamped


@pytest.fixture
def counted_plainly() -> Callable[..., list[tuple[float, list[Tally]]]]:
    """Count messages one by one."""
    return plain_tallies


@pytest.fixture
def read_by_library() -> Callable[[Path], list[ROW]]:
    """Return what the rosbags library reads of a recording."""
    return library_rows


@pytest.fixture(params=KINDS)
def kind(request: pytest.FixtureRequest) -> str:
    """Name each format and compression."""
    return str(request.param)

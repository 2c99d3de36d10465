"""Opening a recording, whatever its format and however many files it has."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec

from roslens.live.adapters.bag import mcap_layout, ros1_layout, sqlite
from roslens.live.adapters.bag.bag import Bag
from roslens.live.adapters.bag.block import Part
from roslens.live.adapters.bag.damage import DamageError, FailureLog
from roslens.live.adapters.bag.files.recorded_files import find_files
from roslens.live.adapters.bag.files.unpacked_file import Unpacked, unpack
from roslens.live.adapters.bag.graphs.graph_messages import graphs_of, named, sole_publishers
from roslens.live.adapters.bag.mcap import open_mcap
from roslens.live.adapters.bag.ros1 import open_ros1
from roslens.live.adapters.bag.source import Source
from roslens.live.adapters.bag.sqlite import SqlitePart
from roslens.model.errors import UsageError

_LONGEST_MAGIC = 16


def open_bag(path: Path | Sequence[Path]) -> Bag:
    """Open a recording: a ROS 1 bag, an MCAP file, a SQLite file, a folder of them, or several of those in order.

    Files that were packed as a whole are unpacked into a temporary folder, which goes with the recording.

    The format is that of the content, whatever the name says. Only what a file says of itself is read, unless it does
    not say it, and of ROS 2 the graphs that somebody published: who published what else is in none of its records.

    Raises:
        UsageError: a path does not exist or holds no recording, no file can be read at all, or files of ROS 1 and of
            ROS 2 are mixed.
    """
    failures = FailureLog()
    files = find_files(path, failures)
    parts: list[Part] = []
    unpacked = []
    for file in files.paths:
        try:
            one = _unpacked(file, failures)
            unpacked += [one.folder] if one is not None else []
            parts.append(_open_part(one.path if one is not None else file, files.compression))
        except UsageError as error:
            if len(files.paths) == 1:
                raise
            failures.add(file, error.what, expected=error.expected, advice=error.advice, partial=False)
    if not parts:
        raise UsageError(
            f"none of {len(files.paths)} files can be read", where=str(files.paths[0].parent), expected="a recording"
        )
    generations = {part.generation: part.path for part in parts}
    if len(generations) > 1:
        raise UsageError(
            f'"{generations["ros1"]}" is of ROS 1 and "{generations["ros2"]}" of ROS 2',
            expected="recordings of one generation",
            advice="Open one of them alone.",
        )
    graphs = graphs_of(parts)
    publishers = sole_publishers(graphs)
    for part in parts if publishers else ():
        part.channels = named(part.channels, publishers)
    return Bag(parts, failures, graphs, unpacked)


def _unpacked(path: Path, failures: FailureLog) -> Unpacked | None:
    """Unpack a file that was packed as a whole; None of any other.

    Raises:
        UsageError: it cannot be opened, or not unpacked.
    """
    try:
        return unpack(path, failures)
    except OSError as error:
        raise _closed(path, error) from None


def _closed(path: Path, error: OSError) -> UsageError:
    return UsageError(f'"{path}" cannot be opened: {error.strerror or error}', advice="Check its permissions.")


def _open_part(path: Path, compression: str) -> Part:
    """Open one file.

    Raises:
        UsageError: nothing of it can be used.
    """
    advice = "Check that it is a recording and was copied completely."
    try:
        source = Source(path)
        magic = source.read(0, min(_LONGEST_MAGIC, source.size))
        part = _part_of(source, magic)
    except OSError as error:
        raise _closed(path, error) from None
    except DamageError as damage:
        raise UsageError(f"a recording that cannot be read: {damage}", where=str(path), advice=advice) from None
    if part is None:
        what = "an empty file" if not magic else f"a file that begins with {magic!r}"
        expected = "a ROS 1 bag of version 2.0, an MCAP file or a SQLite file"
        if magic.startswith(b"#ROSBAG V"):
            advice = "Bags older than 2.0 are converted by `rosbag fix`."
        raise UsageError(what, where=str(path), expected=expected, advice=advice)
    if compression:
        part.channels = {
            number: msgspec.structs.replace(channel, compression=compression)
            for number, channel in part.channels.items()
        }
        part.exact_sizes = False
    return part


def _part_of(source: Source, magic: bytes) -> Part | None:
    if magic.startswith(ros1_layout.MAGIC):
        return open_ros1(source)
    if magic.startswith(mcap_layout.MAGIC):
        return open_mcap(source)
    if magic.startswith(sqlite.MAGIC):
        return SqlitePart(source.path)
    return None

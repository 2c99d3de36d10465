"""What a recording says for an answer: time lines of all topics, who was there, and what nodes logged."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from roslens.cli.why.recorded_transforms import recorded_transforms, too_many
from roslens.compare.why.recorded import Gone, LogLine, Recorded, RecordedTopic
from roslens.compare.why.time_line import time_line

if TYPE_CHECKING:
    from roslens.live.adapters.bag.bag import Bag

_LOGS = {"rosgraph_msgs/Log", "rosgraph_msgs/msg/Log", "rcl_interfaces/msg/Log"}
_MOST_LOGS = 100_000
_LEVELS = {"ros1": {4: "warning", 8: "error", 16: "fatal"}, "ros2": {30: "warning", 40: "error", 50: "fatal"}}
_SECOND = 1e9


def recorded_evidence(options: argparse.Namespace, pair: tuple[str, ...]) -> Recorded:
    """Return what a recording says.

    Args:
        options: of the command line.
        pair: frames that are asked about, of a transform target and source; transforms are read for these alone.

    Raises:
        UsageError: it is not there or no recording.
    """
    from roslens.cli.page.named_apart import named_apart
    from roslens.live.adapters.bag.open_bag import open_bag

    bag = open_bag(options.bag)
    pieces: dict[str, list[np.ndarray[tuple[int], np.dtype[np.int64]]]] = {one.name: [] for one in bag.topics}
    for (topic, _), times in bag.arrivals().items():
        pieces.setdefault(topic, []).append(times)
    types = {one.name: one.type for one in bag.topics}
    topics = {}
    for name, found in pieces.items():
        times = np.sort(np.concatenate(found)) if found else np.zeros(0, np.int64)
        topics[name] = RecordedTopic(types.get(name, ""), time_line(times / _SECOND, bag.end))
    transforms = recorded_transforms(bag, pair) if pair else None
    graph, logs, gone = bag.graph(), tuple(sorted(_logs(bag))), tuple(_gone(bag))
    # Reading on may find more that cannot be read.
    failures = (*(str(one) for one in bag.failures), *((too_many(bag),) if transforms and too_many(bag) else ()))
    return Recorded(
        ", ".join(named_apart(options.bag)), bag.start, bag.end, topics, graph, logs, gone, transforms, failures,
        " ".join(str(one) for one in options.bag),
    )  # fmt: skip


def _gone(bag: Bag) -> Iterator[Gone]:
    for (_, before), (time, after) in zip(bag.graphs, bag.graphs[1:], strict=False):
        for name in sorted({one.name for one in before.nodes} - {one.name for one in after.nodes}):
            yield Gone(time, name)


def _logs(bag: Bag) -> Iterator[LogLine]:
    """Yield warnings and errors that nodes logged, of the first hundred thousand lines."""
    levels = _LEVELS[bag.generation]
    for one in islice(bag.decoded(_LOGS), _MOST_LOGS):
        level = levels.get(int(one.message.level))
        if level is not None:
            yield LogLine(one.time / _SECOND, str(one.message.name), level, str(one.message.msg))

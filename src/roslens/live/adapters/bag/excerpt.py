"""A recording in memory, of which stretches are replayed again and again, each with another fault."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

import msgspec
import numpy as np

from roslens.live.adapters.bag.bag import Bag
from roslens.live.adapters.bag.steps import Lane, Steps
from roslens.live.adapters.bag.topic import BagTopic
from roslens.live.mutation.fault import SILENT, Fault, FaultKind, Traffic, changed, wrong_value
from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.model.graph import Graph
from roslens.model.traffic.tally import Tally

MOST_MESSAGES = 20_000_000
"""24 bytes each."""
MOST_FIELDS = 2_000_000
_SECOND = 1_000_000_000


class FieldRow(msgspec.Struct, frozen=True, gc=False):
    """Values of fields of a message: seconds of receipt, topic, and values by path."""

    time: float
    topic: str
    values: dict[str, float]


class Kept:
    """The traffic of a recording, with the stamps and fields that a reference asks for.

    Attributes:
        start: seconds of the first message.
        end: seconds of the last.
        topics: by name.
        lanes: messages by topic and publisher.
    """

    def __init__(self, bag: Bag, stamps: Collection[str], fields: Mapping[str, Collection[str]]) -> None:
        """Read a recording.

        Raises:
            UsageError: it has too many messages for that.
        """
        if bag.messages > MOST_MESSAGES:
            raise UsageError(
                f"a recording of {bag.messages:,} messages",
                expected=f"at most {MOST_MESSAGES:,}",
                advice="Take a part of it, such as one of its files",
            )
        self.start, self.end = bag.start, bag.end
        self.topics: Sequence[BagTopic] = bag.topics
        self.lanes: dict[Lane, Traffic] = dict(bag.traffic(stamps))
        self._graph = bag.graph()
        self._rows = [FieldRow(*row) for _, row in zip(range(MOST_FIELDS), bag.fields(fields), strict=False)]
        self._times = np.array([row.time for row in self._rows])
        self.failures = bag.failures
        self._wrong = self._wrong_values()

    def graph(self) -> Graph:
        """Return topics and publishers."""
        return self._graph

    def checked(self, topic: str) -> bool:
        """Whether fields of a topic are read."""
        return topic in self._wrong

    def excerpt(self, begin_s: float, end_s: float, fault: Fault | None = None) -> Excerpt:
        """Return a stretch of it as a recording of its own, with a fault or without."""
        return Excerpt(self, begin_s, end_s, fault)

    def rows(self, begin_s: float, end_s: float, fault: Fault | None) -> Iterator[FieldRow]:
        """Yield fields of a stretch, with a fault or without."""
        first, last = np.searchsorted(self._times, [begin_s, end_s]).tolist()
        for row in self._rows[first:last]:
            inside = fault is not None and fault.topic == row.topic and fault.begin_s <= row.time < fault.end_s
            if not inside or fault is None:
                yield row
            elif fault.kind is FaultKind.WRONG_VALUE:
                yield FieldRow(row.time, row.topic, {path: self._wrong[row.topic][path] for path in row.values})
            elif fault.kind in SILENT:
                continue
            else:
                yield row

    def _wrong_values(self) -> dict[str, dict[str, float]]:
        series: dict[str, dict[str, list[float]]] = {}
        for row in self._rows:
            for path, value in row.values.items():
                if value - value == 0:
                    series.setdefault(row.topic, {}).setdefault(path, []).append(value)
        return {
            topic: {path: wrong_value(np.array(values)) for path, values in paths.items()}
            for topic, paths in series.items()
        }


class Excerpt:
    """A stretch of a recording, as `live.replay` takes it."""

    def __init__(self, kept: Kept, begin_s: float, end_s: float, fault: Fault | None) -> None:
        self._kept = kept
        self._fault = fault
        self.start, self.end = max(begin_s, kept.start), min(end_s, kept.end)
        self.topics = kept.topics
        self.failures: tuple[Failure, ...] = ()
        self.graphs: tuple[tuple[float, Graph], ...] = ()

    def graph(self) -> Graph:
        """Return topics and publishers."""
        return self._kept.graph()

    def tallies(self, step: float = 1.0, stamps: Collection[str] = ()) -> Iterator[tuple[float, list[Tally]]]:
        """Yield the traffic step by step, with the age of those topics of ``stamps`` whose stamps were read."""
        begin, end = round(self.start * _SECOND), round(self.end * _SECOND)
        steps = Steps(begin, round(step * _SECOND), self._kept.lanes)
        for lane, (times, sizes, marks) in self._kept.lanes.items():
            first, last = np.searchsorted(times, [begin, end + 1]).tolist()
            aged = marks if marks is not None and lane.topic in stamps else None
            part: Traffic = (times[first:last], sizes[first:last], None if aged is None else aged[first:last])
            if self._fault is not None and self._fault.concerns(lane.topic, lane.publisher):
                part = changed(self._fault, part)
            steps.add(lane, *part)
        yield from steps.rest(end)

    def fields(self, wanted: Mapping[str, Collection[str]]) -> Iterator[tuple[float, str, dict[str, float]]]:
        """Yield fields of messages in order of receipt."""
        for row in self._kept.rows(self.start, self.end, self._fault):
            if row.topic in wanted:
                yield row.time, row.topic, row.values

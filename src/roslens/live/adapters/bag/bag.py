"""A recording: its metadata, its traffic as tallies, the fields of its messages, and its graph."""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from roslens.live.adapters.bag.block import Block, Ints, Part
from roslens.live.adapters.bag.channel import Channel
from roslens.live.adapters.bag.damage import DamageError, FailureLog
from roslens.live.adapters.bag.field_reader import FieldReader, MessageReader
from roslens.live.adapters.bag.graphs.recorded_graph import graph_of, with_recorded
from roslens.live.adapters.bag.stamp import begins_with_header
from roslens.live.adapters.bag.steps import Lane, Steps, joined
from roslens.live.adapters.bag.topic import BagTopic
from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.model.graph import Graph
from roslens.model.traffic.tally import Tally

Reading: TypeAlias = Callable[[], "list[Block]"]

_SECOND = 1_000_000_000
_BATCH = 1 << 18
_SHORTEST_STEP_S = 1e-6
_SHOWN = 20


class Decoded(NamedTuple):
    """A message with its fields as attributes; ``time`` in nanoseconds, ``publisher`` empty where unknown."""

    time: int
    topic: str
    publisher: str
    message: Any


class Bag:
    """A recording of one or more files.

    Nothing is read before it is asked for, and what was read is not kept: memory holds the messages' times, sizes and
    stamps (8 bytes each) of as many chunks as overlap in time, and at least of a quarter of a million messages.

    Attributes:
        generation: ``ros1`` or ``ros2``.
        topics: by name.
        messages: in all, as far as the recording tells.
        start: seconds of the first message, 0 without any.
        end: seconds of the last message, 0 without any.
        graphs: those that were recorded, by the second of receipt; most recordings have none.
        exact_sizes: false where `Tally.bytes` comes from the distances of messages in a chunk, which count a definition
            that was written between two of them.
    """

    def __init__(
        self, parts: Sequence[Part], failures: FailureLog, graphs: Sequence[tuple[float, Graph]] = (),
        kept: Sequence[object] = (),
    ) -> None:  # fmt: skip
        """Take the parts of a recording; what they need is ``kept`` as long as it may be read."""
        self._parts = parts
        self._kept = kept
        self.graphs = tuple(graphs)
        self._failures = failures
        self.generation = parts[0].generation
        filled = [part for part in parts if part.start <= part.end]
        self._start = max(min((part.start for part in filled), default=0), 0)
        self._end = max((part.end for part in filled), default=0)
        self.start, self.end = self._start / _SECOND, self._end / _SECOND
        self.messages = sum(count for part in parts for count in part.counts.values())
        self.exact_sizes = all(part.exact_sizes for part in parts)
        self.topics = _topics(parts)

    @property
    def failures(self) -> tuple[Failure, ...]:
        """What could not be read so far: reading on may find more."""
        together = FailureLog()
        together.extend(self._failures)
        for part in self._parts:
            together.extend(part.failures)
        return together.all()

    def tallies(self, step: float = 1.0, stamps: Collection[str] = ()) -> Iterator[tuple[float, list[Tally]]]:
        """Yield the traffic of all topics step by step: the end of the step, and a tally per topic and publisher.

        A step in which nothing came has tallies of 0 messages. Where nothing at all came for more than an hour of
        steps, as after a jump of the clock, the rest of the silence is left out and reported in `failures`.

        Args:
            step: seconds.
            stamps: topics of which also the age is reported; their chunks are unpacked.

        Raises:
            UsageError: the step is no time, or a topic is not there.
        """
        if not (math.isfinite(step) and step >= _SHORTEST_STEP_S):
            raise UsageError(f"a step of {step} s", expected=f"at least {_SHORTEST_STEP_S} s")
        return self._tallies(step, self._numbers(stamps, stamped=True))

    def _tallies(self, step: float, stamped: list[set[int]]) -> Iterator[tuple[float, list[Tally]]]:
        lanes = [
            {number: Lane(channel.topic, channel.publisher) for number, channel in part.channels.items()}
            for part in self._parts
        ]
        known = {lane for each in lanes for lane in each.values()}
        begins = any(part.start <= part.end for part in self._parts)
        steps = Steps(self._start, round(step * _SECOND), known)
        due = _BATCH
        for since, index, blocks in self._blocks(stamped):
            if not begins:
                begins, steps = True, Steps(max(since, 0), round(step * _SECOND), known)
            if steps.pending >= due:
                yield from steps.until(since)
                due = max(_BATCH, 2 * steps.pending)
            for block in blocks():
                steps.add(lanes[index][block.channel], block.times, block.sizes, block.stamps)
        if self.messages or steps.pending:
            yield from steps.rest(self._end)
        self._tell_of(steps)

    def _blocks(self, stamped: Sequence[Collection[int]]) -> Iterator[tuple[int, int, Reading]]:
        """Yield what all files hold by time: since when, number of the file, and what reads it."""
        streams = [_numbered(index, part, stamped[index]) for index, part in enumerate(self._parts)]
        return heapq.merge(*streams, key=lambda entry: entry[:2])

    def times(self, topic: str) -> Ints:
        """Return when messages of a topic were received: nanoseconds, in order.

        Raises:
            UsageError: the topic is not there.
        """
        numbers = self._numbers([topic])
        pieces = [np.zeros(0, np.int64)]
        for _, index, blocks in self._blocks([()] * len(self._parts)):
            pieces += [block.times for block in blocks() if block.channel in numbers[index]]
        return np.sort(np.concatenate(pieces))

    def arrivals(self) -> dict[tuple[str, str], Ints]:
        """Return when messages were received, by topic and publisher: nanoseconds, in order."""
        pieces: dict[tuple[str, str], list[Ints]] = {}
        for _, index, blocks in self._blocks([()] * len(self._parts)):
            for block in blocks():
                channel = self._parts[index].channels[block.channel]
                pieces.setdefault((channel.topic, channel.publisher), []).append(block.times)
        return {key: np.sort(np.concatenate(times)) for key, times in sorted(pieces.items())}

    def traffic(self, stamps: Collection[str] = ()) -> dict[Lane, tuple[Ints, Ints, Ints | None]]:
        """Return times of receipt, sizes and stamps of all messages by topic and publisher; nanoseconds and bytes.

        Args:
            stamps: topics of which also the stamps are read; their chunks are unpacked.

        Raises:
            UsageError: a topic is not there.
        """
        pieces: dict[Lane, list[Block]] = {
            Lane(one.topic, one.publisher): [] for part in self._parts for one in part.channels.values()
        }
        for _, index, blocks in self._blocks(self._numbers(stamps, stamped=True)):
            for block in blocks():
                channel = self._parts[index].channels[block.channel]
                pieces[Lane(channel.topic, channel.publisher)].append(block)
        return {lane: joined([(one.times, one.sizes, one.stamps) for one in pieces[lane]]) for lane in sorted(pieces)}

    def fields(self, wanted: Mapping[str, Collection[str]]) -> Iterator[tuple[float, str, dict[str, float]]]:
        """Yield fields of messages in order of receipt: seconds, topic, and values by path.

        What is not in a message or is no number is not in the values. What cannot be decoded is left out and reported
        in `failures`.

        Args:
            wanted: paths such as ``pose.position.x`` or ``ranges[0]`` by topic.

        Raises:
            UsageError: a topic is not there.
        """
        return self._fields(wanted, self._numbers(wanted))

    def _fields(
        self, wanted: Mapping[str, Collection[str]], numbers: list[set[int]]
    ) -> Iterator[tuple[float, str, dict[str, float]]]:
        readers = [self._readers(part, chosen, wanted) for part, chosen in zip(self._parts, numbers, strict=True)]
        streams = [
            ((load.since, index, load.read) for load in part.loads(readers[index].keys()))
            for index, part in enumerate(self._parts)
            if readers[index]
        ]
        waiting: list[tuple[int, int, str, dict[str, float]]] = []
        order = 0
        for since, index, read in heapq.merge(*streams, key=lambda entry: entry[:2]):
            while waiting and waiting[0][0] < since:
                time, _, topic, values = heapq.heappop(waiting)
                yield time / _SECOND, topic, values
            part = self._parts[index]
            for message in read():
                try:
                    values = readers[index][message.channel].read(message)
                except DamageError as damage:
                    topic = part.channels[message.channel].topic
                    part.failures.add(part.path, f'"{topic}" has {damage}', advice="The message is left out.")
                    continue
                order += 1
                heapq.heappush(waiting, (message.time, order, part.channels[message.channel].topic, values))
        while waiting:
            time, _, topic, values = heapq.heappop(waiting)
            yield time / _SECOND, topic, values
        self._tell_absent(readers)

    def _readers(
        self, part: Part, chosen: Collection[int], wanted: Mapping[str, Collection[str]]
    ) -> dict[int, FieldReader]:
        readers = {}
        for number in sorted(chosen):
            channel = part.channels[number]
            try:
                readers[number] = FieldReader(channel, wanted[channel.topic])
            except DamageError as damage:
                part.failures.add(part.path, f'"{channel.topic}" has {damage}', advice="Its fields are left out.")
        return readers

    def _tell_absent(self, readers: list[dict[int, FieldReader]]) -> None:
        for part, by_number in zip(self._parts, readers, strict=True):
            for number, reader in by_number.items():
                for path in sorted(reader.absent):
                    channel = part.channels[number]
                    what = f'"{channel.topic}" has messages of {channel.type} in which "{path}" is not a number'
                    part.failures.add(part.path, what, advice="Check the path against the type.")

    def decoded(self, types: Collection[str]) -> Iterator[Decoded]:
        """Yield all messages of some types in order of receipt.

        What cannot be decoded is left out and reported in `failures`.
        """
        readers = [self._whole_readers(part, types) for part in self._parts]
        streams = [
            ((load.since, index, load.read) for load in part.loads(readers[index].keys()))
            for index, part in enumerate(self._parts)
            if readers[index]
        ]
        waiting: list[tuple[int, int, Decoded]] = []
        order = 0
        for since, index, read in heapq.merge(*streams, key=lambda entry: entry[:2]):
            while waiting and waiting[0][0] < since:
                yield heapq.heappop(waiting)[2]
            part = self._parts[index]
            for raw in read():
                channel = part.channels[raw.channel]
                try:
                    message = readers[index][raw.channel].read(raw)
                except DamageError as damage:
                    part.failures.add(part.path, f'"{channel.topic}" has {damage}', advice="The message is left out.")
                    continue
                order += 1
                one = Decoded(raw.time, channel.topic, channel.publisher, message)
                heapq.heappush(waiting, (raw.time, order, one))
        while waiting:
            yield heapq.heappop(waiting)[2]

    def _whole_readers(self, part: Part, types: Collection[str]) -> dict[int, MessageReader]:
        readers = {}
        for number, channel in part.channels.items():
            if channel.type in types:
                try:
                    readers[number] = MessageReader(channel)
                except DamageError as damage:
                    part.failures.add(part.path, f'"{channel.topic}" has {damage}', advice="It is left out.")
        return readers

    def graph(self) -> Graph:
        """Return topics with their types and, in ROS 1 or where the graph was recorded, who published them.

        Of several recorded graphs it is the last.
        """
        channels = graph_of(self.generation, (channel for part in self._parts for channel in part.channels.values()))
        return with_recorded(self.graphs[-1][1], channels) if self.graphs else channels

    def _numbers(self, topics: Collection[str], *, stamped: bool = False) -> list[set[int]]:
        """Return the channels of topics in each file."""
        known = {topic.name for topic in self.topics}
        for name in topics:
            if name not in known:
                raise UsageError(
                    f'topic "{name}"', where=str(self._parts[0].path), expected=_some(known), advice="Check the name."
                )
        numbers = [
            {number for number, channel in part.channels.items() if channel.topic in topics} for part in self._parts
        ]
        if not stamped:
            return numbers
        for part, chosen in zip(self._parts, numbers, strict=True):
            for number in sorted(chosen):
                channel = part.channels[number]
                if not begins_with_header(channel):
                    what = f'"{channel.topic}" has messages of {channel.type or "no type"}, which begin with no header'
                    part.failures.add(part.path, what, advice="Its age is left out.")
                    chosen.discard(number)
        return numbers

    def _tell_of(self, steps: Steps) -> None:
        path = self._parts[0].path
        if steps.late:
            what = f"{steps.late:,} messages with times that the index excludes"
            self._failures.add(path, what, advice="They are left out. Reindex the recording.")
        if steps.counted + steps.late != self.messages:
            what = f"{steps.counted + steps.late:,} messages, but the recording states {self.messages:,}"
            self._failures.add(path, what, advice="The readable part is counted.")
        for begin, end in steps.jumps:
            what = f"nothing at all between {begin / _SECOND:.3f} and {end / _SECOND:.3f} s"
            self._failures.add(path, what, advice="The clock probably jumped. The silence is shortened.")


def _numbered(index: int, part: Part, stamped: Collection[int]) -> Iterator[tuple[int, int, Reading]]:
    for portion in part.portions(stamped):
        yield portion.since, index, portion.read


def _topics(parts: Sequence[Part]) -> tuple[BagTopic, ...]:
    """Merge the metadata of all files on each topic with each of its types."""
    found: dict[tuple[str, str, str], list[tuple[Channel, int]]] = {}
    for part in parts:
        for number, channel in part.channels.items():
            key = (channel.topic, channel.type, channel.hash)
            found.setdefault(key, []).append((channel, part.counts.get(number, 0)))
    topics = []
    for (name, kind, digest), entries in sorted(found.items()):
        publishers = sorted({channel.publisher for channel, _ in entries if channel.publisher})
        qos = next((channel.qos for channel, _ in entries if channel.qos), "")
        stamped = all(begins_with_header(channel) for channel, _ in entries)
        count = sum(count for _, count in entries)
        topics.append(BagTopic(name, kind, count, digest, tuple(publishers), qos, stamped))
    return tuple(topics)


def _some(names: Collection[str]) -> str:
    """Return names for a message: all if they are few."""
    shown = sorted(names)[:_SHOWN]
    more = len(names) - len(shown)
    return "one of " + ", ".join(shown) + (f" and {more} more" if more else "") if shown else "a recording with topics"

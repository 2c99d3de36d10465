"""What a recording says: its topics with their time lines, who was there, and what nodes logged."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.compare.why.time_line import TimeLine
from roslens.model.configuration import Configuration
from roslens.model.graph import Graph, Role
from roslens.model.transforms.probe import Probed
from roslens.model.transforms.tree import TransformTree

_MOST_NODES = 200


class RecordedTopic(msgspec.Struct, frozen=True):
    """A topic of a recording; ``line`` holds its times on the clock of the recording."""

    type: str
    line: TimeLine


class LogLine(msgspec.Struct, frozen=True, order=True):
    """What a node logged; ``time`` in seconds, ``level`` in words."""

    time: float
    node: str
    level: str
    text: str


class Gone(msgspec.Struct, frozen=True, order=True):
    """A node that a recorded graph no longer has, from ``time`` on."""

    time: float
    node: str


class RecordedTransforms(msgspec.Struct, frozen=True):
    """What a recording says on /tf and /tf_static.

    Attributes:
        tree: the frames.
        topics: on which transforms were recorded.
        publishers: nodes that published on them, as far as known.
        probed: what look-ups between two frames came to; None where none were asked for.
    """

    tree: TransformTree
    topics: tuple[str, ...] = ()
    publishers: tuple[str, ...] = ()
    probed: Probed | None = None


class Recorded(msgspec.Struct, frozen=True):
    """What a recording says.

    Attributes:
        title: its file.
        start: seconds of the first message; reports count from here.
        end: seconds of the last message.
        topics: by name.
        graph: nodes and ends as far as it has them.
        logs: warnings and errors of nodes, by time.
        gone: nodes that ended, by time.
        transforms: what it says of frames; None where that was not read.
        failures: what could not be read, a sentence each.
        path: as the user gave it, for commands.
    """

    title: str
    start: float
    end: float
    topics: dict[str, RecordedTopic]
    graph: Graph
    logs: tuple[LogLine, ...] = ()
    gone: tuple[Gone, ...] = ()
    transforms: RecordedTransforms | None = None
    failures: tuple[str, ...] = ()
    path: str = ""

    def clock(self, time: float) -> str:
        """Return a time as seconds since the start."""
        return f"{time - self.start:.2f} s"


def inputs_of(topic: str, graph: Graph, configuration: Configuration | None) -> Iterator[tuple[str, str]]:
    """Yield the topics that the publishers of a topic subscribe to, each with the node."""
    ends = list(graph.endpoints)
    if configuration is not None:
        ends += configuration.graph(implicit=False).endpoints
    makers = {one.node for one in ends if one.role is Role.PUBLISHER and one.name == topic and one.node}
    found = {(one.name, one.node) for one in ends if one.role is Role.SUBSCRIPTION and one.node in makers}
    yield from sorted(one for one in found if one[0] != topic)


def upstream_of(topic: str, graph: Graph, configuration: Configuration | None) -> list[tuple[str, str]]:
    """Return all topics that a topic is made of, directly or not, the nearest first, each with the node between."""
    seen: dict[str, str] = {}
    waiting = [topic]
    while waiting and len(seen) < _MOST_NODES:
        for name, node in inputs_of(waiting.pop(0), graph, configuration):
            if name not in seen and name != topic:
                seen[name] = node
                waiting.append(name)
    return [*seen.items()]

"""What happened between two graphs: nodes and topics that appeared, vanished, were started again."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator

from roslens.model.acting.process_end import UNKNOWN, end_words
from roslens.model.graph import Change, Event, Graph, Node

FLAPS = 3
FLAP_S = 60.0
MOST_GONE = 1000
"""So many nodes that are gone are remembered: tools have another name each time that they run."""


class Changes:
    """Remembers which nodes were there before, so that one that comes back is known as started again."""

    def __init__(self) -> None:
        self._before: Graph | None = None
        self._gone: dict[str, float] = {}
        self._restarts: dict[str, deque[float]] = {}

    def to(self, graph: Graph, time: float, with_process: tuple[int, str] = (0, "")) -> list[Event]:
        """Return what happened since the graph given last; nothing happened before the first.

        ``with_process`` is the id of a process that has just ended and how it did: with it its nodes did.
        """
        before, self._before = self._before, graph
        if before is None:
            return []
        return [*self._nodes(before, graph, time, with_process), *_topics(before, graph, time)]

    def _nodes(
        self, before: Graph, after: Graph, time: float, with_process: tuple[int, str]
    ) -> Iterator[Event]:  # fmt: skip
        old = {node.name: node for node in before.nodes}
        new = {node.name: node for node in after.nodes}
        for name in sorted(old.keys() - new.keys()):
            self._gone.pop(name, None)
            self._gone[name] = time
            yield _vanished(old[name], time, with_process)
        for name in list(self._gone)[: max(len(self._gone) - MOST_GONE, 0)]:
            del self._gone[name]
            self._restarts.pop(name, None)
        for name in sorted(new.keys()):
            node = new[name]
            if name not in old:
                if name not in self._gone:
                    yield Event(time, Change.APPEARED, f"node:{name}", _place(node.pid, node.host))
                    continue
                away = time - self._gone.pop(name)
                yield from self._restarted(name, time, f"after {away:.1f} s; {_place(node.pid, node.host)}")
            elif node.pid and old[name].pid and node.pid != old[name].pid:
                yield from self._restarted(name, time, f"process {old[name].pid} is now {node.pid}")
            elif node.lifecycle != old[name].lifecycle and old[name].lifecycle:
                detail = f"{old[name].lifecycle} is now {node.lifecycle or 'unknown'}"
                yield Event(time, Change.CHANGED, f"node:{name}", detail)

    def _restarted(self, name: str, time: float, detail: str) -> Iterator[Event]:
        times = self._restarts.setdefault(name, deque(maxlen=FLAPS))
        times.append(time)
        yield Event(time, Change.RESTARTED, f"node:{name}", detail)
        if len(times) == FLAPS and time - times[0] <= FLAP_S:
            yield Event(time, Change.FLAPPING, f"node:{name}", f"{FLAPS} starts in {time - times[0]:.0f} s")


def _vanished(node: Node, time: float, with_process: tuple[int, str]) -> Event:
    ended = with_process[1] if node.pid and node.pid == with_process[0] else ""
    how = f", {end_words(ended)}" if ended and ended != UNKNOWN else ""
    return Event(time, Change.VANISHED, f"node:{node.name}", _place(node.pid, node.host) + how, ended)


def _place(pid: int, host: str) -> str:
    return " on ".join(part for part in (f"process {pid}" if pid else "", host) if part)


def _topics(before: Graph, after: Graph, time: float) -> Iterator[Event]:
    old, new = ({end.name for end in graph.endpoints if end.role.value in _OF_TOPICS} for graph in (before, after))
    for name in sorted(old - new):
        yield Event(time, Change.VANISHED, f"topic:{name}")
    for name in sorted(new - old):
        yield Event(time, Change.APPEARED, f"topic:{name}")


_OF_TOPICS = ("publisher", "subscription")

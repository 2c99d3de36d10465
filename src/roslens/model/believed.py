"""Which records of a frame can be true: whoever sent it, what cannot is left out and named, and the rest is taken.

Who knows the key may still be broken or hostile. Tallies are not looked at here: there are many of them, and the
monitor asks of each whether it is plausible before it counts it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from typing import TypeVar

import msgspec

from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.graph import Endpoint, Event, Graph, Node, Process
from roslens.model.qos import Qos
from roslens.model.traffic.sample import Sample

MOST_CHARACTERS = 65_536
"""Of a name or a text: a longer one is not a name of ROS, and too long to be read."""
MOST_COUNT = (1 << 63) - 1
"""Numbers of records are kept as eight bytes with a sign."""
MOST_PID = 1 << 22
"""The highest process id that Linux gives."""
_QUOTED = 60
_PROCESS = re.compile(r".{0,255}/[0-9]{1,7}", re.DOTALL)
"""Host and process id."""
_HEX = re.compile(r"[0-9a-f]{0,64}")

_Record = TypeVar("_Record")


class Refused:
    """Gathers what was left out of one frame, of which the first is quoted."""

    def __init__(self) -> None:
        self._first = ("", "")
        self._count = 0

    def kept(self, kind: str, records: Sequence[_Record], wrong: Callable[[_Record], str]) -> Sequence[_Record]:
        """Return the records in which nothing is ``wrong``; the same where all are."""
        found = [reason for reason in map(wrong, records) if reason]
        if not found:
            return records
        self.add(kind, found)
        return [record for record in records if not wrong(record)]

    def add(self, kind: str, reasons: Sequence[str]) -> None:
        """Note why records of a kind were left out."""
        self._first = self._first if self._count else (kind, reasons[0])
        self._count += len(reasons)

    def failures(self, sender: str) -> list[Failure]:
        """Return one failure for all that was left out, none for nothing."""
        if not self._count:
            return []
        kind, reason = self._first
        what = f"{quoted(sender)} sent {kind} with {reason}"
        advice = "The record is left out, the rest is taken. Look at what runs there; is it of another version?"
        return [Failure("link", what, "records that can be true", advice, partial=True)]


def believed_events(events: list[Event], refused: Refused) -> list[Event]:
    """Return events of a named entity, at a time."""
    return list(refused.kept("an event", events, _wrong_event))


def believed_samples(samples: list[Sample], refused: Refused) -> list[Sample]:
    """Return samples of a named entity, at a time; their values are for the monitor to judge."""
    return list(refused.kept("a sample", samples, _wrong_sample))


def believed_graph(graph: Graph, refused: Refused) -> Graph:
    """Return a graph of things that have names, in processes that Linux can have."""
    nodes = refused.kept("a node", graph.nodes, _wrong_node)
    endpoints = refused.kept("an endpoint", graph.endpoints, _wrong_endpoint)
    processes = refused.kept("a process", graph.processes, _wrong_process)
    hosts = refused.kept("a host", graph.hosts, _wrong_name)
    hosts_of = refused.kept("identities", tuple(graph.identities.items()), _wrong_identities)
    if (nodes, endpoints, processes, hosts) == (graph.nodes, graph.endpoints, graph.processes, graph.hosts) and len(
        hosts_of
    ) == len(graph.identities):
        return graph
    return msgspec.structs.replace(
        graph, nodes=tuple(nodes), endpoints=tuple(endpoints), processes=tuple(processes), hosts=tuple(hosts),
        identities=dict(hosts_of),
    )  # fmt: skip


def quoted(text: str) -> str:
    """Return a text as it is quoted in a message: printable, and not longer than a line."""
    return repr(text if len(text) <= _QUOTED else f"{text[:_QUOTED]}…")


def _wrong_event(event: Event) -> str:
    try:
        entity = EntityId.parse(event.entity)
    except ValueError:
        return f"the entity {quoted(event.entity)}"
    return _wrong_entity(entity) or _not_finite("time", event.time) or _too_long(event.detail, event.ended, *event.said)


def _wrong_sample(sample: Sample) -> str:
    return _wrong_entity(sample.entity) or _not_finite("time", sample.time) or _too_long(*sample.values)


def _wrong_entity(entity: EntityId) -> str:
    if entity.kind is EntityKind.PROCESS and not _PROCESS.fullmatch(entity.name):
        return f"the process {quoted(entity.name)}"
    return _wrong_name(entity.name)


def _wrong_node(node: Node) -> str:
    return (
        _wrong_name(node.name)
        or _wrong_pid(node.pid)
        or _too_long(
            node.host,
            node.lifecycle,
            *node.proofs,
            *(text for one in node.instances for text in (one.host, one.context)),
        )
    )


def _wrong_endpoint(end: Endpoint) -> str:
    wrong = _wrong_name(end.node) or _wrong_name(end.name) or _too_long(end.type, end.hash, *(end.apart or ()))
    if not wrong and not _HEX.fullmatch(end.gid):
        return f"the identifier {quoted(end.gid)}"
    return wrong or (_wrong_qos(end.qos) if end.qos is not None else "")


def _wrong_identities(one: tuple[str, tuple[str, ...]]) -> str:
    host, digits = one
    return _too_long(host) or next((f"the identity {quoted(each)}" for each in digits if not _HEX.fullmatch(each)), "")


def _wrong_qos(qos: Qos) -> str:
    if not 0 <= qos.depth <= MOST_COUNT:
        return f"the depth {qos.depth}"
    for seconds in (qos.deadline_s, qos.lifespan_s, qos.lease_s):
        if wrong := _not_finite("quality of service, in seconds:", seconds):
            return wrong
    return _too_long(qos.reliability, qos.durability, qos.history, qos.liveliness)


def _wrong_process(process: Process) -> str:
    wrong = _wrong_pid(process.pid) or _wrong_pid(process.inner) or _not_finite("start", process.started)
    return wrong or _too_long(process.host, process.command, *process.nodes)


def _wrong_name(name: str) -> str:
    return _too_long(name) if name else "an empty name"


def _wrong_pid(pid: int) -> str:
    return "" if 0 <= pid <= MOST_PID else f"the process id {pid}"


def _not_finite(what: str, value: float) -> str:
    return "" if math.isfinite(value) else f"the {what} {value}"


def _too_long(*texts: str) -> str:
    longest = max(map(len, texts), default=0)
    return f"a text of {longest:,} characters" if longest > MOST_CHARACTERS else ""

"""How the processes of nodes that are gone ended: by which signal, with which other nodes, and their last words."""

from __future__ import annotations

from typing import NamedTuple

from roslens.live.window.newest import MOST_GONE, keep_newest
from roslens.model.acting.process_end import end_words, in_order
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Change, Event, Graph
from roslens.model.words.command_name import command_name

_SHOWN = 3
_LONGEST_LINE = 200


class _Fate(NamedTuple):
    how: str
    command: str
    said: tuple[str, ...]


class ProcessFates:
    """Joins the ends of processes with the nodes that were last in them, in whatever order both are reported."""

    def __init__(self) -> None:
        """Know of no process."""
        self._process_of: dict[str, str] = {}
        self._fates: dict[str, _Fate] = {}

    def take_graph(self, graph: Graph) -> None:
        """Take who is where; of nodes that are gone it is kept where they were."""
        for node in graph.nodes:
            if node.host and node.pid:
                self._process_of.pop(node.name, None)
                self._process_of[node.name] = f"{node.host}/{node.pid}"
        keep_newest(self._process_of, len(graph.nodes) + MOST_GONE)

    def happened(self, event: Event, entity: EntityId) -> bool:
        """Take an event about an entity; return whether it tells how a process ended."""
        if event.change is not Change.VANISHED:
            return False
        if entity.kind is EntityKind.PROCESS:
            process, command = entity.name, event.detail
        elif entity.kind is EntityKind.NODE and event.ended:
            process, command = self._process_of.get(entity.name, ""), ""
        else:
            return False
        if process:
            before = self._fates.pop(process, _Fate("", "", ()))
            how = before.how if in_order(before.how) is not None else event.ended
            self._fates[process] = _Fate(how, command or before.command, event.said or before.said)
            keep_newest(self._fates)
        return bool(process)

    def of(self, node: str) -> str:
        """Return how the process of a node that is gone ended, in words; empty where that is not known."""
        process = self._process_of.get(node, "")
        fate = self._fates.get(process)
        if fate is None:
            return ""
        host, _, pid = process.rpartition("/")
        program = command_name(fate.command)
        named = f"process {pid}{f' ({program})' if program else ''} on {host}"
        others = sorted(name for name, where in self._process_of.items() if where == process and name != node)
        more = f" and {len(others) - _SHOWN} more" if len(others) > _SHOWN else ""
        beside = f", and with it {', '.join(others[:_SHOWN])}{more}" if others else ""
        log = " | ".join(_printable(line) for line in fate.said[-_SHOWN:])
        return f"its {named} {_ended(fate.how)}{beside}{f'; its log ends with: {log}' if log else ''}"


def _ended(how: str) -> str:
    orderly = in_order(how)
    if orderly is None:
        return "ended, and nobody saw how"
    return f"{'ended in order' if orderly else 'crashed'} ({end_words(how)})"


def _printable(line: str) -> str:
    return "".join(one if one.isprintable() else "?" for one in line[:_LONGEST_LINE])

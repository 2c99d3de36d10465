"""Nodes that bear one name, and how often each is on a topic."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.model.graph import Endpoint, Graph, Instance, Node

_CONTEXT = 24


def proven_copies(node: Node) -> tuple[str, ...]:
    """Return where the nodes of a name run that are known to live; nothing where that are not several.

    A participant without a known process may be that of one that crashed: a middleware misses it some 20 s later.
    """
    living = [one for one in node.instances if one.pid]
    return tuple(map(place_words, living)) if len(living) > 1 else ()


def place_words(one: Instance) -> str:
    """Return where an instance runs, in words."""
    process = f"process {one.pid}" if one.pid else f"participant {one.context}" if one.context else "a process"
    return f"{process} on {one.host}" if one.host else process


class Copies:
    """How many of the nodes of one name have an endpoint on each topic."""

    def __init__(self, graph: Graph) -> None:
        self._living = {
            node.name: {one.context for one in node.instances if one.pid and one.context}
            for node in graph.nodes
            if node.instances
        }

    def __bool__(self) -> bool:
        """Whether any name is borne by several nodes."""
        return bool(self._living)

    def surplus(self, ends: Iterable[Endpoint]) -> int:
        """Return how many more nodes than names have these endpoints, all of one topic and role."""
        contexts: dict[str, set[str]] = {}
        for end in ends:
            if end.gid[:_CONTEXT] in self._living.get(end.node, ()):
                contexts.setdefault(end.node, set()).add(end.gid[:_CONTEXT])
        return sum(len(found) - 1 for found in contexts.values())

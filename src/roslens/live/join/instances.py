"""The instances of a node: a name that several processes bear is several nodes.

By the identifiers of its endpoints a node has as many contexts as there are participants that hold a node of that name
(DDSI-RTPS: the first 12 bytes of an identifier are its participant's, and the first byte of these is 01 for every known
vendor). Identifiers of another form show nothing.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container, Iterable

from roslens.model.graph import Endpoint, Graph, Instance, Node, Role

_RTPS = "01"
_CONTEXT = 24


def contexts_by_node(endpoints: Iterable[Endpoint], over: Container[str]) -> dict[str, list[str]]:
    """Return the contexts of each node, sorted, without those that are ``over``."""
    found: dict[str, set[str]] = {}
    for end in endpoints:
        if (context := context_of(end)) and context not in over:
            found.setdefault(end.node, set()).add(context)
    return {node: sorted(contexts) for node, contexts in found.items()}


def context_of(end: Endpoint) -> str:
    """Return the participant that an endpoint is of; empty where its identifier does not show it."""
    return end.gid[:_CONTEXT] if end.gid.startswith(_RTPS) and len(end.gid) >= _CONTEXT else ""


def instances_of(node: Node, contexts: Iterable[str], place: Callable[[str], tuple[str, int]]) -> tuple[Instance, ...]:
    """Return the instances of a node where there are several; ``place`` tells host and process of a context."""
    found = tuple(Instance(*place(context), context) for context in contexts)
    return found if len(found) > 1 else node.instances


def several_publishers(graph: Graph) -> frozenset[tuple[str, str]]:
    """Return node and topic of publishers that are there more than once under one name, in one process or several."""
    ends = Counter((end.node, end.name) for end in graph.endpoints if end.role is Role.PUBLISHER)
    return frozenset(pair for pair, times in ends.items() if times > 1)

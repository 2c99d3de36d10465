"""The graph of a running system, by the live half of roslens: its observer in a process of its own."""

from __future__ import annotations

import os
import selectors
import subprocess
import time
from collections.abc import Sequence

import msgspec

from roslens.live.adapters.child import clean_environment
from roslens.model.graph import Graph
from roslens.model.wire import FrameReader

QUIET_S = 3.0
"""What a graph is asked to stay as it is, in seconds, where nobody knows better."""
PATIENCE_S, OF_EACH_S = 30.0, 5.0
"""So long nodes may take to come, together and each."""


class NotThereError(Exception):
    """The nodes did not come; the text says who did."""


def observe(
    command: Sequence[str], environment: dict[str, str], nodes: int, telling: int = 0, quiet_s: float = QUIET_S
) -> Graph:
    """Return the graph when all nodes are there and nothing changes any more.

    Args:
        command: that observes.
        environment: of it.
        nodes: how many are to come.
        telling: how many of them tell their parameters (ROS 2).
        quiet_s: a graph that stays as it is for so long is the whole of it, in seconds.

    Raises:
        NotThereError: they did not come.
    """
    process = subprocess.Popen(
        command, env=clean_environment(environment), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )  # fmt: skip
    assert process.stdout is not None
    reader, graph, changed = FrameReader(), None, time.monotonic()
    longest = PATIENCE_S + OF_EACH_S * nodes
    end = changed + longest
    try:
        with selectors.DefaultSelector() as ready:
            ready.register(process.stdout, selectors.EVENT_READ)
            while time.monotonic() < end:
                if ready.select(0.2):
                    piece = os.read(process.stdout.fileno(), 1 << 16)
                    if not piece:
                        raise NotThereError(f"the observer ended with {process.wait()}")
                    for frame in reader.feed(piece):
                        if frame.graph is not None and _shape(frame.graph) != _shape(graph):
                            changed = time.monotonic()
                        graph = frame.graph or graph
                if graph and _whole(graph, nodes, telling) and time.monotonic() - changed >= quiet_s:
                    return graph
        there = ", ".join(node.name for node in graph.nodes) if graph else "none"
        raise NotThereError(
            f"expected {nodes} nodes within {longest:.0f} s, found {there}; "
            f"parameters of {', '.join(graph.parameters) if graph else 'none'}"
        )
    finally:
        process.terminate()
        process.wait(10)
        process.stdout.close()


def _whole(graph: Graph, nodes: int, telling: int) -> bool:
    told = sum(1 for node in graph.nodes if node.name in graph.parameters)
    return len(graph.nodes) >= nodes and told >= telling


def _shape(graph: Graph | None) -> object:
    if graph is None:
        return None
    ends = {(one.node, one.role, one.name, one.type) for one in graph.endpoints}
    return {one.name for one in graph.nodes}, ends, {name: set(of) for name, of in graph.parameters.items()}


def kept(graph: Graph) -> Graph:
    """Return a graph without what is another one each time: processes, hosts, identifiers."""
    return Graph(
        graph.generation,
        tuple(type(node)(node.name, lifecycle=node.lifecycle) for node in graph.nodes),
        tuple(sorted({msgspec.structs.replace(one, gid="") for one in graph.endpoints}, key=_order)),
        parameters={node: dict(sorted(values.items())) for node, values in sorted(graph.parameters.items())},
    )


def _order(one: object) -> str:
    return repr(one)

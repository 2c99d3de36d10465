"""What runs, what was recorded, and what is expected, as sides."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.watch.monitor_address import fetched
from roslens.compare.conformance.observed import recorded_side, running_side
from roslens.compare.conformance.side import Side, SideKind
from roslens.model.errors import UsageError
from roslens.model.graph import Graph

if TYPE_CHECKING:
    from roslens.live.join.session import Session

QUIET_S = 3.0
"""A graph that stays as it is for so long is taken for the whole of it, in seconds."""
LONGEST_S = 30.0
_PATIENCE_S = 10.0
GRAPH = "graph.json"


def live_side(options: argparse.Namespace) -> Side:
    """Observe the running system until nothing changes any more, for at most the time of ``--for``.

    Raises:
        UsageError: no ROS is found, or nothing runs.
    """
    import contextlib

    from roslens.cli.terminal.until_stopped import when_stopped
    from roslens.cli.watch.stretch import Stretch
    from roslens.cli.watch.watch_live import length_of, sources_of
    from roslens.judge.reference.expectation import Reference
    from roslens.live.join.session import Session, run

    length = length_of(options.length, "--for") if options.length else LONGEST_S
    session = Session(Reference("nothing"), start=time.time())
    with contextlib.ExitStack() as stack:
        stretch = Stretch(session, length, when_stopped(stack))
        still = _Still(session, exact=bool(options.length))
        if not options.quiet:
            print(f"roslens: looking at what runs, for {length:g} s at most", file=sys.stderr)
        run(
            session, sources_of(options), wall=time.time,
            stopped=lambda _: stretch.over() or still.whole(time.monotonic()), report=lambda _: None,
        )  # fmt: skip
    graph = session.graph()
    for failure in session.monitor.failures:
        print(f"roslens: {failure}", file=sys.stderr)
    if not graph.nodes:
        raise UsageError(
            f"no node runs here that could be seen in {stretch.passed:.0f} s", expected="a ROS system",
            advice="Set $ROS_DOMAIN_ID or $ROS_MASTER_URI as the robot has it, or give --for a longer time",
        )  # fmt: skip
    return running_side(graph, f"what runs on {_hosts(graph)}")


class _Still:
    """Detects when a graph has nodes, all available parameters were reported, and nothing changed for a while."""

    def __init__(self, session: Session, *, exact: bool) -> None:
        self._session = session
        self._exact = exact
        self._shape: object = None
        self._since = 0.0

    def whole(self, now: float) -> bool:
        if self._exact or not self._session.begun:
            return False
        graph = self._session.graph()
        shape = (
            len(graph.nodes), len(graph.endpoints), sum(map(len, graph.parameters.values())), frozenset(graph.nodes)
        )  # fmt: skip
        if shape != self._shape:
            self._shape, self._since = shape, now
        reported = all(one.name in graph.parameters for one in graph.nodes)
        return bool(graph.nodes) and now - self._since >= (QUIET_S if reported else _PATIENCE_S)


def _hosts(graph: Graph) -> str:
    import platform

    return ", ".join(graph.hosts[:3]) or platform.node()


def monitor_side(address: str) -> Side:
    """Ask a monitor that serves its page for the graph that it sees.

    Raises:
        UsageError: there is no answer, or not from a monitor of this version.
    """
    content = fetched(address, GRAPH)
    try:
        graph = msgspec.json.decode(content, type=Graph)
    except msgspec.DecodeError as error:
        raise UsageError(f"{address} answers with no graph: {error}", expected="a `roslens watch --serve`") from None
    if not graph.nodes and not graph.endpoints:
        raise UsageError(f"the monitor at {address} sees no node", expected="one that sees a robot")
    return running_side(graph, f"what {address} sees")


def written_side(path: str, name: str) -> Side:
    """Return the graph that ``watch --graph-out`` wrote, under a name: nodes and endpoints, no parameters.

    Raises:
        DocumentError: the file is none.
    """
    from roslens.live.observe.read_rosgraph import read_rosgraph

    return running_side(read_rosgraph(Path(path)), name, parameters=False)


def bag_side(path: str, name: str) -> Side:
    """Return what a recording holds, under a name.

    Raises:
        UsageError: it is none.
    """
    from roslens.live.adapters.bag.open_bag import open_bag

    bag = open_bag(Path(path))
    for failure in bag.failures:
        print(f"roslens: {failure}", file=sys.stderr)
    return recorded_side(bag.graph(), name)


def reference_side(path: str, name: str) -> Side:
    """Return what a reference expects, under a name.

    Raises:
        DocumentError: it is wrong.
    """
    from roslens.judge.reading.read_reference import load_reference
    from roslens.live.window.signals import BY_KEY

    return Side(SideKind.REFERENCE, name, reference=load_reference([Path(path)], BY_KEY))

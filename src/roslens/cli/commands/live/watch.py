"""``roslens watch``: rate a running system, or a recording of one, against references."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.page.door import add_door_arguments
from roslens.cli.terminal.streams import add_stream_arguments
from roslens.cli.watch.observers import add_observer_arguments
from roslens.cli.watch.param_reference import add_reference_argument, reference_sources
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable

    from roslens.cli.watch.watch_serve import PageAfter
    from roslens.judge.reference.expectation import Reference
    from roslens.live.join.session import Step

TEXT = "Watch a running ROS system or a recording, and report deviations from the reference."
EXAMPLES = """\
  roslens watch --bag drive.bag --reference rover.yaml      a recording, as fast as it can be read
  roslens watch --reference rover.yaml                      what runs here, until Ctrl-C; read again when it changes
  roslens watch --ros1 --for 60s                            a system test: exit code 1 when something is wrong
  roslens watch --for 60s --fail-on low,high,absent,unknown what was not judged fails it too
  roslens watch --bag drive.mcap                            without a reference: the graph and its rates
  roslens watch --listen 0.0.0.0:7411 --key-file key        agents on other hosts report to this one
  roslens watch --prometheus 9411                           values and states for Prometheus
  roslens watch --ros2 --diagnostics                        verdicts go back into ROS, for rqt and aggregators
  roslens watch --for 10s --graph-out graph.yaml            the graph, as rosgraph_msgs/Graph
  roslens watch --serve 8080                                a page that shows it: http://127.0.0.1:8080/"""

_BAD = ("low", "high", "absent")
_FAILING = (*_BAD, "unknown")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add options for what to watch, the references to compare with, and the outputs."""
    parser.add_argument("--bag", type=Path, nargs="+", metavar="FILE", help="a recording (ROS 1 bag, MCAP, SQLite)")
    add_reference_argument(parser)
    add_observer_arguments(parser)
    parser.add_argument("--for", dest="length", metavar="TIME", help="stop after this time (`60s`, `5 min`)")
    parser.add_argument(
        "--fail-on",
        default="low,high,absent",
        metavar="STATES",
        help="states that make the exit code 1: low, high, absent, unknown (at the end), or never "
        "(default: low,high,absent)",
    )
    parser.add_argument(
        "--format", choices=("text", "json"), default="text", help="output format; json: one line per change"
    )
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="write the result to this file")
    parser.add_argument("--prometheus", type=int, metavar="PORT", help="serve values for Prometheus on this machine")
    parser.add_argument(
        "--diagnostics", action="store_true", default=None, help="publish diagnostic_msgs on /diagnostics in ROS"
    )
    parser.add_argument(
        "--publish-statistics", metavar="TOPIC", help="publish roslens_msgs/RatedSignals on this topic in ROS"
    )
    parser.add_argument(
        "--journal", type=Path, action="append", metavar="FILE",
        help="with --prometheus or --diagnostics: where this journal ends (default: those of this user); may be given "
        "again",
    )  # fmt: skip
    parser.add_argument("--serve", metavar="[HOST:]PORT", help="show it in a browser (a port alone: on this machine)")
    add_door_arguments(parser)
    parser.add_argument(
        "--graph-out",
        type=Path,
        metavar="FILE",
        help="write the graph to this file at the end (rosgraph_msgs/Graph, YAML)",
    )
    parser.add_argument("--history", type=Path, metavar="FILE", help="store series and verdicts in this file (SQLite)")
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Watch, and return how it ended.

    That is 1 where a state of ``--fail-on`` came up, and 3 where nothing could be observed, or a verdict of severity
    error was never judged.

    Raises:
        UsageError: the options contradict each other or name something that is not there.
        DocumentError: a reference is wrong.
    """
    from roslens.cli.watch.watch_reload import ReferenceFiles

    states = _states(options.fail_on)
    files = ReferenceFiles(reference_sources(options.reference, options), steady=time.monotonic)
    if options.bag:
        return _replayed(options, files.reference, states)
    from roslens.cli.watch.watch_live import watch_live

    return watch_live(options, files, states)


def _states(text: str) -> frozenset[str]:
    if text == "never":
        return frozenset()
    states = frozenset(part.strip() for part in text.split(",") if part.strip())
    if wrong := sorted(states.difference(_FAILING)):
        raise UsageError(f"--fail-on {wrong[0]!r}", expected=f"{', '.join(_FAILING)} or never")
    return states


def _replayed(options: argparse.Namespace, reference: Reference, states: frozenset[str]) -> int:
    from roslens.cli.page.watch_screen import since_start
    from roslens.cli.watch.about_nothing import RECORDED, about_nothing, errors_about_nothing
    from roslens.cli.watch.graph_file import write_graph
    from roslens.cli.watch.watch_output import Teller
    from roslens.live.adapters.bag.open_bag import open_bag
    from roslens.live.replay.replay import replay

    live = "listen prometheus history diagnostics publish_statistics journal master domain length"
    for name in live.split():
        if getattr(options, name) is not None:
            option = "for" if name == "length" else name.replace("_", "-")
            raise UsageError(f"--{option} with --bag", expected="one of them", advice="A recording is read to its end")
    bag = open_bag(options.bag)
    shown, clock = ", ".join(str(path) for path in options.bag), since_start(bag.start)
    page = _page(options, shown, clock) if options.serve is not None else None
    with Teller(options, clock, bag.start) as teller:

        def report(step: Step) -> None:
            teller.tell(step)
            if page is not None:
                page.take(step)

        session = replay(bag, reference, report=report, begun=page.keep if page is not None else lambda _: None)
        amount = f"{bag.messages:,} messages in {bag.end - bag.start:.1f} s"
        teller.tell_unjudged(session.monitor.standing(), bag.end)
        missed = about_nothing(session, reference, bag.end, RECORDED)
        teller.end(session, bag.end, f"{shown}: {amount}; at its end:", missed)
    if options.graph_out is not None:
        write_graph(session.graph(), options.graph_out)
    if page is not None:
        page.show(session, bag.end, f"{amount}, read to the end")
    missed_errors = errors_about_nothing(session, reference, RECORDED)
    return teller.code(states, nothing_seen=not bag.messages or missed_errors)


def _page(options: argparse.Namespace, title: str, clock: Callable[[float], str]) -> PageAfter:
    from roslens.cli.page.door import door_of
    from roslens.cli.watch.watch_serve import PageAfter, address_of

    address = address_of(options.serve)
    return PageAfter(title, address, clock, door_of(options, address[0]))

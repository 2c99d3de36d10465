"""``roslens reference draft``: a draft of a reference for a recording, for the running system, or for a graph."""

from __future__ import annotations

import argparse
import re
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.terminal.boundary import CLEAN, NOT_ANALYSED
from roslens.cli.watch.observers import add_observer_arguments, given
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.live.adapters.bag.bag import Bag
    from roslens.live.drafting.draft_session import DraftSession
    from roslens.model.failure import Failure

TEXT = "Draft a reference from a recording, a running system or a graph, each line with its evidence."
EXAMPLES = """\
  roslens reference draft --bag drive.bag -o robot.yaml      from a recording
  roslens reference draft --live 60s -o robot.yaml           from what runs here, started through `roslens run`
  roslens reference draft --live '5 min' --tap '/camera/**'  and of what was not, by a subscription
  roslens reference draft --graph graph.yaml                 what is there, as `roslens watch --graph-out` writes it
  roslens reference draft --graph 3:drive.launch.xml         what that launch file starts, of run 3 of `check`"""
MOST_RAISED = 50
"""Alarms that are listed in a draft."""
_NAME = re.compile(r"[a-z][a-z0-9_-]*\Z")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what is drafted from and where it goes."""
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("--bag", type=Path, nargs="+", metavar="FILE", help="a recording")
    source.add_argument(
        "--live", metavar="TIME", help="the running system, for this time (`60s`); Ctrl-C ends it earlier"
    )
    source.add_argument(
        "--graph",
        metavar="RUN",
        help="what a run of `roslens check` in this workspace starts: its number, as `3` or, with one of its "
        "configurations, `3:drive.launch.xml`; or a file that `watch --graph-out` or `graph --format rosgraph` wrote",
    )
    parser.add_argument("--name", default="draft", help="of the reference (default: draft)")
    parser.add_argument("--each", action="store_true", help="one line per topic, even where several are alike")
    parser.add_argument(
        "-o", "--output", type=Path, metavar="FILE", help="write it to this file (default: standard output)"
    )
    add_observer_arguments(parser.add_argument_group("with --live"))
    parser.set_defaults(act=draft)


def draft(options: argparse.Namespace) -> int:
    """Write the draft and return the exit code: 3 where something could not be read or observed.

    Raises:
        UsageError: there is no recording, an option makes no sense, or the file exists.
        DocumentError: the graph is none.
        StoreError: there is no such run.
    """
    if not _NAME.match(options.name):
        raise UsageError(f"--name {options.name!r}", expected="small letters, digits, `-` and `_`, a letter first")
    if options.output is not None and options.output.exists():
        raise UsageError(
            f"{str(options.output)!r} exists", expected="a new file", advice="Remove it, or choose another"
        )
    if not options.live and (option := given(options)):
        raise UsageError(f"{option} without --live", expected="one of them")
    if options.live:
        text, failures = _of_what_runs(options)
    else:
        text, failures = _of_bag(options) if options.bag else (_of_graph(options), ())
    if options.output is None:
        print(text, end="")
    else:
        options.output.write_text(text, encoding="utf-8")
        print(f"roslens: wrote {options.output}; read it and change it before you rely on it", file=sys.stderr)
    for failure in failures:
        print(f"roslens: {failure}", file=sys.stderr)
    return NOT_ANALYSED if failures else CLEAN


def _of_bag(options: argparse.Namespace) -> tuple[str, tuple[Failure, ...]]:
    from roslens.live.adapters.bag.open_bag import open_bag
    from roslens.live.drafting.draft import Observed
    from roslens.live.drafting.draft_groups import grouped
    from roslens.live.drafting.draft_text import draft_text

    bag = open_bag(options.bag)
    observed = Observed()
    observed.add_types((topic.name, topic.type) for topic in bag.topics)
    for _, tallies in bag.tallies(observed.step_s):
        observed.add(tallies)
    drafts = observed.drafted() if options.each else grouped(observed.drafted())
    names = ", ".join(path.name for path in options.bag)
    source = f"{names} ({bag.messages:,} messages in {bag.end - bag.start:.0f} s)"
    parts = options.name, drafts, observed.left_out(), source
    return draft_text(*parts, raised=_raised(draft_text(*parts), bag)), bag.failures


def _raised(text: str, bag: Bag) -> list[str]:
    """Return the alarms that a draft raises on the recording that it was drafted from."""
    from roslens.cli.references.reference_test import line_of
    from roslens.judge.reading.read_reference import GivenText, load_reference
    from roslens.live.replay.alarms import AlarmLog
    from roslens.live.replay.replay import replay
    from roslens.live.window.signals import BY_KEY

    reference = load_reference([GivenText("draft", text.encode())], BY_KEY)
    log = AlarmLog()
    if bag.messages:
        replay(bag, reference, report=lambda step: log.add(step.changes))
    lines = [line_of(alarm, bag.start) for alarm in log.alarms()]
    more = [f"and {len(lines) - MOST_RAISED} more"] if len(lines) > MOST_RAISED else []
    return [*lines[:MOST_RAISED], *more]


def _of_graph(options: argparse.Namespace) -> str:
    from roslens.cli.graph.run_graph import graph_of_run, names_run
    from roslens.live.drafting.draft_presence import there_in
    from roslens.live.drafting.draft_text import Beside, draft_text
    from roslens.live.observe.read_rosgraph import read_rosgraph

    if names_run(options.graph):
        found = graph_of_run(options.graph)
        return draft_text(options.name, (), (), found.source, Beside(there_in(found.graph)), found.unsure)
    path = Path(options.graph)
    graph = read_rosgraph(path)
    topics = len({end.name for end in graph.endpoints})
    source = f"{path.name} ({len(graph.nodes)} nodes, {topics} topics, services and actions)"
    return draft_text(options.name, (), (), source, Beside(there_in(graph)))


def _of_what_runs(options: argparse.Namespace) -> tuple[str, tuple[Failure, ...]]:
    from roslens.live.drafting.draft_groups import grouped
    from roslens.live.drafting.draft_text import Beside, draft_text

    begun = time.time()
    session = _watched(options)
    observed, seconds = session.observed, time.time() - begun
    drafts = observed.drafted() if options.each else grouped(observed.drafted())
    messages = sum(one.messages for one in drafts)
    started = time.strftime("%Y-%m-%d %H:%M", time.localtime(begun))
    source = f"what ran at {started} for {seconds:.0f} s ({messages:,} messages)"
    looked = session.looked or seconds
    there = session.attendance.drafted(looked)
    beside = Beside(there, session.values.drafted(), session.states.drafted(looked))
    text = draft_text(options.name, drafts, observed.left_out(), source, beside, session.attendance.left_out())
    if not drafts and there:
        said = "no traffic was observed, only the graph; start nodes through `roslens run`, or give --tap '**'"
        print(f"roslens: {said}", file=sys.stderr)
    return text, tuple(session.monitor.failures)


def _watched(options: argparse.Namespace) -> DraftSession:
    import contextlib

    from roslens.cli.terminal.until_stopped import when_stopped
    from roslens.cli.watch.stretch import Stretch
    from roslens.cli.watch.watch_live import length_of, sources_of
    from roslens.live.drafting.draft_session import DraftSession
    from roslens.live.join.session import run

    length = length_of(options.live, "--live")
    session = DraftSession(start=time.time())
    with contextlib.ExitStack() as stack:
        stretch = Stretch(session, length, when_stopped(stack))
        sources = sources_of(options)
        print(f"roslens: watching for {length:g} s; Ctrl-C drafts from what was seen until then", file=sys.stderr)
        run(session, sources, wall=time.time, stopped=stretch.over, report=lambda _: None)
    return session

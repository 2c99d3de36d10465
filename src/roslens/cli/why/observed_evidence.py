"""What a running system says for an answer: observed for a few seconds, as `roslens watch` does, and then no more."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
import time
from typing import TYPE_CHECKING

from roslens.compare.why.apart import DISCOVERY, DOMAIN, RMW
from roslens.compare.why.observed import Ended, Observed
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.live.join.session import Session, Step
    from roslens.model.graph import Event

LOOK_S = 4.0
"""How long it is looked by default, from when the observers see; in seconds."""


def observed_evidence(options: argparse.Namespace) -> Observed:
    """Return what runs here.

    Raises:
        UsageError: no ROS is found that was asked for.
    """
    from roslens.cli.terminal.until_stopped import when_stopped
    from roslens.cli.watch.stretch import Stretch
    from roslens.cli.watch.watch_live import length_of, sources_of
    from roslens.judge.reference.expectation import Reference
    from roslens.live.agent.ros_environments import ros_environments
    from roslens.live.join.session import Session, run

    length = length_of(options.length, "--for") if options.length else LOOK_S
    session = Session(Reference("nothing"), start=time.time())
    events: list[Event] = []
    last = time.time()

    def report(step: Step) -> None:
        nonlocal last
        last = step.time
        events.extend(step.events)

    with contextlib.ExitStack() as stack:
        stretch = Stretch(session, length, when_stopped(stack))
        if not options.quiet:
            print(f"roslens: looking at what runs for {length:g} s", file=sys.stderr)
        sources = sources_of(options)
        before = ros_environments()
        run(session, sources, wall=time.time, stopped=stretch.over, report=report)
    graph = session.graph()
    failures = tuple(str(one) for one in session.monitor.failures)
    if not graph.nodes and not graph.endpoints and not before.processes:
        raise UsageError(
            f"no node runs here that could be seen in {stretch.passed:.0f} s{_because(failures)}",
            expected="a ROS system",
            advice="Set $ROS_DOMAIN_ID or $ROS_MASTER_URI as the robot has it, or give --for a longer time",
        )
    values = {str(entity): found for entity, found in session.readings(last)}
    here = {name: os.environ.get(name, "") for name in (DOMAIN, RMW, DISCOVERY)}
    if options.domain is not None:
        here[DOMAIN] = str(options.domain)
    return Observed(
        f"what runs here{_domain(graph.generation, here)}", graph, values, length, tuple(_ended(events, session)),
        failures, before.processes, before.unreadable, here,
    )  # fmt: skip


def _because(failures: tuple[str, ...]) -> str:
    return f": {failures[0]}" if failures else ""


def _domain(generation: str, here: dict[str, str]) -> str:
    return "" if generation == "ros1" else f", domain {here[DOMAIN] or '0'}"


def _ended(events: list[Event], session: Session) -> list[Ended]:
    from roslens.model.acting.process_end import end_words
    from roslens.model.graph import Change

    there = {one.name for one in session.graph().nodes}
    return [
        Ended(name, end_words(one.ended) if one.ended else one.detail, one.said)
        for one in events
        if one.change is Change.VANISHED and one.entity.startswith("node:")
        and (name := one.entity.removeprefix("node:")) not in there
    ]  # fmt: skip

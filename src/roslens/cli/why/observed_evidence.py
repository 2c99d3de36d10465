"""What a running system says for an answer: observed until nothing new comes, as `roslens watch` does, then no more."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

from roslens.compare.why.apart import DISCOVERY, DOMAIN, RMW
from roslens.compare.why.observed import Ended, Observed, ObservedTransforms
from roslens.compare.why.question import frames_of
from roslens.model.errors import UsageError
from roslens.model.graph import Role

if TYPE_CHECKING:
    from roslens.cli.why.observed_transforms import TransformListener
    from roslens.live.join.session import Session, Source, Step
    from roslens.model.graph import Event, Graph

LOOK_S = 4.0
"""How long it is looked at most by default, from when the observers see; in seconds."""


class Looking:
    """Observers that start to see what runs while something else is done; a context manager, which ends them."""

    def __init__(self, options: argparse.Namespace) -> None:
        """Start the observers that options ask for.

        Raises:
            UsageError: no ROS is found that was asked for.
        """
        from roslens.cli.watch.watch_live import length_of, sources_of
        from roslens.live.observe.child_source import ChildSource

        self._options = options
        self._exact = bool(options.length or options.tap)
        self._length = length_of(options.length, "--for") if options.length else LOOK_S
        self._sources: Sequence[Source] = sources_of(options)
        self._pair = frames_of(options.entity)
        self._listener = self._listening()
        for one in self._sources:
            if isinstance(one, ChildSource):
                one.begin()

    def __enter__(self) -> Looking:
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """End the observers that were not ended yet."""
        for one in self._sources:
            one.close()
        if self._listener is not None:
            self._listener.close()

    def _listening(self) -> TransformListener | None:
        """Return what listens to transforms, where frames are asked about; of ROS 1 none does."""
        if not self._pair or self._options.ros1:
            return None
        from roslens.cli.why.observed_transforms import LISTEN_S, TransformListener

        seconds = self._length if self._options.length else LISTEN_S
        try:
            return TransformListener(self._options.python or "", self._options.domain, seconds)
        except UsageError:
            # The observers say it.
            return None

    def _transforms(self, graph: Graph) -> tuple[ObservedTransforms | None, tuple[str, ...]]:
        """Return what was heard of frames, and what kept it from being heard."""
        if self._listener is None:
            return None, ()
        from roslens.cli.why.observed_transforms import observed_transforms

        heard = self._listener.heard()
        if isinstance(heard, str):
            return None, (heard,)
        publishers = {one.node for one in graph.endpoints if one.name in heard.topics and one.role is Role.PUBLISHER}
        said = observed_transforms(heard, self._pair, tuple(sorted(publishers)))
        return ObservedTransforms(said, heard.start, heard.end), ()

    def observed(self) -> Observed:
        """Return what runs here.

        Raises:
            UsageError: nothing of ROS runs here.
        """
        from roslens.cli.terminal.until_stopped import when_stopped
        from roslens.cli.watch.stretch import Stretch
        from roslens.cli.why.settled import Settled
        from roslens.judge.reference.expectation import Reference
        from roslens.live.agent.ros_environments import ros_environments
        from roslens.live.join.session import Session, run

        session = Session(Reference("nothing"), start=time.time())
        # They are closed by whoever runs them.
        sources, self._sources = self._sources, []
        settled = Settled(session, self._options.entity.rpartition(":")[2])
        events: list[Event] = []
        last = time.time()

        def report(step: Step) -> None:
            nonlocal last
            last = step.time
            events.extend(step.events)
            settled.take(step.graph)

        def over(now: float) -> bool:
            return stretch.over() or (not self._exact and settled.over(now))

        with contextlib.ExitStack() as stack:
            stretch = Stretch(session, self._length, when_stopped(stack))
            if not self._options.quiet:
                most = "" if self._exact else " at most"
                print(f"roslens: looking at what runs, for {self._length:g} s{most}", file=sys.stderr)
            run(session, sources, wall=time.time, stopped=over, report=report)
        programs = ros_environments()
        graph = session.graph()
        failures = tuple(str(one) for one in session.monitor.failures)
        if not graph.nodes and not graph.endpoints and not programs.processes:
            raise UsageError(
                f"no node runs here that could be seen in {stretch.passed:.0f} s{_because(failures)}",
                expected="a ROS system",
                advice="Set $ROS_DOMAIN_ID or $ROS_MASTER_URI as the robot has it, or give --for a longer time",
            )
        values = {str(entity): found for entity, found in session.readings(last)}
        here = {name: os.environ.get(name, "") for name in (DOMAIN, RMW, DISCOVERY)}
        if self._options.domain is not None:
            here[DOMAIN] = str(self._options.domain)
        transforms, unheard = self._transforms(graph)
        return Observed(
            f"what runs here{_domain(graph.generation, here)}", graph, values, stretch.seen,
            tuple(_ended(events, session)), (*failures, *unheard), programs.processes, programs.unreadable,
            programs.closed_memory, programs.routers, os.getuid(), transforms, here,
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

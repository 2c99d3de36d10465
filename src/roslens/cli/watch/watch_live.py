"""`roslens watch` of what runs now: which observers, how long, where it is reported."""

from __future__ import annotations

import argparse
import contextlib
import os
import platform
import shutil
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

from roslens.cli.page.watch_screen import screen, time_of_day
from roslens.cli.terminal.until_stopped import when_stopped
from roslens.cli.watch.about_nothing import about_nothing, errors_about_nothing, kinds_of
from roslens.cli.watch.graph_file import write_graph
from roslens.cli.watch.journal_heads import heads_of
from roslens.cli.watch.stretch import Stretch, blind, never_saw
from roslens.cli.watch.watch_output import Teller
from roslens.cli.watch.watch_publish import publish_through, unpublished, wanted
from roslens.cli.watch.which_ros import wants_ros1
from roslens.live.join.session import Session, Source, Step, run
from roslens.live.past.keeper import Keeper
from roslens.live.reported.reported_levels import is_reported
from roslens.model.errors import UsageError
from roslens.model.failure import Failure

if TYPE_CHECKING:
    from roslens.cli.watch.watch_reload import ReferenceFiles
    from roslens.live.observe.child_source import Publishes
    from roslens.store.journals.journal_head import JournalHead
    from roslens.store.live.history import History

_REDRAW_S = 1.0
_HOME, _CLEAR_LINE, _CLEAR_BELOW = "\x1b[H", "\x1b[K", "\x1b[J"
_ENTER, _LEAVE = "\x1b[?1049h\x1b[?25l", "\x1b[?25h\x1b[?1049l"


def watch_live(options: argparse.Namespace, files: ReferenceFiles, states: frozenset[str]) -> int:
    """Watch until the time is over or it is stopped, and return the exit code.

    Raises:
        UsageError: the options make no sense, or an address is taken.
    """
    length = length_of(options.length, "--for") if options.length is not None else None
    with Teller(options, time_of_day) as teller:
        return _watched(options, files, states, teller, length)


def _watched(
    options: argparse.Namespace,
    files: ReferenceFiles,
    states: frozenset[str],
    teller: Teller,
    length: float | None,
) -> int:
    with contextlib.ExitStack() as stack:
        session = Session(files.reference, start=time.time())
        publishes = wanted(options)
        sources = _sources(options, publishes)
        history = stack.enter_context(_history(options))
        sinks: list[Callable[[Step], None]] = [Keeper(session, history).take] if history is not None else []
        heads = heads_of(options.journal, os.environ)
        if publishes is not None:
            sinks.append(publish_through(sources, session, lambda: files.reference, publishes, heads))
        if options.prometheus is not None:
            sinks.append(_serve(stack, options.prometheus, session, sources, heads))
        page = None
        if options.serve is not None:
            from roslens.cli.page.board_page import notes_beside
            from roslens.cli.page.door import door_of
            from roslens.cli.watch.watch_serve import address_of, page_beside

            address = address_of(options.serve)
            door = door_of(options, address[0], acting=True)
            recall = history.recall() if history is not None else None
            handled = notes_beside(options.history, platform.node(), os.environ)
            page, shown = page_beside(
                stack,
                session,
                platform.node(),
                address,
                time_of_day,
                door,
                recall=recall,
                handled=handled,
                domain=options.domain,
            )
            sinks.append(shown)
        on_screen = sys.stdout.isatty() and options.format == "text" and options.output is None
        sinks.append(stack.enter_context(_screen(teller, session, sources, page)) if on_screen else teller.tell)
        stretch = Stretch(session, length, when_stopped(stack))
        last = time.time()

        def report(step: Step) -> None:
            nonlocal last
            last = step.time
            step = files.renew(session, step)
            for sink in sinks:
                sink(step)

        run(session, sources, wall=time.time, stopped=stretch.over, report=report)
        if failures := never_saw(sources, stretch.passed):
            teller.tell(Step(last, failures=failures))
        else:
            teller.tell_unjudged(session.monitor.standing(), last)
    for text in teller.said if on_screen else ():
        # The screen that showed it is gone.
        print(f"roslens: {text}", file=sys.stderr)
    # As of the last look: ending the observers takes a while, in which all of them are silent.
    missed = about_nothing(session, files.reference, last, kinds_of(session))
    if options.graph_out is not None:
        write_graph(session.graph(), options.graph_out)
    teller.end(session, last, f"after {stretch.passed:.0f} s:", missed)
    missed_errors = errors_about_nothing(session, files.reference, kinds_of(session))
    return teller.code(states, nothing_seen=not session.records or missed_errors)


def length_of(text: str, option: str) -> float:
    """Return the seconds that an option specifies.

    Raises:
        UsageError: it is no time above 0.
    """
    from roslens.judge.ranges.amount import parse_amount

    try:
        length = parse_amount(text, "s")
    except ValueError as error:
        raise UsageError(f"{option} {text!r}: {error}", expected="a time such as `60s`") from None
    if length <= 0:
        raise UsageError(f"{option} {text!r}", expected="a time above 0")
    return length


def sources_of(options: argparse.Namespace) -> list[Source]:
    """Return the observers that options ask for, which publish nothing.

    Raises:
        UsageError: there is no such ROS, or an address is taken.
    """
    return _sources(options, None)


def _sources(options: argparse.Namespace, publishes: Publishes | None) -> list[Source]:
    from roslens.live.agent.gpu import gpu_reader
    from roslens.live.agent.host import HostSampler
    from roslens.live.agent.identity import own_identities
    from roslens.live.agent.processes import ProcessSampler
    from roslens.live.inside.host_counters import HostCounters
    from roslens.live.observe.child_source import ChildSource
    from roslens.live.observe.local_host import LocalHost

    name = platform.node()
    of_ros = _of_ros(options, publishes)
    beside = any(isinstance(one, ChildSource) for one in of_ros)
    local = LocalHost(
        name, HostSampler(name, gpu=gpu_reader()), ProcessSampler(name), wall=time.time, steady=time.monotonic,
        counters=HostCounters(name, os.environ, beside=True) if beside else None, identities=own_identities,
    )  # fmt: skip
    sources: list[Source] = [local, *of_ros]
    if options.listen is not None:
        sources.append(_listener(options))
    return sources


def _of_ros(options: argparse.Namespace, publishes: Publishes | None) -> list[Source]:
    """Return the observers that were asked for; without a word about it, of every ROS that is found here."""
    from roslens.live.observe.child_source import ros1_source, ros2_source

    taps = options.tap
    sources: list[Source] = []
    if wants_ros1(options):
        sources.append(ros1_source(options.master or "", taps, os.environ, steady=time.monotonic, publishes=publishes))
    ros2 = partial(ros2_source, options.python or "", options.domain, taps, os.environ, publishes=publishes)
    if options.ros2:
        sources.append(ros2(steady=time.monotonic))
    elif not options.ros1:
        try:
            sources.append(ros2(steady=time.monotonic))
        except UsageError as error:
            if options.python or options.domain is not None:
                raise
            if not sources and options.listen is None:
                sources.append(NoRos(error))
    return sources


class NoRos:
    """Reports once that no ROS was found, unless it was requested by name."""

    def __init__(self, error: UsageError) -> None:
        """Report what was tried."""
        self._failure: Failure | None = Failure(
            "ros", f"no ROS was found: no $ROS_MASTER_URI and {error.what}", error.expected, error.advice
        )

    def poll(self, seconds: float) -> list[Failure]:
        """Return the failure the first time."""
        time.sleep(seconds)
        found, self._failure = self._failure, None
        return [found] if found else []

    def close(self) -> None:
        """Nothing is open."""


def _listener(options: argparse.Namespace) -> Source:
    from roslens.cli.watch.agent_address import address_of
    from roslens.live.agent.key_file import read_key
    from roslens.live.agent.link import LinkError
    from roslens.live.observe.listen import Listener

    if not options.key_file:
        raise UsageError(
            "--listen without a key", expected="--key-file FILE", advice="Make one: roslens agent --new-key FILE"
        )
    address = address_of(options.listen)
    try:
        return Listener(address, *map(read_key, options.key_file), wall=time.time, steady=time.monotonic)
    except LinkError as error:
        raise UsageError(f"--key-file: {error}") from None
    except OSError as error:
        raise UsageError(f"cannot listen on {options.listen!r}: {error.strerror or error}") from None


@contextlib.contextmanager
def _history(options: argparse.Namespace) -> Iterator[History | None]:
    if options.history is None:
        yield None
        return
    from roslens.store.live.history import History

    with History.open(options.history) as history:
        yield history


def _serve(
    stack: contextlib.ExitStack, port: int, session: Session, sources: Sequence[object],
    heads: Callable[[], Sequence[JournalHead]] = tuple,
) -> Callable[[Step], None]:  # fmt: skip
    from roslens.live.publish.between_steps import BetweenSteps
    from roslens.live.publish.endpoint import Endpoint
    from roslens.live.publish.prometheus import prometheus_text

    now = time.time()

    def page() -> str:
        counters = {"records_total": float(session.records), "shed_total": float(session.monitor.shed)}
        counters["cpu_seconds_total"] = time.process_time()
        counters["unpublished_total"] = float(unpublished(sources))
        return prometheus_text(session.readings(now), session.monitor.standing(), counters, heads())

    asked = BetweenSteps(page)
    try:
        endpoint = Endpoint(("127.0.0.1", port), asked.text)
    except OSError as error:
        raise UsageError(f"--prometheus {port}: {error.strerror or error}", expected="a free port") from None
    stack.callback(endpoint.close)
    print(f"roslens: {endpoint.url}", file=sys.stderr, flush=True)

    def answer(step: Step) -> None:
        nonlocal now
        now = step.time
        asked.answer()

    return answer


@contextlib.contextmanager
def _screen(
    teller: Teller, session: Session, sources: Sequence[Source], page: str | None
) -> Iterator[Callable[[Step], None]]:
    """Take the terminal for a table that is drawn again every second; it is given back at the end."""
    begun, cpu = time.monotonic(), time.process_time()
    drawn = 0.0
    notes: list[str] = []

    def draw(step: Step) -> None:
        nonlocal drawn
        teller.count(step)
        notes.extend(str(failure) for failure in step.failures)
        notes.extend(one.text for one in step.notes)
        notes.extend(f"{one.entity}  {one.detail}" for one in step.events if is_reported(one))
        passed = time.monotonic() - begun
        if passed - drawn < _REDRAW_S and not (step.notes or any(one.state.bad for one in step.changes)):
            return
        drawn = passed
        share = 100 * (time.process_time() - cpu) / max(passed, 0.001)
        if waited := "" if session.begun else ", ".join(blind(sources)):
            waited = f", waiting for the observer of {waited}"
        title = f"roslens watch  {passed:.0f} s, costs {share:.1f} % of a core{waited}{f'  {page}' if page else ''}"
        height = shutil.get_terminal_size((100, 24)).lines
        lines = screen(
            teller.terminal,
            session.tree(step.time),
            session.monitor.standing(),
            title=title,
            height=height - 1,
            clock=time_of_day,
            notes=notes[-3:],
        )
        sys.stdout.write(_HOME + "".join(f"{line}{_CLEAR_LINE}\n" for line in lines) + _CLEAR_BELOW)
        sys.stdout.flush()

    sys.stdout.write(_ENTER)
    try:
        yield draw
    finally:
        sys.stdout.write(_LEAVE)
        sys.stdout.flush()

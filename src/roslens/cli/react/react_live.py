"""`roslens react` of what runs now: which observers, who carries out, and where it is reported."""

from __future__ import annotations

import argparse
import contextlib
import os
import platform
import sys
import time
from collections import deque
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roslens.cli.page.watch_screen import time_of_day
from roslens.cli.react.ask_terminal import AskNobody, AskTerminal
from roslens.cli.react.done_before import done_before
from roslens.cli.react.hold_file import Held
from roslens.cli.react.react_page import AskEverywhere, serve_reacting, write_refusals
from roslens.cli.react.react_reload import Renewal
from roslens.cli.react.sole_reactor import hold_alone, system_of
from roslens.cli.terminal.until_stopped import when_stopped
from roslens.cli.watch.param_reference import reference_sources
from roslens.cli.watch.stretch import Stretch, never_saw
from roslens.cli.watch.watch_live import length_of, sources_of
from roslens.intake.user_folder import state_folder
from roslens.live.join.session import Session, Step, run
from roslens.live.publish.json_lines import verdict_line
from roslens.model.errors import DocumentError, UsageError

if TYPE_CHECKING:
    from roslens.cli.watch.watch_reload import ReferenceFiles
    from roslens.dashboard.journal.questions import Questions
    from roslens.live.agent.host_hand import HostHand
    from roslens.live.react.actor import Actor, Asker
    from roslens.live.react.all_hands import AllHands
    from roslens.live.react.far_agents import FarAgents
    from roslens.live.react.gate import Limits
    from roslens.live.react.node_places import NodePlaces
    from roslens.live.react.ros_line import RosLine
    from roslens.model.acting.reaction import Decision
    from roslens.store.journals.journal import Journal

_READY_WITHIN_S = 30.0
_PLACES_EVERY_S = 1.0
_LOG_LINES = 500


def react_live(options: argparse.Namespace) -> int:
    """React until the time is over or it is stopped, and return the exit code.

    Raises:
        UsageError: the options make no sense, or no ROS is observed in which anything could be done.
        DocumentError: the reference has no reactions, or calls for what cannot be done.
    """
    from roslens.cli.workplace.journal_key import journal_signing
    from roslens.store.journals.journal import Journal

    limits, files = limits_of(options), files_with_reactions(options)
    if options.mode == "ask" and not sys.stdin.isatty() and options.serve is None:
        raise UsageError(
            "--mode ask without a way to answer", expected="a terminal, or --serve PORT",
            advice="Take --mode dry-run or act",
        )  # fmt: skip
    length = length_of(options.length, "--for") if options.length is not None else None
    path = options.journal or state_folder(os.environ) / "journal.jsonl"
    with contextlib.ExitStack() as stack:
        journal = stack.enter_context(Journal(path, journal_signing(path, os.environ)))
        questions = questions_of(options.mode) if options.serve is not None else None
        reacting = Reacting(options, files, limits, journal, stack, questions)
        reacting.prepare()
        if options.serve is not None:
            reacting.show(*serve_reacting(stack, reacting.session, platform.node(), options, journal.path, questions))
        return reacting.run(Stretch(reacting.session, length, when_stopped(stack)))


def files_with_reactions(options: argparse.Namespace) -> ReferenceFiles:
    """Return the references of the options.

    Raises:
        UsageError: none of them has reactions.
        DocumentError: one is wrong.
    """
    from roslens.cli.watch.watch_reload import ReferenceFiles

    files = ReferenceFiles(reference_sources(options.reference, options), steady=time.monotonic)
    if not files.reference.reactions:
        shown = ", ".join(str(one) for one in options.reference)
        raise UsageError(f"no reaction in {shown or 'no reference'}", expected="a document with `reactions:`")
    return files


def questions_of(mode: str) -> Questions | None:
    """Return what asks on a page; None where nothing is ever done."""
    from roslens.dashboard.journal.questions import Questions

    # In mode `act`, too: a reaction may be more careful than that.
    return Questions() if mode != "dry-run" else None


def limits_of(options: argparse.Namespace) -> Limits:
    """Return how much may be done.

    Raises:
        UsageError: an option is wrong.
    """
    from roslens.live.react.gate import Limits
    from roslens.live.react.maintenance import parse_window
    from roslens.model.acting.reaction import Mode

    for name in ("at_most", "most_restarts"):
        if getattr(options, name) < 0:
            raise UsageError(f"--{name.replace('_', '-')} {getattr(options, name)}", expected="0 or more")
    try:
        windows = tuple(parse_window(one) for one in options.maintenance)
    except ValueError as error:
        raise UsageError(f"--maintenance: {error}") from None
    return Limits(
        Mode(options.mode), cool_down_s=length_of(options.cool_down, "--cool-down"), at_most=options.at_most,
        most_restarts=options.most_restarts, windows=windows,
    )  # fmt: skip


class _Telling:
    """A journal whose entries are shown, and published in ROS, once they are on the disk."""

    def __init__(self, journal: Journal, as_json: bool) -> None:
        self._journal = journal
        self._json = as_json
        self.publish: Callable[[str], None] = lambda _: None

    def add(self, what: str, time: float, **fields: Any) -> object:
        """Append an entry, then print it."""
        import msgspec

        from roslens.report.history.journal_text import journal_line

        entry = self._journal.add(what, time, **fields)
        reported = msgspec.to_builtins(entry)
        text = msgspec.json.encode({"is": "journal", **reported}).decode()
        print(text if self._json else journal_line(entry, time_of_day), flush=True)
        self.publish(text)
        return entry


class Reacting:
    """Watches the running system and carries out the reactions of a reference: prepared, shown if requested, and run.

    Attributes:
        session: of the watch.
    """

    def __init__(
        self, options: argparse.Namespace, files: ReferenceFiles, limits: Limits, journal: Journal,
        stack: contextlib.ExitStack, questions: Questions | None,
    ) -> None:  # fmt: skip
        from roslens.live.react.gate import Gate, recalled
        from roslens.live.react.node_places import NodePlaces

        self._options = options
        self._files = files
        self._reference = files.reference
        self._stack = stack
        self._held = Held(os.environ)
        self._questions = questions
        self._folder: Path = journal.path.parent
        self._journal = _Telling(journal, options.json)
        self._places: NodePlaces = NodePlaces()
        self._gate = Gate(limits, self._places.of)
        recalled(self._gate, done_before(journal.path, limits.restarts_per_s), time.monotonic())
        self._log: deque[str] = deque(maxlen=_LOG_LINES)
        self._failed = False
        self._places_due = 0.0
        self._started = time.time()
        self.session = Session(self._reference, start=self._started)
        self._address = ""
        self._shown: Callable[[Step], None] | None = None

    def show(self, address: str, shown: Callable[[Step], None]) -> None:
        """Pass each step to ``shown``; its pages are at ``address``."""
        self._address, self._shown = address, shown

    def prepare(self) -> None:
        """Start observers and what acts, and wait until all that may have to be done can be.

        Raises:
            UsageError: the options make no sense, or no ROS is observed in which anything could be done.
            DocumentError: the reference calls for what cannot be done.
        """
        from roslens.live.observe.child_source import ChildSource

        # What may be refused comes before anything is started.
        self._own, far, topic = self._here(), self._far_agents(), self._journal_topic()
        self._sources = sources_of(self._options)
        self._tools = [one.tool for one in self._sources if isinstance(one, ChildSource)]
        if self._options.mode != "dry-run":
            hold_alone(self._stack, (system_of(tool, self._options) for tool in self._tools))
        hands = self._hands = self._all_hands(self._tools, self._own, far)
        self._stack.callback(hands.close)
        hands.prepare(self._reference.reactions)
        if topic:
            self._journal.publish = partial(hands.say, topic)
        self._wait_until_ready(hands)

    def run(self, stretch: Stretch) -> int:
        """React until ``stretch`` is over; return the exit code."""
        session, hands, here = self.session, self._hands, self._own
        actor = self._actor(hands, self._started)
        renewal = Renewal(self._files, session, actor.reactor, hands, self._journal, steady=time.monotonic)
        names = [one.name for one in self._reference.reactions]
        self._journal.add(
            "began", self._started, mode=self._options.mode, reactions=names, host=platform.node(),
            observers=self._tools, references=[str(one) for one in self._options.reference], page=self._address,
        )  # fmt: skip
        try:
            run(
                session,
                [*self._sources, _Wakes(hands)],
                wall=time.time,
                stopped=stretch.over,
                report=lambda step: self._reported(actor, here, renewal.look(step)),
            )
        finally:
            self._journal.add("ended", time.time(), text="nothing is done any more")
        for failure in never_saw(self._sources, stretch.passed):
            self._failed = True
            print(f"roslens: {failure}", file=sys.stderr)
        return 3 if self._failed else 0

    def _reported(self, actor: Actor, here: _Here | None, step: Step) -> None:
        for failure in step.failures:
            self._log.append(f"{time_of_day(step.time)} {failure}")
            if not self._options.quiet:
                print(f"roslens: {failure}", file=sys.stderr)
        if self._options.json and self._options.verbose:
            for one in step.changes:
                print(verdict_line(one), flush=True)
        self._log.extend(f"{time_of_day(one.time)} {one.entity} {one.change.value} {one.detail}" for one in step.events)
        self._log.extend(
            f"{time_of_day(one.time)} {one.entity} {one.quantity} {one.state.value}" for one in step.changes
        )
        if step.events or step.time >= self._places_due or step.time < self._places_due - 10 * _PLACES_EVERY_S:
            self._places_due = step.time + _PLACES_EVERY_S
            graph = self.session.graph()
            self._places.take(graph)
            if here is not None:
                own = platform.node()
                counting = {one.pid: one.nodes for one in graph.processes if one.host == own}
                here.records.keep({one.pid: () for one in graph.nodes if one.host == own and one.pid} | counting)
        actor.take(step)
        if self._questions is not None:
            write_refusals(self._questions, self._journal)
        # The page last: what is due does not wait for it.
        if self._shown is not None:
            self._shown(step)

    def _actor(self, hands: AllHands, started: float) -> Actor:
        from roslens.live.react.actor import Actor
        from roslens.live.react.reactor import Reactor

        places: list[Asker] = [self._questions] if self._questions is not None else []
        # In mode `act`, too: a reaction may be more careful than that.
        if self._options.mode != "dry-run" and sys.stdin.isatty():
            places.append(AskTerminal())
        asker = AskEverywhere(places) if places else AskNobody()
        reactor = Reactor(self._reference.reactions, start=started)
        return Actor(reactor, self._gate, self._journal, hands, asker, held=self._held, steady=time.monotonic)

    def _all_hands(self, tools: Sequence[str], here: _Here | None, far: FarAgents | None) -> AllHands:
        from roslens.live.react.all_hands import AllHands

        lines = [_ros_line(tool, self._options) for tool in tools]
        hands = AllHands(
            lines, self._places, platform.node(), here=here.hand if here is not None else None,
            far=far, recordings=self._folder / "recordings", monitor=self._by_monitor,
        )  # fmt: skip
        if here is not None:
            here.reported = hands.reported
        return hands

    def _far_agents(self) -> FarAgents | None:
        if self._options.enrolled is None:
            return None
        from roslens.cli.watch.agent_address import DEFAULT_REQUESTS_PORT, address_of
        from roslens.live.agent.enrol import read_monitor
        from roslens.live.react.far_agents import FarAgents

        listen = self._options.agents or f"0.0.0.0:{DEFAULT_REQUESTS_PORT}"
        enrolment = read_monitor(self._options.enrolled)
        try:
            found = FarAgents(address_of(listen, DEFAULT_REQUESTS_PORT), enrolment, self._say)
        except OSError as error:
            raise UsageError(f"cannot listen on {listen!r}: {error.strerror or error}") from None
        self._stack.callback(found.close)
        return found

    def _say(self, text: str) -> None:
        if not self._options.quiet:
            print(f"roslens: {text}", file=sys.stderr, flush=True)

    def _here(self) -> _Here | None:
        if self._options.allow is None:
            return None
        from roslens.live.agent.allow_list import read_allow_list

        return _Here(read_allow_list(self._options.allow), self._held, self._folder / "nodes")

    def _by_monitor(self, decision: Decision) -> Callable[[], str]:
        """Look at what an action of the monitor itself needs, and return what carries it out."""
        from roslens.live.act.actions import snapshot, webhook

        if decision.action.kind == "webhook":
            return partial(webhook.act, decision)
        now = decision.at_s
        standing = snapshot.Standing(
            self.session.graph(), tuple(self.session.monitor.standing()), tuple(self.session.readings(now)),
            tuple(self._log),
        )  # fmt: skip
        return partial(snapshot.act, decision, standing, self._folder / "snapshots")

    def _journal_topic(self) -> str:
        topic = str(self._options.publish_journal or "")
        if topic and not topic.startswith("/"):
            raise UsageError(f"--publish-journal {topic!r}", expected="a resolved name such as `/roslens/journal`")
        return topic

    def _wait_until_ready(self, hands: AllHands) -> None:
        end = time.monotonic() + _READY_WITHIN_S
        while hands.waiting() and time.monotonic() < end:
            hands.poll()
            time.sleep(0.02)
        for place, why in hands.unready().items():
            raise DocumentError(f"this action cannot be carried out: {why}", where=place)


class _Wakes:
    """A source without reports, which ends the waiting of the session when an action was carried out."""

    def __init__(self, hands: AllHands) -> None:
        self.descriptors = hands.descriptors

    def poll(self, _: float) -> tuple[()]:
        """Return nothing."""
        return ()

    def close(self) -> None:
        """Nothing is open."""


class _Here:
    """Acts on this host."""

    def __init__(self, allow: Any, held: Callable[[], str], output: Path) -> None:
        from roslens.live.agent.host_hand import Done, HostHand
        from roslens.live.agent.process_record import ProcessRecords
        from roslens.live.react.actor import CarriedOut

        self.records = ProcessRecords()
        self.reported: Callable[[CarriedOut], None] = lambda _: None

        def reported(done: Done) -> None:
            self.reported(CarriedOut(done.id, done.done, done.text, done.duration_s, done.refused))

        self.hand: HostHand = HostHand(allow, self.records, reported, output=output, held=held)


def _ros_line(tool: str, options: argparse.Namespace) -> RosLine:
    from roslens.children.safe_path import python_words
    from roslens.live.adapters.child import find_ros2_python, ros2_command
    from roslens.live.react.ros_line import RosLine

    if tool == "ros1":
        words = ["--master", options.master] if options.master else []
        code = "from roslens.live.adapters.ros1.acting import main; sys.exit(main(sys.argv[1:]))"
        return RosLine(1, python_words(sys.executable, code, words, path=sys.path), os.environ, time.monotonic)
    words = ["--domain", str(options.domain)] if options.domain is not None else []
    python = find_ros2_python(options.python or "", os.environ)
    command = ros2_command(python, words, "roslens.live.adapters.ros2.acting")
    return RosLine(2, command, os.environ, time.monotonic)

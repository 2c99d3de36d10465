"""`roslens serve --bag`: a recording is read in a thread, and its page shows how far that is and how it ended."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event, Thread

from roslens.cli.page.named_apart import named_apart
from roslens.cli.page.watch_page import PageSource
from roslens.cli.page.watch_screen import since_start
from roslens.cli.watch.param_reference import reference_sources
from roslens.cli.watch.watch_reload import ReferenceFiles
from roslens.live.adapters.bag.open_bag import open_bag
from roslens.live.join.session import Session, Step
from roslens.live.past.keeper import Keeper, in_memory
from roslens.live.replay.replay import replay
from roslens.model.errors import RoslensError
from roslens.model.failure import Failure

_END_S = 10.0


class _LeftError(Exception):
    """The rest of the recording is not needed."""


@contextmanager
def recording_beside(options: argparse.Namespace) -> Iterator[PageSource]:
    """Read the recording of the options in a thread until the context is left; give what shows it.

    Raises:
        UsageError: it is not there or no recording.
        DocumentError: a reference is wrong.
    """
    reference = ReferenceFiles(reference_sources(options.reference, options), steady=time.monotonic).reference
    bag = open_bag(options.bag)
    title = ", ".join(named_apart(options.bag))
    page = PageSource(title, clock=since_start(bag.start), live=False, steady=time.monotonic)
    page.make(Session(reference, start=bag.start), bag.start, "the recording is being read")
    left, started = Event(), Event()
    sessions: list[Session] = []
    keepers: list[Keeper] = []

    def begun(session: Session) -> None:
        keeper = in_memory(session)
        page.remember(keeper.recall())
        keepers.append(keeper)
        sessions.append(session)
        started.set()

    def report(step: Step) -> None:
        if left.is_set():
            raise _LeftError
        page.take(step)
        keepers[0].take(step)
        if page.due():
            share = (step.time - bag.start) / max(bag.end - bag.start, 1e-9)
            page.make(sessions[0], step.time, f"the recording is being read, {share:.0%}")

    def read() -> None:
        try:
            session = replay(bag, reference, report=report, begun=begun)
        except _LeftError:
            return
        except RoslensError as error:
            page.take(Step(bag.end, failures=(Failure("recording", str(error)),)))
            if sessions:
                page.make(sessions[0], bag.end, "the recording could not be read to its end")
            return
        keepers[0].end()
        page.make(session, bag.end, f"{bag.messages:,} messages in {bag.end - bag.start:.1f} s, read to the end")

    thread = Thread(target=read, name="recording", daemon=True)
    thread.start()
    # The past is there, or not, from when the pages are served.
    started.wait(_END_S)
    try:
        yield page
    finally:
        left.set()
        thread.join(_END_S)

"""`roslens serve --live`: what runs is watched in a thread, beside the pages of a run."""

from __future__ import annotations

import argparse
import os
import platform
import time
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event, Thread

from roslens.cli.page.board_page import notes_beside
from roslens.cli.page.watch_page import PageSource
from roslens.cli.page.watch_screen import time_of_day
from roslens.cli.watch.param_reference import reference_sources
from roslens.cli.watch.watch_live import sources_of
from roslens.cli.watch.watch_reload import ReferenceFiles
from roslens.cli.watch.watch_serve import page_of
from roslens.live.join.session import Session, Step, run

_END_S = 10.0


@contextmanager
def live_beside(options: argparse.Namespace) -> Iterator[PageSource]:
    """Watch what options ask for until the context is left; give what shows it.

    Raises:
        UsageError: there is no such ROS, or an address is taken.
        DocumentError: a reference is wrong.
    """
    files = ReferenceFiles(reference_sources(options.reference, options), steady=time.monotonic)
    session = Session(files.reference, start=time.time())
    sources = sources_of(options)
    handled = notes_beside(None, platform.node(), os.environ)
    page, shown = page_of(session, platform.node(), time_of_day, handled=handled, domain=options.domain)

    def report(step: Step) -> None:
        shown(files.renew(session, step))

    ended = Event()

    def watch() -> None:
        run(session, sources, wall=time.time, stopped=lambda _: ended.is_set(), report=report)

    thread = Thread(target=watch, name="watch", daemon=True)
    thread.start()
    try:
        yield page
    finally:
        ended.set()
        thread.join(_END_S)

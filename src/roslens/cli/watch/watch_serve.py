"""`roslens watch --serve`: the live page beside a watch, or after a recording was read."""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.children.scratch_folder import ScratchFolder
from roslens.cli.page.watch_page import PageSource
from roslens.cli.terminal.until_stopped import when_stopped
from roslens.cli.watch.full_collection import FullCollection
from roslens.dashboard.live.serving import LivePage
from roslens.live.past.keeper import MOST_VALUES, Keeper, in_memory
from roslens.model.errors import UsageError
from roslens.store.live.history import History

if TYPE_CHECKING:
    from roslens.cli.page.door import Door
    from roslens.dashboard.live.further import Further
    from roslens.live.join.session import Session, Step
    from roslens.store.handled import HandledAlerts
    from roslens.store.past.recall import Recall

_LOOK_S = 0.1


def address_of(text: str) -> tuple[str, int]:
    """Read ``PORT``, ``HOST:PORT`` or ``[IPv6]:PORT`` of ``--serve``; a port alone is of this machine.

    Raises:
        UsageError: it is none of these.
    """
    host, separator, port = text.rpartition(":")
    bracketed = host.startswith("[") and host.endswith("]")
    if not separator:
        host = "127.0.0.1"
    elif bracketed:
        host = host[1:-1]
    bad_host = not host or (":" in host and not bracketed)
    if bad_host or not (port.isascii() and port.isdigit()) or len(port) > 5 or int(port) > 65535:
        raise UsageError(f"--serve {text!r}", expected="PORT or HOST:PORT, such as `8080` or `0.0.0.0:8080`")
    return host, int(port)


def serve(
    source: PageSource, address: tuple[str, int], door: Door | None = None, further: Further | None = None
) -> LivePage:
    """Start to serve what ``source`` has, and ``further`` pages, to whom ``door`` lets in, and say where.

    Raises:
        UsageError: the address cannot be listened on.
    """
    host, port = address
    access, tls = (door.access, door.tls) if door else (None, None)
    page = LivePage(
        source.newest, detail=source.detail, graph=source.graph, past=source.past, board=source.board,
        state=source.state, sight=source.sight,
        host=host, port=port, access=access, tls=tls, further=further, why=source.why.page,
    )  # fmt: skip
    print(f"roslens: {door.address(page.url) if door else page.url}", file=sys.stderr, flush=True)
    return page


def page_of(
    session: Session,
    title: str,
    clock: Callable[[float], str],
    recall: Recall | None = None,
    handled: HandledAlerts | None = None,
    domain: int | None = None,
) -> tuple[PageSource, Callable[[Step], None]]:
    """Return what shows a session that goes on, and what to tell each step.

    Its past is that of ``recall``, which somebody else keeps; without one the last hours are kept in memory. ``domain``
    is that of ROS 2 that is watched; None is that of the environment.
    """
    source = PageSource(
        title, clock=clock, live=True, steady=time.monotonic, handled=handled, spent=time.thread_time
    )  # fmt: skip
    source.why.look_in(domain)
    keeper = None
    if recall is None:
        keeper = in_memory(session)
        recall = keeper.recall()
    source.remember(recall)
    begun, cpu = time.monotonic(), time.process_time()
    collection = FullCollection(time.monotonic)

    def make(now: float) -> None:
        share = 100 * (time.process_time() - cpu) / max(time.monotonic() - begun, 1.0)
        source.make(session, now, f"{share:.1f} % of a core, {session.records:,} records")

    def report(step: Step) -> None:
        source.take(step)
        if keeper is not None:
            keeper.take(step)
        if source.due():
            make(step.time)
        collection.now_and_then()

    make(time.time())
    return source, report


def page_beside(
    stack: contextlib.ExitStack, session: Session, title: str, address: tuple[str, int],
    clock: Callable[[float], str], door: Door | None = None, further: Further | None = None,
    recall: Recall | None = None, handled: HandledAlerts | None = None, domain: int | None = None,
) -> tuple[str, Callable[[Step], None]]:  # fmt: skip
    """Serve a session that goes on until ``stack`` is left; return where, and what to tell each step.

    Raises:
        UsageError: the address cannot be listened on.
    """
    source, report = page_of(session, title, clock, recall, handled, domain)
    return stack.enter_context(serve(source, address, door, further)).url, report


class PageAfter:
    """Shows how a recording ended, once it was read."""

    def __init__(
        self, title: str, address: tuple[str, int], clock: Callable[[float], str], door: Door | None = None
    ) -> None:
        """Show what is called ``title`` at ``address``."""
        self._source = PageSource(title, clock=clock, live=False, steady=time.monotonic)
        self._address = address
        self._door = door
        self._keeper: Keeper | None = None
        self._folder = contextlib.ExitStack()

    def keep(self, session: Session) -> None:
        """Keep what a session does from now on, for who looks back; a file is given up when the page ends."""
        folder = self._folder.enter_context(ScratchFolder("replay"))
        history = self._folder.enter_context(History.open(Path(folder) / "recording.sqlite"))
        self._keeper = Keeper(session, history, most_values=MOST_VALUES)
        self._source.remember(self._keeper.recall())

    def take(self, step: Step) -> None:
        """Remember what happened in a step."""
        self._source.take(step)
        if self._keeper is not None:
            self._keeper.take(step)

    def show(self, session: Session, end: float, cost: str) -> None:
        """Serve how it was at ``end``, until Ctrl-C or a request to end.

        Raises:
            UsageError: the address cannot be listened on.
        """
        if self._keeper is not None:
            self._keeper.end()
        self._source.make(session, end, cost)
        with self._folder as stack:
            ended = when_stopped(stack)
            stack.enter_context(serve(self._source, self._address, self._door))
            while not ended:
                time.sleep(_LOOK_S)

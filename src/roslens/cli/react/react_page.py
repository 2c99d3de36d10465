"""`roslens react --serve`: the live page with the journal, and the questions of `ask` mode beside it."""

from __future__ import annotations

import argparse
import contextlib
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from roslens.cli.page.door import door_of
from roslens.cli.page.watch_screen import time_of_day
from roslens.cli.watch.watch_serve import address_of, page_beside

if TYPE_CHECKING:
    from roslens.dashboard.access.audit import Entry
    from roslens.dashboard.journal.questions import Questions
    from roslens.dashboard.live.further import Further
    from roslens.live.join.session import Session, Step
    from roslens.live.react.actor import Asker
    from roslens.model.acting.reaction import Decision, Reaction

_REFUSED = 400


class Writing(Protocol):
    """A journal."""

    def add(self, what: str, time: float, **fields: Any) -> object:
        """Append an entry."""


def journal_clock(seconds: float) -> str:
    """Return a day and a time of it."""
    return f"{time.strftime('%Y-%m-%d', time.localtime(seconds))} {time_of_day(seconds)}"


def journal_pages(
    path: Path, title: str, questions: Questions | None = None,
    reactions: Callable[[], Sequence[Reaction] | None] = lambda: None, base: str = "",
) -> Further:  # fmt: skip
    """Return the pages of a journal, of the reactions that it is about, and of the questions where there are any.

    The navigation finds them below ``base``; of ``reactions`` None says that no reference was given.
    """
    from roslens.dashboard.journal.journal_view import JournalView
    from roslens.dashboard.journal.routes import journal_links, journal_routes
    from roslens.dashboard.live.further import Further

    routes = journal_routes(JournalView(path, journal_clock), title, reactions=reactions, questions=questions)
    waiting = (lambda: len(questions.open())) if questions is not None else int
    return Further(routes, journal_links(acting=questions is not None, base=base), waiting)


def serve_reacting(
    stack: contextlib.ExitStack, session: Session, title: str, options: argparse.Namespace, journal: Path,
    questions: Questions | None,
) -> tuple[str, Callable[[Step], None]]:  # fmt: skip
    """Serve until ``stack`` is left, print the address, and return it and the receiver of each step.

    Raises:
        UsageError: the address is none, or cannot be listened on, or tokens or certificates are wrong.
    """
    address = address_of(options.serve)

    def report(entry: Entry) -> None:
        if questions is not None and entry.method == "POST" and entry.status >= _REFUSED:
            questions.refused(entry.peer, f"{entry.path}: {entry.why or entry.status}")

    door = door_of(options, address[0], acting=questions is not None, report=report)
    pages = journal_pages(journal, title, questions, lambda: session.monitor.reference.reactions)
    return page_beside(stack, session, title, address, time_of_day, door, pages)


class AskEverywhere:
    """Asks in several places; the answer that comes first counts."""

    def __init__(self, places: Sequence[Asker]) -> None:
        self._places = tuple(places)
        self._open: set[str] = set()

    def ask(self, decision: Decision, until_s: float) -> None:
        """Ask whether it may be done."""
        self._open.add(decision.id)
        for place in self._places:
            place.ask(decision, until_s)

    def answers(self) -> list[tuple[str, bool, str]]:
        """Return decisions that were answered since the last time, each once, and by whom."""
        found = []
        for place in self._places:
            for answer in place.answers():
                if answer[0] not in self._open:
                    continue
                self._open.discard(answer[0])
                found.append(answer)
                for other in self._places:
                    if other is not place:
                        other.withdraw(answer[0])
        return found

    def withdraw(self, decision: str) -> None:
        """Ask no more."""
        self._open.discard(decision)
        for place in self._places:
            place.withdraw(decision)


def write_refusals(questions: Questions, journal: Writing) -> None:
    """Record refused requests, so that no attempt goes unnoticed."""
    for one in questions.refusals():
        journal.add("refused-answer", one.time, text=one.why, address=one.address)

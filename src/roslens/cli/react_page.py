"""`roslens react --serve`: the live page with the journal, and the questions of `ask` mode beside it."""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from roslens.cli.watch_screen import time_of_day
from roslens.cli.watch_serve import Beside, address_of, page_beside

if TYPE_CHECKING:
    from roslens.dashboard.journal.questions import Questions
    from roslens.live.react.actor import Asker
    from roslens.live.session import Session, Step
    from roslens.model.reaction import Decision


class Writing(Protocol):
    """A journal."""

    def add(self, what: str, time: float, **fields: Any) -> object:
        """Append an entry."""


def journal_clock(seconds: float) -> str:
    """Return a day and a time of it."""
    return f"{time.strftime('%Y-%m-%d', time.localtime(seconds))} {time_of_day(seconds)}"


def journal_beside(path: Path, title: str, questions: Questions | None = None) -> tuple[Beside, str]:
    """Return the pages of a journal, and the key that answers questions; empty where none can be answered."""
    from roslens.dashboard.journal.journal_view import JournalView
    from roslens.dashboard.journal.routes import Acting, journal_links, journal_routes
    from roslens.dashboard.operator_key import OperatorKey

    acting = Acting(questions, OperatorKey()) if questions is not None else None
    routes = journal_routes(JournalView(path, journal_clock), title, acting=acting)
    return Beside(routes, journal_links(acting=acting is not None)), acting.key.text if acting is not None else ""


def serve_reacting(
    stack: contextlib.ExitStack, session: Session, title: str, where: str, journal: Path, questions: Questions | None
) -> Callable[[Step], None]:
    """Serve until ``stack`` is left, say where, and return what to tell each step.

    Raises:
        UsageError: the address is none, or cannot be listened on.
    """
    beside, key = journal_beside(journal, title, questions)
    url, told = page_beside(stack, session, title, address_of(where), time_of_day, beside)
    if key:
        # To whoever sits here: with it the page may allow what is asked.
        print(f"roslens: to answer questions: {url.rstrip('/')}/questions#key={key}", file=sys.stderr, flush=True)
    return told


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
    """Write down who was refused, so that nobody tries it unseen."""
    for one in questions.refusals():
        journal.add("refused-answer", one.time, text=one.why, address=one.address)

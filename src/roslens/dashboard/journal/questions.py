"""Questions whether something may be done, between who asks and who answers on a page; for several threads."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable

import msgspec

from roslens.model.acting.reaction import Because, Decision
from roslens.report.history.journal_text import action_text

MOST_OPEN = 200
"""Questions that are shown at a time; more than that could not be read within a minute."""
_MOST_TOLD = 20


class Question(msgspec.Struct, frozen=True):
    """One question.

    Attributes:
        decision: id of what is to be allowed.
        what: would be done, in words.
        about: text form of the id of the entity.
        because: statements that are true, in words.
        text: message of the reaction for the operator.
        until: seconds since the epoch until which an answer counts.
    """

    decision: str
    what: str
    about: str
    because: tuple[str, ...]
    text: str
    until: float


class Refusal(msgspec.Struct, frozen=True):
    """An answer that was not taken: when, from which address, and why."""

    time: float
    address: str
    why: str


class Questions:
    """What is asked, and what was answered."""

    def __init__(self, wall: Callable[[], float] = time.time) -> None:
        """Start without questions; ``wall`` returns seconds since the epoch."""
        self._wall = wall
        self._lock = threading.Lock()
        self._open: dict[str, Question] = {}
        self._answers: list[tuple[str, bool, str]] = []
        self._refused: deque[Refusal] = deque(maxlen=_MOST_TOLD)

    def ask(self, decision: Decision, until_s: float) -> None:
        """Ask whether something may be done; ``until_s`` is on the clock on which it was decided."""
        action = {**msgspec.to_builtins(decision.action), "target": str(decision.action.target or "")}
        because = tuple(_reason(one) for one in decision.because)
        until = self._wall() + max(until_s - decision.at_s, 0.0)
        question = Question(decision.id, action_text(action), decision.entity, because, decision.text, until)
        with self._lock:
            self._open[decision.id] = question

    def withdraw(self, decision: str) -> None:
        """Ask no more."""
        with self._lock:
            self._open.pop(decision, None)

    def answers(self) -> list[tuple[str, bool, str]]:
        """Return decisions that were answered since the last time, whether they are allowed, and by whom."""
        with self._lock:
            found, self._answers = self._answers, []
        return found

    def refusals(self) -> list[Refusal]:
        """Return answers that were not taken since the last time, the newest ones where there were many."""
        with self._lock:
            found = list(self._refused)
            self._refused.clear()
        return found

    def open(self) -> tuple[Question, ...]:
        """Return what is asked, what was asked first comes first."""
        with self._lock:
            return tuple(list(self._open.values())[:MOST_OPEN])

    def answer(self, decision: str, *, allowed: bool, by: str) -> bool:
        """Take an answer; return whether that was still asked."""
        with self._lock:
            question = self._open.pop(decision, None)
            if question is None or self._wall() > question.until:
                return False
            self._answers.append((decision, allowed, by))
            return True

    def refused(self, address: str, why: str) -> None:
        """Note that an answer was not taken."""
        with self._lock:
            self._refused.append(Refusal(self._wall(), address, why))


def _reason(one: Because) -> str:
    """Return a statement with what was observed, unless the statement already contains it."""
    return f"{one.statement}: {one.evidence}" if one.evidence and one.evidence not in one.statement else one.statement

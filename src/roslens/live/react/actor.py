"""Joins due actions, the decisions of gates, the executors, and the journal of all of it.

Nothing here waits: it gets each step of the session, and hands over what there is to do.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import msgspec

from roslens.live.join.session import Step
from roslens.live.react.gate import Answer, Gate, GateAnswer
from roslens.live.react.reactor import Reactor
from roslens.model.acting.reaction import Decision, Mode, Outcome, Result, Verification, repeats

ANSWER_WITHIN_S = 60.0
"""An action that is neither approved nor refused within this time is not carried out."""
LONGEST_WAIT_S = 300.0
"""What a gate lets wait longer than that is refused."""
_UNANSWERED_S = 180.0
"""The executor reports before that; otherwise the action counts as failed."""


class Writing(Protocol):
    """A journal."""

    def add(self, what: str, time: float, **fields: Any) -> object:
        """Append an entry, on the disk when this returns."""


class CarriedOut(msgspec.Struct, frozen=True):
    """The result of an action that was handed over; ``refused`` if the executor refused it before trying."""

    decision: str
    done: bool
    text: str
    duration_s: float = 0.0
    refused: bool = False


class Hands(Protocol):
    """All who carry out."""

    def do(self, decision: Decision) -> None:
        """Start it; :meth:`poll` returns the result."""

    def poll(self) -> list[CarriedOut]:
        """Return what was carried out since the last time."""

    def clear(self, decision: str) -> None:
        """End what repeats for a decision."""

    def stop(self) -> None:
        """End everything that repeats or is under way."""


class Asker(Protocol):
    """An operator who may approve due actions."""

    def ask(self, decision: Decision, until_s: float) -> None:
        """Ask whether it may be done."""

    def answers(self) -> list[tuple[str, bool, str]]:
        """Return decisions that were answered, whether they are allowed, and by whom."""

    def withdraw(self, decision: str) -> None:
        """Ask no more."""


class _Open(msgspec.Struct):
    decision: Decision
    since: float


class _Waiting(msgspec.Struct, frozen=True):
    decision: Decision
    since: float
    due: float


class Actor:
    """Carries out what a reactor decides, as far as its gate lets it.

    Args:
        reactor: decides.
        gate: says whether a decision may be carried out.
        journal: of everything.
        hands: carry out.
        asker: of mode ``ask``.
        held: who holds everything and why; empty where nobody does.
        steady: a clock that never jumps.
    """

    def __init__(
        self, reactor: Reactor, gate: Gate, journal: Writing, hands: Hands, asker: Asker, *,
        held: Callable[[], str], steady: Callable[[], float],
    ) -> None:  # fmt: skip
        self.reactor = reactor
        self._gate = gate
        self._journal = journal
        self._hands = hands
        self._asker = asker
        self._held = held
        self._steady = steady
        self._asked: dict[str, _Open] = {}
        self._waiting: dict[str, _Waiting] = {}
        self._under_way: dict[str, _Open] = {}
        self._repeats: set[str] = set()
        self._unwell: str | None = None
        self._spared: dict[tuple[str, str], str] = {}
        self._hold = ""

    def take(self, step: Step) -> None:
        """Take a step of the session."""
        self._notice(step)
        for decision in self.reactor.look(step, step.time):
            self._decide(decision, step.time)
        self._notice_unwell(step)
        self._notice_spared(step)
        self._waited(step)
        self._answered(step)
        self._carried_out(step)
        for checked in self.reactor.checks():
            self._journal.add(
                "verified", step.time, decision=checked.decision, verification=checked.verification.value,
                text=checked.text,
            )  # fmt: skip
            if checked.verification is Verification.GONE:
                self._clear(checked.decision)
        for decision_id in [one for one in self._repeats if self.reactor.holds(one) is False]:
            self._clear(decision_id)

    def release(self, now: float) -> None:
        """Restart what was given up again, from now on."""
        if freed := self._gate.release():
            self._journal.add("released", now, text=f"restarted again from now on: {', '.join(freed)}")

    def _notice(self, step: Step) -> None:
        """Journal a hold that began or ended; when it begins everything that is under way ends."""
        held = self._held()
        if held == self._hold:
            return
        if held and not self._hold:
            self._hands.stop()
            self._repeats.clear()
            for waiting in list(self._waiting.values()):
                self._pass(waiting.decision, step.time)
        self._journal.add("held" if held else "released", step.time, text=held)
        if not held:
            self.release(step.time)
        self._hold = held

    def _notice_unwell(self, step: Step) -> None:
        unwell = self.reactor.unwell
        if unwell != self._unwell:
            first, self._unwell = self._unwell is None, unwell
            if unwell or not first:
                self._journal.add("unwell" if unwell else "well", step.time, text=unwell)

    def _notice_spared(self, step: Step) -> None:
        """Journal once why a node that somebody ended is not started again."""
        spared = self.reactor.spared
        for (reaction, entity), why in spared.items():
            if (reaction, entity) not in self._spared:
                self._journal.add("spared", step.time, reaction=reaction, entity=entity, text=why)
        self._spared = spared

    def _decide(self, decision: Decision, now: float) -> None:
        reported = msgspec.to_builtins(decision)
        self._journal.add(
            "decided", now, decision=decision.id, **{key: value for key, value in reported.items() if key != "id"}
        )
        self._pass(decision, now)

    def _pass(self, decision: Decision, now: float) -> None:
        """Let a decision through the gate, or report why not."""
        steady = self._steady()
        found = self._gate.judge(decision, steady, wall_s=now, held=self._held())
        waiting = self._waiting.get(decision.id)
        if waiting is None or found.answer is not Answer.WAIT:
            self._journal.add("gate", now, decision=decision.id, gate=found.answer.value, text=found.text)
        if found.answer is Answer.WAIT:
            since = waiting.since if waiting is not None else steady
            self._waiting[decision.id] = _Waiting(decision, since, steady + max(found.again_s, 0.0))
            return
        self._waiting.pop(decision.id, None)
        if found.answer is Answer.ALLOW:
            self._do(decision, now)
        elif found.answer is Answer.ASK:
            self._asked[decision.id] = _Open(decision, self._steady())
            self._asker.ask(decision, now + ANSWER_WITHIN_S)
            self._end(decision, Outcome(Result.ASKED, found.text), now)
        else:
            if found.answer is Answer.DRY_RUN:
                self._gate.done(decision, steady)
                self._gate.ended(decision, steady)
            self._end(decision, _outcome_of(found), now)

    def _waited(self, step: Step) -> None:
        """Ask the gate again about what had to wait, as long as it is still to be done."""
        steady = self._steady()
        for decision_id, waiting in list(self._waiting.items()):
            holds = self.reactor.holds(decision_id)
            if holds is False or steady - waiting.since > LONGEST_WAIT_S:
                del self._waiting[decision_id]
                why = "its condition no longer holds" if holds is False else f"it had to wait for {LONGEST_WAIT_S:g} s"
                self._end(waiting.decision, Outcome(Result.REFUSED, why), step.time)
            elif holds is True and steady >= waiting.due:
                self._pass(waiting.decision, step.time)

    def _answered(self, step: Step) -> None:
        now = self._steady()
        for decision_id, allowed, who in self._asker.answers():
            asked = self._asked.pop(decision_id, None)
            if asked is None:
                continue
            answer = "yes" if allowed else "no"
            self._journal.add("answered", step.time, decision=decision_id, answer=answer, by=who)
            if not allowed:
                self._end(asked.decision, Outcome(Result.REFUSED, f"{who} refused"), step.time)
            else:
                self._allowed(asked.decision, step.time)
        for decision_id, asked in list(self._asked.items()):
            gone = self.reactor.holds(decision_id) is False
            if gone or now - asked.since > ANSWER_WITHIN_S:
                del self._asked[decision_id]
                self._asker.withdraw(decision_id)
                why = "its condition no longer holds" if gone else f"no answer within {ANSWER_WITHIN_S:g} s"
                self._end(asked.decision, Outcome(Result.REFUSED, why), step.time)

    def _allowed(self, decision: Decision, now: float) -> None:
        """Carry out an approved action, if it is still due and nothing forbids it by now."""
        if self.reactor.holds(decision.id) is not True:
            self._end(decision, Outcome(Result.REFUSED, "its condition no longer holds, or is unknown"), now)
            return
        asked_for = msgspec.structs.replace(decision, mode=Mode.ASK)
        found = self._gate.judge(asked_for, self._steady(), wall_s=now, held=self._held())
        if found.answer is Answer.ASK:
            self._do(decision, now)
        else:
            self._journal.add("gate", now, decision=decision.id, gate=found.answer.value, text=found.text)
            self._end(decision, _outcome_of(found), now)

    def _do(self, decision: Decision, now: float) -> None:
        self._gate.done(decision, self._steady())
        self._journal.add(
            "announced", now, decision=decision.id, reaction=decision.reaction, entity=decision.entity,
            action=msgspec.to_builtins(decision.action), text=decision.text,
        )  # fmt: skip
        self._under_way[decision.id] = _Open(decision, self._steady())
        if repeats(decision.action):
            self._repeats.add(decision.id)
        self._hands.do(decision)

    def _carried_out(self, step: Step) -> None:
        for found in self._hands.poll():
            open_ = self._under_way.pop(found.decision, None)
            if open_ is None:
                continue
            self._gate.ended(open_.decision, self._steady())
            result = Result.DONE if found.done else Result.REFUSED if found.refused else Result.FAILED
            if not found.done:
                self._repeats.discard(found.decision)
            self._end(open_.decision, Outcome(result, found.text, found.duration_s), step.time)
        now = self._steady()
        for decision_id, open_ in list(self._under_way.items()):
            if now - open_.since > _UNANSWERED_S:
                del self._under_way[decision_id]
                self._gate.ended(open_.decision, now)
                text = f"no result was reported within {_UNANSWERED_S:g} s"
                self._end(open_.decision, Outcome(Result.FAILED, text, now - open_.since), step.time)

    def _end(self, decision: Decision, outcome: Outcome, now: float) -> None:
        self._journal.add(
            "outcome", now, decision=decision.id, result=outcome.result.value, text=outcome.text,
            duration_s=round(outcome.duration_s, 4),
        )  # fmt: skip
        self.reactor.reported(decision.id, outcome)

    def _clear(self, decision_id: str) -> None:
        if decision_id in self._repeats:
            self._repeats.discard(decision_id)
            self._hands.clear(decision_id)


def _outcome_of(found: GateAnswer) -> Outcome:
    results = {Answer.DRY_RUN: Result.DRY_RUN, Answer.HELD: Result.HELD, Answer.GIVE_UP: Result.GAVE_UP}
    return Outcome(results.get(found.answer, Result.REFUSED), found.text)

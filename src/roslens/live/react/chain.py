"""One escalation: the actions of a reaction about one entity, one after the other, until its cause is gone."""

from __future__ import annotations

from enum import Enum

from roslens.live.react.truth import Truth
from roslens.model.acting.reaction import Checked, Decision, EscalationStep, Outcome, Result, Verification

_TRIED = (Result.DONE, Result.DRY_RUN)
_GOES_ON = (Result.FAILED, Result.GAVE_UP)


class Stage(str, Enum):
    """How far a chain is.

    - due: its next step is to be decided
    - waiting: nobody has reported what became of the last decision
    - verifying: it was done, and has time to help
    - over: nothing more is done until the condition was false
    """

    DUE = "due"
    WAITING = "waiting"
    VERIFYING = "verifying"
    OVER = "over"


class Chain:
    """The chain of one reaction and entity, from its first decision to when the condition is false.

    Attributes:
        number: of the chain, part of the ids of its decisions.
        stage: how far it is.
        step: number of the latest decision, from 0; -1 before there is one.
        latest: the latest decision; None before there is one.
    """

    def __init__(self, number: int, steps: tuple[EscalationStep, ...]) -> None:
        self.number = number
        self.stage = Stage.DUE
        self.step = -1
        self.latest: Decision | None = None
        self._steps = steps
        self._deadline = 0.0
        self._unknown_reported = False
        self._tried: list[str] = []

    @property
    def next(self) -> EscalationStep:
        """The step that is due."""
        return self._steps[self.step + 1]

    def decided(self, decision: Decision) -> None:
        """Note that the next step was decided."""
        self.step += 1
        self.latest = decision
        self.stage = Stage.WAITING

    def reported(self, outcome: Outcome, now: float) -> None:
        """Take what became of the latest decision; what is reported before something final may be reported again."""
        if self.stage is not Stage.WAITING or outcome.result is Result.ASKED or self.latest is None:
            return
        verify = self._steps[self.step].verify_within_s
        if outcome.result in _TRIED:
            self._tried.append(self.latest.id)
            if verify is not None:
                self.stage, self._deadline, self._unknown_reported = Stage.VERIFYING, now + verify, False
                return
        elif outcome.result not in _GOES_ON:
            self.stage = Stage.OVER
            return
        self._go_on()

    def verify(self, lasts: Truth, now: float) -> list[Checked]:
        """Take whether it helped: ``lasts`` is whether the condition is still true."""
        if self.latest is None:
            return []
        if self.stage is Stage.VERIFYING and now >= self._deadline and lasts is not False:
            if lasts is None:
                reported, self._unknown_reported = self._unknown_reported, True
                text = "whether it helped is unknown: nothing follows until it is known"
                return [] if reported else [Checked(self.latest.id, Verification.UNKNOWN, now, text)]
            text = "the next action follows" if self._go_on() else "nothing is left to do"
            return [Checked(self.latest.id, Verification.STILL_THERE, now, text)]
        return []

    def ended(self, now: float) -> list[Checked]:
        """Note that the condition is false."""
        return [Checked(one, Verification.GONE, now, "the condition is false") for one in self._tried]

    def _go_on(self) -> bool:
        """Go on with the next step; return whether there is one."""
        more = self.step + 1 < len(self._steps)
        self.stage = Stage.DUE if more else Stage.OVER
        return more

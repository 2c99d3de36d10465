"""How one constraint stands about one entity, with what is reported of it."""

from __future__ import annotations

from roslens.judge.reference.expectation import Details
from roslens.live.standing.verdict_state import VerdictState
from roslens.live.window.evidence import evidence_of
from roslens.live.window.window import Window
from roslens.model.entity import EntityId
from roslens.model.verdict import Link, State, Verdict


class Standing:
    """One constraint about one entity.

    Attributes:
        entity: that is judged.
        details: what goes with the constraint.
        quantity: key of what is judged.
        written: the range, as people read it.
        state: how it stands.
        window: that showed the value; None where there is none.
        evidence: in words, where no window shows it.
        reported: the state that was reported last.
        cause: text form of the id of the entity whose fault explains this one.
        leads_to: what follows from it, in words, where it is a first cause.
        why: the way to the cause, link by link.
        silent_observer: text form of the id of the observer that it waits for, because that is silent.
    """

    __slots__ = (
        "cause",
        "details",
        "entity",
        "evidence",
        "leads_to",
        "quantity",
        "reported",
        "silent_observer",
        "state",
        "why",
        "window",
        "written",
    )  # fmt: skip

    def __init__(self, entity: EntityId, details: Details, quantity: str, written: str, now: float) -> None:
        self.entity = entity
        self.details = details
        self.quantity = quantity
        self.written = written
        self.state = VerdictState(details.timing, now)
        self.window: Window | None = None
        self.evidence = ""
        self.cause = self.silent_observer = self.leads_to = ""
        self.why: tuple[Link, ...] = ()
        self.reported = State.UNKNOWN

    @property
    def key(self) -> tuple[EntityId, str]:
        """By which verdicts are sorted."""
        return self.entity, self.details.id

    def forget(self, now: float, state: State) -> None:
        """Begin anew in ``state``, because time itself broke."""
        self.state.forget(now, state)

    def verdict(self) -> Verdict:
        """Return how it stands, for others to read."""
        state, details = self.state, self.details
        return Verdict(
            entity=self.entity,
            expectation=details.id,
            quantity=self.quantity,
            state=state.state,
            since=state.since,
            time=state.time,
            value=state.value,
            range=self.written,
            severity=details.severity,
            evidence=evidence_of(self.window) if self.window is not None else self.evidence,
            text=details.text,
            group=details.group,
            where=details.where,
            cause=self.cause if state.state.bad else self.silent_observer if state.state is State.UNKNOWN else "",
            leads_to=self.leads_to if state.state.bad else "",
            why=self.why if state.state.bad else (),
        )

"""What the live page is given besides the system: its references, and what somebody noted of alerts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.page.references_page import document_of, references_of
from roslens.dashboard.live.snapshot import Alert
from roslens.store.handled import Handled, HandledAlerts, How

if TYPE_CHECKING:
    from collections.abc import Mapping

    from roslens.dashboard.live.board import References
    from roslens.judge.reference.expectation import Reference
    from roslens.live.system.tree import SystemView
    from roslens.model.graph import Graph
    from roslens.model.verdict import Verdict
    from roslens.store.past.recall import Recall

MOST_ALERTS = 200
"""First causes in a snapshot, and alerts that follow from one; of more there is a count."""
_LONGEST_BY = 80
_UNDO, _ACKNOWLEDGE, _MUTE = "undo", "acknowledge", "mute"


class Looked(msgspec.Struct, frozen=True):
    """How a system stood when it was last looked at: values that never change."""

    view: SystemView
    standing: tuple[Verdict, ...]
    graph: Graph
    reference: Reference
    time: float


class BoardPage:
    """Answers from the newest look at a system; may be asked from any thread."""

    def __init__(
        self,
        looked: Callable[[], Looked | None],
        recall: Callable[[], Recall | None],
        handled: HandledAlerts,
        clock: Callable[[float], str],
    ) -> None:
        """``looked`` returns the newest look, ``recall`` what reads the history, ``handled`` keeps notes."""
        self._looked = looked
        self._recall = recall
        self._handled = handled
        self._clock = clock
        self._alerts: dict[str, Alert] = {}
        self._references: tuple[Looked, References] | None = None

    def references(self) -> References | None:
        """Return what is expected; see :class:`roslens.dashboard.live.board.Board`."""
        now = self._looked()
        if now is None:
            return None
        known = self._references
        if known is None or known[0] is not now:
            found = references_of(now.reference, now.view, now.standing, now.graph, self._recall(), now.time)
            known = self._references = now, found
        return known[1]

    def document(self, accepted: tuple[str, ...]) -> str:
        """Return a reference of the accepted proposals."""
        found = self.references()
        return document_of(found.proposals if found is not None else (), accepted, "accepted")

    def handle(self, key: str, how: str, seconds: float, by: str) -> str:
        """Note something of an alert; return why not, if not.

        Raises:
            StoreError: it cannot be kept.
        """
        now = self._looked()
        if now is None:
            return "Nothing was looked at yet."
        if how == _UNDO:
            self._handled.take_back(key, now.time)
            return ""
        alert = self._alerts.get(key)
        if alert is None:
            return f"There is no alert {key[:40]!r} any more. Expected one that the page shows."
        if how not in (_ACKNOWLEDGE, _MUTE):
            return f"how={how[:40]!r}; expected acknowledge, mute or undo."
        muted = how == _MUTE
        note = Handled(
            key, How.MUTED if muted else How.ACKNOWLEDGED, by[:_LONGEST_BY], now.time, alert.since,
            now.time + seconds if muted else 0.0, alert.name,
        )  # fmt: skip
        try:
            self._handled.put(note)
        except ValueError as error:
            return f"{error}."
        return ""

    def sorted(self, alerts: Sequence[Alert], now: float) -> tuple[tuple[Alert, ...], tuple[Alert, ...]]:
        """Return alerts with what was noted of them, and those that are muted; in each the first ones of very many."""
        self._alerts = {one.key: one for one in alerts}
        shown: list[Alert] = []
        muted: list[Alert] = []
        for one in alerts:
            note = self._handled.of(one.key, one.since, now)
            (muted if note is not None and note.how is How.MUTED else shown).append(self._noted(one, note))
        return tuple(shown), tuple(muted[:MOST_ALERTS])

    def _noted(self, alert: Alert, note: Handled | None) -> Alert:
        if note is None:
            return alert
        until = self._clock(note.until).strip() if note.until else ""
        return msgspec.structs.replace(alert, handled=note.how.value, by=note.by, until=until)


def notes_beside(history: Path | None, title: str, environment: Mapping[str, str]) -> HandledAlerts:
    """Return what was noted of alerts: beside the history where there is one, else among what belongs to the user.

    Raises:
        StoreError: a file holds something else.
    """
    from roslens.intake.user_folder import state_folder

    if history is not None:
        return HandledAlerts(history.with_name(f"{history.name}.alerts.json"))
    name = sha256(title.encode("utf-8", "replace")).hexdigest()[:16]
    return HandledAlerts(state_folder(environment) / "alerts" / f"{name}.json")

"""What `roslens watch --serve` shows: a session as the document of the live page."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from functools import lru_cache
from hashlib import blake2b
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.page.board_page import MOST_ALERTS, BoardPage, Looked
from roslens.cli.page.half_lines import encodable, ends_of
from roslens.cli.watch_causes import causes_of
from roslens.cli.watch_detail import detail_of
from roslens.cli.watch_graph import GraphPicture
from roslens.cli.watch_screen import nameless, urgency, value_text
from roslens.dashboard.live.snapshot import UNJUDGED, VERSION, Alert, Happening, Row, Snapshot
from roslens.judge.reference.expectation import Reference
from roslens.live.publish.diagnostics import sentence
from roslens.live.publish.graph_json import graph_bytes
from roslens.live.system.worth_a_row import badge, not_judged, worth_a_row
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.graph import Change, Event, Graph
from roslens.model.verdict import Verdict
from roslens.store.handled import HandledAlerts

if TYPE_CHECKING:
    from roslens.cli.page.past_page import PastPage
    from roslens.dashboard.computation.picture import Grounds
    from roslens.live.join.session import Session, Step
    from roslens.live.system.tree import SystemView
    from roslens.model.reaction import Reaction
    from roslens.store.past.recall import Recall

COLUMNS = (
    ("rate", "Rate"),
    ("largest_gap", "Gap"),
    ("latency", "Latency"),
    ("loss", "Loss"),
    ("bandwidth", "Bandwidth"),
    ("cpu", "CPU"),
    ("memory", "Memory"),
)
_PACE_S = 0.25
_IDLE_PACE_S = 5.0
_WANTED_S = 5.0
_MOST_SHARE = 0.05
_SLOWEST_S = 4.0
"""A large system is shown more slowly, so that showing it costs no more than this share of the time."""
_KEPT = 50
_GRAVITY = {severity.value: severity.rank for severity in Severity}
_PROCESS = f"{EntityKind.PROCESS.value}:"
_LONGEST_NAME = 200
_LONGEST_TEXT = 600


class PageSource:
    """Makes a snapshot of a session when one is due, and hands it to the page as bytes.

    Snapshots are made by who runs the session; :meth:`newest` may be called from any thread. While nobody asks for
    them they are made less often.
    """

    def __init__(
        self, title: str, *, clock: Callable[[float], str], live: bool, steady: Callable[[], float],
        handled: HandledAlerts | None = None,
    ) -> None:  # fmt: skip
        """Show what is called ``title``.

        Args:
            title: of what is watched.
            clock: writes times.
            live: whether more will come.
            steady: tells how long ago something was.
            handled: keeps what somebody notes of alerts; by default as long as the page lasts.
        """
        self._title = title
        self._clock = clock
        self._live = live
        self._steady = steady
        self._picture = GraphPicture(shown_name)
        self._happened: deque[Happening] = deque(maxlen=_KEPT)
        self._failures: deque[str] = deque(maxlen=_KEPT)
        self._asked = -math.inf
        self._made = -math.inf
        self._took = 0.0
        self._shown: Snapshot | None = None
        self._written: tuple[Snapshot | None, bytes] = (None, b"")
        self._looked: Looked | None = None
        self._recall: Recall | None = None
        self.past: PastPage | None = None
        self.board = BoardPage(lambda: self._looked, lambda: self._recall, handled or HandledAlerts(None), clock)

    def draw_on(self, grounds: Callable[[Collection[str]], Grounds | None]) -> None:
        """Draw everything where its source has it, as far as ``grounds`` knows that."""
        self._picture = GraphPicture(shown_name, grounds)

    def remember(self, recall: Recall) -> None:
        """Show the past from a history, too."""
        from roslens.cli.page.past_page import PastPage

        self._recall = recall
        self.past = PastPage(recall, self._title, clock=self._clock, picture=lambda: self._picture)

    def end_at(self, time: float) -> bool:
        """Show how it stood at ``time``, from what is remembered; return whether something is known of then."""
        seen = self.past.seen(time) if self.past is not None else None
        shown = self.past.document(time) if self.past is not None else None
        if seen is None or shown is None:
            return False
        view, moment = seen
        self._looked = Looked(view, moment.verdicts, moment.graph, Reference(""), time)
        self._shown = msgspec.structs.replace(shown, live=False)
        return True

    @property
    def reactions(self) -> tuple[Reaction, ...]:
        """What the reference says is to be done, as of the newest look."""
        return self._looked.reference.reactions if self._looked is not None else ()

    def newest(self) -> bytes:
        """Return the newest snapshot as JSON; the same object while there is no newer one, empty before the first."""
        shown = self.state()
        if shown is not None and self._written[0] is not shown:
            # Written when it is asked for: pages that follow are told what changed of it.
            self._written = shown, msgspec.json.encode(shown)
        return self._written[1]

    def state(self) -> Snapshot | None:
        """Return the newest snapshot; None before the first."""
        self._asked = self._steady()
        return self._shown

    def detail(self, entity: str) -> bytes:
        """Return all that is known of an entity, as of the newest snapshot; empty where it is not there."""
        looked = self._looked
        if looked is None:
            return b""
        found = detail_of(entity, looked.view, looked.standing, self._clock(looked.time), self._clock)
        return msgspec.json.encode(found) if found is not None else b""

    @property
    def whole(self) -> Graph | None:
        """The computation graph as of the newest snapshot; None before the first."""
        return self._looked.graph if self._looked is not None else None

    def graph(self) -> bytes:
        """Return the computation graph as JSON, as of the newest snapshot; empty before the first."""
        looked = self._looked
        return graph_bytes(looked.graph) if looked is not None else b""

    def take(self, step: Step) -> None:
        """Remember what happened in a step."""
        self._happened.extend(self._of_step(step))
        self._failures.extend(shown_text(str(failure)) for failure in step.failures)

    def due(self) -> bool:
        """Return whether it is time for a new snapshot."""
        now = self._steady()
        pace = max(_PACE_S, min(self._took / _MOST_SHARE, _SLOWEST_S))
        return now - self._made >= (pace if now - self._asked < _WANTED_S else _IDLE_PACE_S)

    def make(self, session: Session, now: float, cost: str) -> None:
        """Make the snapshot of ``now``."""
        begun = self._steady()
        looked = _look(session, now)
        # One reference is replaced by another: a reader has the old snapshot or the new one, never half of each.
        self._shown = self._snapshot(looked, cost)
        self._looked = looked
        self._made = self._steady()
        self._took = self._made - begun

    def snapshot(self, session: Session, now: float, cost: str) -> Snapshot:
        """Return how the system stands at ``now``; ``cost`` says what watching it costs."""
        return self._snapshot(_look(session, now), cost)

    def _snapshot(self, looked: Looked, cost: str) -> Snapshot:
        found = document(
            looked.view,
            looked.standing,
            looked.graph,
            self._picture,
            time=looked.time,
            clock=self._clock,
            title=self._title,
            live=self._live,
            cost=cost,
            happened=sorted(self._happened, key=lambda one: one.time)[::-1],
            failures=tuple(reversed(self._failures)),
        )
        shown, muted = self.board.sorted(found.alerts, looked.time)
        return bounded(msgspec.structs.replace(found, alerts=shown, muted=muted))

    def _of_step(self, step: Step) -> Iterator[Happening]:
        yield from (event_line(one, self._clock) for one in step.events if told_of(one))
        yield from (verdict_line(one, self._clock) for one in step.changes)
        for one in step.causes:
            entity, name, when = shown_text(str(one.entity)), shown_name(one.entity.name), self._clock(one.time)
            detail = shown_text(f"because of {one.cause}" if one.cause else "because of nothing else")
            yield Happening(one.time, when, f"is still {one.state.value}", entity, name, one.state.value, detail)
        for note in step.notes:
            when, text = self._clock(note.time), shown_text(note.text)
            yield Happening(note.time, when, note.kind.value, "", "reference", "", text)


def _look(session: Session, now: float) -> Looked:
    """Return values that never change: who asks for details in another thread reads them while the next are made."""
    monitor = session.monitor
    return Looked(session.tree(now), monitor.standing(), session.graph(), monitor.reference, now)


def document(
    view: SystemView,
    standing: Sequence[Verdict],
    graph: Graph,
    picture: GraphPicture,
    *,
    time: float,
    clock: Callable[[float], str],
    title: str,
    live: bool,
    cost: str,
    happened: Iterable[Happening],
    failures: tuple[str, ...] = (),
) -> Snapshot:
    """Return a system at one instant as the live page shows it, be it now or once."""
    rows = tuple(_rows(view.children, 0, ""))
    return Snapshot(
        version=VERSION,
        time=time,
        when=clock(time),
        title=shown_name(title),
        live=live,
        state=view.worst.value if view.worst else UNJUDGED,
        counts=view.counts,
        unjudged=not_judged(view),
        cost=cost,
        columns=tuple(column for column in COLUMNS if any(column[0] in row.shown for row in rows)),
        rows=rows,
        alerts=_alerts(standing, clock),
        causes=causes_of(standing, shown_text),
        picture=picture.of(graph, rows, standing),
        happened=tuple(happened),
        failures=failures,
    )


def bounded(found: Snapshot) -> Snapshot:
    """Return a snapshot with the first alerts of very many, and how many there are."""
    follow = sum(len(one.follows) for one in found.alerts)
    alerts = (
        msgspec.structs.replace(one, follows=one.follows[:MOST_ALERTS]) if len(one.follows) > MOST_ALERTS else one
        for one in found.alerts[:MOST_ALERTS]
    )
    return msgspec.structs.replace(found, alerts=tuple(alerts), wrong=len(found.alerts), follow=follow)


def told_of(event: Event) -> bool:
    """Whether to tell an event: programs come and go all the time; of those that hold nodes the nodes tell it."""
    return not (event.entity.startswith(_PROCESS) and event.change in (Change.APPEARED, Change.VANISHED))


def event_line(event: Event, clock: Callable[[float], str]) -> Happening:
    """Return a change of the graph as the page tells it."""
    text = shown_text(event.entity)
    what, detail = event.change.value, shown_text(event.detail)
    return Happening(event.time, clock(event.time), what, text, text.partition(":")[2], "", detail)


def verdict_line(one: Verdict, clock: Callable[[float], str]) -> Happening:
    """Return a change of a verdict as the page tells it."""
    entity = shown_text(str(one.entity))
    detail = shown_text(sentence(one)) if one.state.bad or one.of_observer else _title(one.quantity)
    name = shown_name(one.entity.name)
    return Happening(one.since, clock(one.since), f"is {one.state.value}", entity, name, one.state.value, detail)


def shown_name(name: str) -> str:
    """Return a name from outside as text that can be encoded, and short enough to show."""
    return _cut(name, _LONGEST_NAME)


def shown_text(text: str) -> str:
    """Return a text from outside as text that can be encoded, and short enough to show."""
    return _cut(text, _LONGEST_TEXT)


def _cut(text: str, longest: int) -> str:
    if len(text) > longest:
        text = f"{text[: longest * 2 // 3]}…{text[-(longest // 3) :]}"
    return encodable(text)


def _rows(parts: Iterable[SystemView], depth: int, above: str) -> Iterator[Row]:
    for part in parts:
        if not worth_a_row(part):
            continue
        key = _key(above, part.id)
        values = {name: value for name, value in part.values.items() if math.isfinite(value)}
        shown = {name: _shown(name, float(f"{values[name]:.3g}")) for name, _ in COLUMNS if name in values}
        yield Row(
            key,
            encodable(part.id),
            _name(part),
            part.kind,
            depth,
            part.state.value if part.state else UNJUDGED,
            part.counts,
            values,
            shown,
            part.observer,
            part.worst.value if part.worst else UNJUDGED,
            badge(part),
        )
        yield from _rows(part.children, depth + 1, key)


@lru_cache(maxsize=65536)
def _key(above: str, entity: str) -> str:
    return blake2b(f"{above}\0{entity}".encode("utf-8", "replace"), digest_size=6).hexdigest()


@lru_cache(maxsize=65536)
def _shown(key: str, value: float) -> str:
    return value_text(key, value)


def _name(part: SystemView) -> str:
    if not part.name:
        return nameless(part)
    if part.kind == "connection":
        _, _, subscriber = ends_of(part.id)
        return f"→ {shown_name(subscriber) or 'anybody'}"
    return shown_name(part.name)


def _title(quantity: str) -> str:
    signal = BY_KEY.get(quantity)
    return signal.title.lower() if signal else quantity


def _alerts(verdicts: Sequence[Verdict], clock: Callable[[float], str]) -> tuple[Alert, ...]:
    """Return the first causes, latest last, each with what follows from it."""
    silent = {str(one.entity) for one in verdicts if one.of_observer}
    shown = (one for one in verdicts if one.wrong or one.cause in silent)
    bad = sorted(shown, key=urgency)
    causes = {str(one.entity): place for place, one in reversed(list(enumerate(bad))) if not one.cause}
    followers: dict[int, list[Alert]] = {}
    firsts = []
    for place, one in enumerate(bad):
        cause = causes.get(one.cause) if one.cause else None
        if cause is None:
            firsts.append(place)
        else:
            followers.setdefault(cause, []).append(_alert(one, clock, ()))
    return tuple(_alert(bad[place], clock, tuple(followers.get(place, ()))) for place in firsts)


def _alert(one: Verdict, clock: Callable[[float], str], follows: tuple[Alert, ...]) -> Alert:
    entity = str(one.entity)
    name = one.entity.name
    if one.entity.kind is EntityKind.CONNECTION:
        topic, publisher, subscriber = ends_of(entity)
        name = f"{publisher or '?'} → {topic} → {subscriber or 'anybody'}"
    return Alert(
        key=_key(entity, one.expectation),
        entity=encodable(entity),
        name=shown_name(name),
        kind=one.entity.kind.value,
        state=one.state.value,
        # What an error follows from matters as much as the error.
        severity=max([one.severity.value, *(other.severity for other in follows)], key=_GRAVITY.__getitem__),
        sentence=shown_text(sentence(msgspec.structs.replace(one, cause=""))),
        since=one.since,
        when=clock(one.since),
        cause=encodable(one.cause),
        group=shown_name(one.group),
        where=shown_text(one.where),
        evidence=shown_text(one.evidence),
        follows=follows,
    )

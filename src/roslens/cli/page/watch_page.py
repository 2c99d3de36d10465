"""What `roslens watch --serve` shows: a session as the document of the live page."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Collection, Iterator
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.page.board_page import BoardPage, Looked
from roslens.cli.page.page_document import bounded, document, event_line, reported_of, verdict_line
from roslens.cli.page.past_page import PastPage
from roslens.cli.page.row_list import RowList, shown_name, shown_text
from roslens.cli.page.topics_seen import topics_seen
from roslens.cli.page.watch_detail import detail_of
from roslens.cli.page.watch_graph import GraphPicture
from roslens.cli.page.why_page import WhyPage
from roslens.dashboard.live.sight import Seen, Sight
from roslens.dashboard.live.snapshot import Happening, Snapshot
from roslens.judge.reference.expectation import Reference
from roslens.live.publish.graph_json import graph_bytes
from roslens.model.graph import Graph
from roslens.store.handled import HandledAlerts

if TYPE_CHECKING:
    from roslens.dashboard.computation.picture import Grounds
    from roslens.live.join.session import Session, Step
    from roslens.model.acting.reaction import Reaction
    from roslens.store.past.recall import Recall

_PACE_S = 0.25
_IDLE_PACE_S = 5.0
_WANTED_S = 5.0
_MOST_SHARE = 0.08
_SLOWEST_S = 4.0
"""A large system is shown more slowly, so that showing it costs no more than this share of the time."""
_SAVED_S = _PACE_S * _MOST_SHARE
_KEPT = 50
_PICTURE_S = 10.0
"""A picture that nobody sees is drawn again after so long, for who comes next."""


class PageSource:
    """Makes a snapshot of a session when one is due, and hands it to the page as bytes.

    Snapshots are made by who runs the session; :meth:`newest` may be called from any thread. While nobody asks for
    them they are made less often. While all who read say what they see, only values of that are of the present, and
    others at most as old as a round (:data:`roslens.live.rate.glance.ROUND_S`); states always are.

    Attributes:
        sight: what readers see.
        past: of what is shown; None where nothing is kept.
        board: its references, and notes on its alerts.
        why: answers why something of it is as it is.
    """

    def __init__(
        self, title: str, *, clock: Callable[[float], str], live: bool, steady: Callable[[], float],
        recorded: bool | None = None, handled: HandledAlerts | None = None,
        spent: Callable[[], float] | None = None,
    ) -> None:  # fmt: skip
        """Show what is called ``title``.

        Args:
            title: of what is watched.
            clock: writes times.
            live: whether more will come.
            recorded: whether it is a recording, which names no hosts; by default what is not live is one.
            steady: a monotonic clock.
            spent: returns the processor time used, in seconds; by default that of ``steady``.
            handled: stores notes on alerts; by default as long as the page lasts.
        """
        self._title = title
        self._clock = clock
        self._live = live
        self._recorded = not live if recorded is None else recorded
        self._steady = steady
        self._spent = spent or steady
        self._picture = GraphPicture(shown_name)
        self._rows = RowList()
        self._drawn = -math.inf
        self._seen: tuple[tuple[Seen, object, int], frozenset[str]] | None = None
        self.sight = Sight(steady)
        self._happened: deque[Happening] = deque(maxlen=_KEPT)
        self._failures: deque[str] = deque(maxlen=_KEPT)
        self._asked = -math.inf
        self._begun = -math.inf
        self._next = -math.inf
        self._debt = 0.0
        self._shown: Snapshot | None = None
        self._written: tuple[Snapshot | None, bytes] = (None, b"")
        self._looked: Looked | None = None
        self._recall: Recall | None = None
        self.past: PastPage | None = None
        self.why = WhyPage(lambda: self._looked, steady=steady, live=live)
        self.board = BoardPage(lambda: self._looked, lambda: self._recall, handled or HandledAlerts(None), clock)

    def draw_on(self, grounds: Callable[[Collection[str]], Grounds | None]) -> None:
        """Draw everything where its source has it, as far as ``grounds`` knows that."""
        self._picture = GraphPicture(shown_name, grounds)

    def remember(self, recall: Recall) -> None:
        """Show the past from a history, too."""
        self._recall = recall
        self.past = PastPage(
            recall, self._title, clock=self._clock, picture=lambda: self._picture, live=self._live,
            recorded=self._recorded,
        )  # fmt: skip

    def end_at(self, time: float) -> bool:
        """Show how it stood at ``time``, from what is remembered; return whether something is known of then."""
        seen = self.past.seen(time) if self.past is not None else None
        shown = self.past.document(time) if self.past is not None else None
        if seen is None or shown is None:
            return False
        view, moment = seen
        self._looked = Looked(view, moment.verdicts, moment.graph, Reference(""), time)
        self._shown = shown
        return True

    @property
    def reactions(self) -> tuple[Reaction, ...] | None:
        """What the reference says is to be done, as of the newest look; None where no document was given."""
        reference = self._looked.reference if self._looked is not None else None
        return reference.reactions if reference is not None and reference.documents else None

    def newest(self) -> bytes:
        """Return the newest snapshot as JSON; the same object while there is no newer one, empty before the first."""
        shown = self.state()
        if shown is not None and self._written[0] is not shown:
            # Written when it is asked for: pages that follow get what changed of it.
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
    def looked(self) -> Looked | None:
        """The newest look at the system; None before the first."""
        return self._looked

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
        self.why.take(step)
        self._happened.extend(self._of_step(step))
        self._failures.extend(shown_text(str(failure)) for failure in step.failures)

    def due(self) -> bool:
        """Return whether it is time for a new snapshot."""
        now = self._steady()
        since = now - self._begun
        if now - self._asked >= _WANTED_S:
            return since >= _IDLE_PACE_S
        return now >= self._next and (self._debt <= since * _MOST_SHARE or since >= _SLOWEST_S)

    def make(self, session: Session, now: float, cost: str) -> None:
        """Make the snapshot of ``now``."""
        begun, spent = self._steady(), self._spent()
        self._debt -= min(begun - self._begun, _SLOWEST_S) * _MOST_SHARE
        # Who runs the session comes as often as the pace, not quite evenly: one that came late makes the next no later.
        late = max(begun - self._next, 0.0)
        self._next = begun + _PACE_S if late >= _PACE_S else begun + max(_PACE_S - late, _PACE_S / 2)
        self._begun = begun
        # Of what ended nothing newer will come.
        seen = self.sight.seen() if self._live else None
        looked = _look(session, now, self._topics(seen))
        draw = seen is None or seen.picture or begun - self._drawn >= _PICTURE_S
        if draw:
            self._drawn = begun
        # One reference is replaced by another: a reader has the old snapshot or the new one, never half of each.
        found = self._snapshot(looked, cost, draw=draw)
        self._looked = looked
        self._shown = msgspec.structs.replace(found, alerts=self.why.told(found.alerts))
        # What was not used is kept for one snapshot: the more of them, the less there is to do for each.
        # What the slowest pace leaves over is forgiven: who asked for everything once does not pay for it for long.
        self._debt = max(min(self._debt, 0.0), -_SAVED_S) + self._spent() - spent

    def _topics(self, seen: Seen | None) -> frozenset[str] | None:
        """Return which topics are seen; None where that is everything."""
        if seen is None:
            return None
        mark = seen, self._rows.order, self._shown.picture.version if self._shown is not None else 0
        if self._seen is None or self._seen[0] != mark:
            self._seen = mark, topics_seen(seen, self._shown)
        return self._seen[1]

    def snapshot(self, session: Session, now: float, cost: str) -> Snapshot:
        """Return how the system stands at ``now``; ``cost`` says what watching it costs."""
        return self._snapshot(_look(session, now, None), cost, draw=True)

    def _snapshot(self, looked: Looked, cost: str, *, draw: bool) -> Snapshot:
        found = document(
            looked.view,
            looked.standing,
            looked.graph,
            self._picture,
            time=looked.time,
            clock=self._clock,
            title=self._title,
            live=self._live,
            recorded=self._recorded,
            cost=cost,
            happened=sorted(self._happened, key=lambda one: one.time)[::-1],
            failures=tuple(reversed(self._failures)),
            row_list=self._rows,
            drawn=None if draw or self._shown is None else self._shown.picture,
        )
        shown, muted = self.board.sorted(found.alerts, looked.time)
        return bounded(msgspec.structs.replace(found, alerts=shown, muted=muted))

    def _of_step(self, step: Step) -> Iterator[Happening]:
        yield from (event_line(one, self._clock) for one in step.events if reported_of(one))
        yield from (verdict_line(one, self._clock) for one in step.changes)
        for one in step.causes:
            entity, name, when = shown_text(str(one.entity)), shown_name(one.entity.name), self._clock(one.time)
            detail = shown_text(f"because of {one.cause}" if one.cause else "because of nothing else")
            yield Happening(one.time, when, f"is still {one.state.value}", entity, name, one.state.value, detail)
        for note in step.notes:
            when, text = self._clock(note.time), shown_text(note.text)
            yield Happening(note.time, when, note.kind.value, "", "reference", "", text)


def _look(session: Session, now: float, topics: Collection[str] | None) -> Looked:
    """Return values that never change: who asks for details in another thread reads them while the next are made.

    Those of ``topics`` are of the present, or all of them.
    """
    monitor = session.monitor
    if topics is None:
        view, standing = session.tree(now), monitor.standing()
    else:
        view, standing = session.glance(now, topics)
    return Looked(view, standing, session.graph(), monitor.reference, now)

"""The past of a watch as the live page shows it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from threading import Lock
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.page.page_document import bounded, document, event_line, reported_of, verdict_line
from roslens.cli.page.row_list import shown_name, shown_text
from roslens.cli.page.watch_detail import detail_of, limits_of
from roslens.cli.page.watch_graph import GraphPicture, PastPicture
from roslens.cli.page.watch_screen import value_text
from roslens.dashboard.live.past import Changed, Compared, Mark, Plots, Series, Timeline
from roslens.dashboard.live.snapshot import UNJUDGED, Row, Snapshot
from roslens.live.past.then import tree_then
from roslens.live.window.signals import BY_KEY
from roslens.model.verdict import State, Verdict
from roslens.store.past.stretch import Piece, gaps

if TYPE_CHECKING:
    from roslens.live.system.tree import SystemView
    from roslens.store.past.moment import Moment
    from roslens.store.past.recall import Recall

FOREMOST: Mapping[str, str] = {
    "topic": "rate", "connection": "rate", "host": "cpu", "node": "cpu", "process": "cpu", "service": "calls",
}  # fmt: skip
"""By kind of entity the signal that stands for it where there is room for one line."""
MOST_POINTS = 900
MOST_CHANGED = 500
_SPARK_S = 120.0
_SPARK_POINTS = 60
_KEPT = 50
_LEAST_CHANGE = 0.1
"""Share by which a value must have changed to be worth telling."""
_WORSE = {state: place for place, state in enumerate((UNJUDGED, *(state.value for state in State)))}


class PastPage:
    """Answers from one history; may be asked from any thread."""

    def __init__(
        self, recall: Recall, title: str, *, clock: Callable[[float], str], picture: Callable[[], GraphPicture],
        live: bool, recorded: bool,
    ) -> None:  # fmt: skip
        """Show what is called ``title``.

        Args:
            recall: the history.
            title: of what is shown.
            clock: writes times.
            picture: gives the one whose places are kept to.
            live: whether more will come after what is kept.
            recorded: whether it is a recording, which names no hosts.
        """
        self._recall = recall
        self._title = title
        self._clock = clock
        self._live, self._recorded = live, recorded
        self._drawn = PastPicture(shown_name, picture)
        self._lock = Lock()

    def snapshot(self, at: float) -> bytes:
        """Return how it was; see :class:`roslens.dashboard.live.past.Past`."""
        found = self.document(at)
        return msgspec.json.encode(found) if found is not None else b""

    def detail(self, entity: str, at: float) -> bytes:
        """Return what was known of an entity."""
        seen = self.seen(at)
        if seen is None:
            return b""
        view, moment = seen
        found = detail_of(entity, view, moment.verdicts, self._clock(at), self._clock)
        return msgspec.json.encode(found) if found is not None else b""

    def plots(self, entity: str, since: float, until: float, most: int) -> Plots:
        """Return all signals of an entity, those that are judged first."""
        most = min(max(most, 10), MOST_POINTS)
        moment = self._recall.moment(until)
        limits: dict[str, Verdict] = {}
        for one in moment.verdicts if moment is not None else ():
            if str(one.entity) == entity and one.quantity in BY_KEY:
                limits.setdefault(one.quantity, one)
        found = self._recall.stretches(entity, since, until, most)
        order = sorted((key for key in found if key in BY_KEY), key=lambda key: (key not in limits, _PLACE[key]))
        series = tuple(_series(key, found[key], limits.get(key)) for key in order)
        return Plots(entity, since, until, series)

    def sparks(self, entities: tuple[str, ...], until: float) -> dict[str, tuple[float | None, ...]]:
        """Return by entity how its foremost signal went, as shares of the largest value of the stretch."""
        found = {}
        for entity in entities:
            key = FOREMOST.get(entity.partition(":")[0])
            if key is None:
                continue
            stretches = self._recall.stretches(entity, until - _SPARK_S, until, int(_SPARK_S), (key,))
            if key in stretches:
                found[entity] = _spark(stretches[key], until)
        return found

    def timeline(self, since: float, until: float) -> Timeline | None:
        """Return what happened; without a stretch (``until`` 0) in all that is kept."""
        span = self._recall.span()
        if span is None:
            return None
        since, until = (since, until) if until > since else span
        marks = (
            Mark(
                one.time,
                self._clock(one.time).strip(),
                one.kind,
                shown_text(one.entity),
                shown_name(one.entity.partition(":")[2]),
                shown_text(one.detail),
                one.count,
            )
            for one in self._recall.marks(since, until)
        )
        return Timeline(*span, since, until, tuple(marks))

    def compared(self, since: float, until: float) -> Compared | None:
        """Return what is not the same at two moments."""
        before, after = self.document(since), self.document(until)
        if before is None or after is None:
            return None
        old, new = _by_entity(before), _by_entity(after)
        changed = [one for entity in sorted({*old, *new}) if (one := _changed(old.get(entity), new.get(entity)))]
        changed.sort(key=_calm)
        shown = tuple(changed[:MOST_CHANGED])
        same = len({*old, *new}) - len(changed)
        return Compared(since, until, (before.when, after.when), shown, same, len(changed) - len(shown))

    def seen(self, at: float) -> tuple[SystemView, Moment] | None:
        """Return how everything stood, and what was kept of that; None where nothing was."""
        if not math.isfinite(at) or (moment := self._recall.moment(at)) is None:
            return None
        return tree_then(moment, self._recall.values(at)), moment

    def document(self, at: float) -> Snapshot | None:
        """Return how it was as the live page shows it; None where nothing is kept of then."""
        seen = self.seen(at)
        if seen is None:
            return None
        view, moment = seen
        events, verdicts = self._recall.happened(at, _KEPT)
        lines = [event_line(one, self._clock) for one in events if reported_of(one)]
        lines += [verdict_line(one, self._clock) for one in verdicts]
        with self._lock:
            found = document(
                view,
                moment.verdicts,
                moment.graph,
                self._drawn,
                time=at,
                clock=self._clock,
                title=self._title,
                live=self._live,
                recorded=self._recorded,
                cost="",
                happened=sorted(lines, key=lambda one: -one.time)[:_KEPT],
            )
        return bounded(found)


_PLACE = {key: place for place, key in enumerate(BY_KEY)}


def _series(key: str, found: tuple[Piece, ...], judged: Verdict | None) -> Series:
    times: list[float] = []
    columns: tuple[list[float | None], ...] = ([], [], [])
    missing = set(gaps(found))
    for place, one in enumerate(found):
        if place in missing:
            before = found[place - 1]
            times.append((before.time + before.seconds + one.time) / 2)
            for column in columns:
                column.append(None)
        times.append(one.time + one.seconds / 2)
        for column, value in zip(columns, (one.mean, one.least, one.greatest), strict=True):
            column.append(_rounded(value))
    low, high = limits_of(judged) if judged is not None else (None, None)
    signal = BY_KEY[key]
    expected = shown_text(judged.range) if judged is not None else ""
    values, least, greatest = map(tuple, columns)
    return Series(key, signal.title, signal.unit, tuple(times), values, least, greatest, low, high, expected)


def _rounded(value: float) -> float:
    return float(f"{value:.6g}")


def _spark(found: tuple[Piece, ...], until: float) -> tuple[float | None, ...]:
    slots: list[float | None] = [None] * _SPARK_POINTS
    width = _SPARK_S / _SPARK_POINTS
    for one in found:
        first = int((one.time - (until - _SPARK_S)) / width)
        for place in range(max(first, 0), min(first + max(int(one.seconds / width), 1), _SPARK_POINTS)):
            slots[place] = one.mean
    most = max((value for value in slots if value is not None), default=0.0)
    return tuple(None if value is None else round(value / most, 3) if most > 0 else 0.0 for value in slots)


def _calm(one: Changed) -> int:
    """Return the more the less grave it is: states before values, bad ones before others."""
    if one.before == one.after:
        return 1
    return -max(_WORSE.get(one.before, 0), _WORSE.get(one.after, 0))


def _by_entity(shown: Snapshot) -> dict[str, Row]:
    found: dict[str, Row] = {}
    for row in shown.rows:
        found.setdefault(row.entity, row)
    return found


def _changed(before: Row | None, after: Row | None) -> Changed | None:
    row = after or before
    if row is None:
        return None
    values = []
    for key in BY_KEY:
        old = before.values.get(key) if before is not None else None
        new = after.values.get(key) if after is not None else None
        if old is None or new is None or abs(new - old) <= _LEAST_CHANGE * max(abs(old), abs(new)):
            continue
        values.append((BY_KEY[key].title, value_text(key, float(f"{old:.3g}")), value_text(key, float(f"{new:.3g}"))))
    states = before.state if before is not None else "", after.state if after is not None else ""
    if states[0] == states[1] and not values:
        return None
    name = row.entity.partition(":")[2] if row.kind == "connection" else row.name
    return Changed(row.entity, shown_name(name), row.kind, *states, tuple(values))

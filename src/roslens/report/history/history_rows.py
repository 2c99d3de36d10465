"""What was kept of a live system as tables: one row a point, a change of a verdict, an event."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import msgspec

from roslens.model.graph import Event
from roslens.model.verdict import Verdict
from roslens.report.writing.csv_table import Table
from roslens.store.live.read_history import Kept


class Extract(msgspec.Struct, frozen=True):
    """What was asked for of one file.

    Attributes:
        path: of the file.
        begin: seconds since the epoch from which its times count: when the first of all that it keeps was.
        since: beginning of the stretch that was asked for.
        until: its end.
        series: of values.
        verdicts: that changed.
        events: of the graph.
    """

    path: Path
    begin: float
    since: float
    until: float
    series: tuple[Kept, ...]
    verdicts: tuple[Verdict, ...]
    events: tuple[Event, ...]


def series_table(extracts: Iterable[Extract], units: Mapping[str, str]) -> Table:
    """Return points: ``seconds`` is how long each is, ``at`` counts from the beginning of its file."""
    head = ("file", "entity", "signal", "unit", "time", "at", "seconds", "count", "mean", "least", "greatest")
    return head, _points(extracts, units)


def verdicts_table(extracts: Iterable[Extract]) -> Table:
    """Return changes of verdicts; ``since`` is when the state began."""
    head = (
        "file", "entity", "signal", "time", "at", "state", "since", "value", "range", "severity", "expectation",
        "evidence", "cause", "text",
    )  # fmt: skip
    return head, (
        (
            str(one.path), str(verdict.entity), verdict.quantity, verdict.time, verdict.time - one.begin,
            verdict.state.value, verdict.since, verdict.value, verdict.range, verdict.severity.value,
            verdict.expectation, verdict.evidence, verdict.cause, verdict.text,
        )
        for one in extracts
        for verdict in one.verdicts
    )  # fmt: skip


def events_table(extracts: Iterable[Extract]) -> Table:
    """Return events of the graph."""
    return ("file", "entity", "time", "at", "change", "detail"), (
        (str(one.path), event.entity, event.time, event.time - one.begin, event.change.value, event.detail)
        for one in extracts
        for event in one.events
    )


def _points(extracts: Iterable[Extract], units: Mapping[str, str]) -> Iterator[tuple[str | int | float | None, ...]]:
    for one in extracts:
        for kept in one.series:
            unit = units.get(kept.signal, "")
            for seconds, point in kept.points:
                yield (
                    str(one.path), kept.entity, kept.signal, unit, point.time, point.time - one.begin, seconds,
                    point.count, point.mean, point.least, point.greatest,
                )  # fmt: skip

"""The history: how the main quantities went over past revisions, and which two of them to compare."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.charts.figures import number
from roslens.dashboard.charts.line_chart import LineChart, day, line_chart
from roslens.dashboard.past import Past
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.dashboard.view import Request, View
from roslens.model.trend import Trend, TrendPoint

MAIN = ("findings", "loc", "cyclomatic_complexity.max", "duplication_ratio", "revisions", "contributors")
"""Quantities whose curves are shown at once."""

_LARGE = 1000
"""Of values as large as this nobody reads what is behind the point."""

WHOLE = {
    "sum": "all packages",
    "median": "median of the packages",
    "repository": "the repository",
    "repository_sum": "all repositories",
    "repository_median": "median of the repositories",
}


def build(site: Site, request: Request) -> View | None:
    """Return the page."""
    past = site.past
    if past is None:
        return View(ref=PageRef("history"), title="History", facts={"points": []}, shown={"charts": [], "past": None})
    charts = [
        (key, trend, chart)
        for key in MAIN
        if (trend := past.known(key)) is not None and (chart := whole_chart(trend)) is not None
    ]
    release = past.last_release
    return View(
        ref=PageRef("history", query=request.query.pairs),
        title="History",
        facts={
            "points": [
                {"commit": one.commit, "time_s": one.time_s, "name": one.name, "run": one.run} for one in past.points
            ],
        },
        tables=(_revisions(past, request), _keys(past)),
        shown={
            "past": past,
            "charts": charts,
            "whole": WHOLE,
            "span": f"{past.points[0].name} ({day(past.points[0])}) to {past.points[-1].name} ({day(past.points[-1])})",
            "options": options(past),
            "before": past.points[release if release is not None else 0].commit,
            "after": past.points[-1].commit,
        },
    )


def options(past: Past) -> list[tuple[str, str]]:
    """Return the revisions to choose from, the newest first: commit and text."""
    return [
        (one.commit, one.name if one.name.startswith(day(one)) else f"{one.name}, {day(one)}")
        for one in reversed(past.points)
    ]


def revision_of(point: TrendPoint) -> str:
    """Return what a table calls a point beside its day."""
    return point.commit[:10] if point.name.startswith(day(point)) else point.name


def whole_chart(trend: Trend) -> LineChart | None:
    """Return the curve of all packages together."""
    return line_chart(trend.points, [(WHOLE[trend.whole_is], trend.whole)], trend.events, digits_of(trend))


def digits_of(trend: Trend) -> int:
    """Return how many digits behind the point the values of a trend need."""
    values = [one for column in (trend.whole, *trend.packages.values()) for one in column if one is not None]
    whole = all(one == int(one) for one in values)
    return 0 if whole or max(map(abs, values), default=0.0) >= _LARGE else 2


def _revisions(past: Past, request: Request) -> Table:
    """The revisions, the newest first, each with what it came with."""
    events: dict[int, list[str]] = {}
    for one in past.events:
        events.setdefault(one.point, []).append(one.text if one.kind == "release" else f"{one.kind}: {one.text}")
    rows = []
    for place in range(len(past.points) - 1, -1, -1):
        point = past.points[place]
        findings, change, loc = _counts(past, place)
        rows.append(
            (
                Cell(day(point)),
                Cell(revision_of(point), ref=_compared(past, place) if request.medium == "served" else None),
                Cell(", ".join(events.get(place, ()))),
                Cell(findings),
                Cell(change, text=f"{change:+,.0f}" if change else ""),
                Cell(loc),
            )
        )
    limit = len(rows) if request.complete else request.limits.rows
    columns = (
        Column("date", "Date", "day"),
        Column("revision", "Revision", "code"),
        Column("events", "Events"),
        Column("findings", "Findings", "number", bar=True),
        Column("change", "Change", "number"),
        Column("loc", "Code lines", "number", optional=True),
    )
    return Table("revisions", "Revisions", columns, tuple(rows[:limit]), total=len(rows))


def _counts(past: Past, place: int) -> tuple[float | None, float | None, float | None]:
    """Return the findings of a revision, how many more than before, and its lines of code, as far as known."""
    of_findings, of_loc = past.known("findings"), past.known("loc")
    findings = of_findings.whole[place] if of_findings is not None else None
    before = of_findings.whole[place - 1] if place and of_findings is not None else None
    change = findings - before if findings is not None and before is not None else None
    return findings, change, of_loc.whole[place] if of_loc is not None else None


def _compared(past: Past, place: int) -> PageRef | None:
    """Return the page of what a revision changed; None of the first one."""
    if not place:
        return None
    return PageRef(
        "difference", query=(("before", past.points[place - 1].commit), ("after", past.points[place].commit))
    )


def _keys(past: Past) -> Table:
    rows = []
    for key in past.keys:
        trend = past.trend(key)
        known = [one for one in trend.whole if one is not None]
        if known:
            # Each row is of another quantity: what all its values need is what it is shown with.
            digits = digits_of(trend)
            rows.append(
                (
                    Cell(key, text=trend.title, ref=PageRef("trend", key), hint=key),
                    Cell(known[0], text=number(known[0], digits)),
                    Cell(known[-1], text=number(known[-1], digits)),
                    Cell(WHOLE[trend.whole_is]),
                )
            )
    columns = (
        Column("quantity", "Quantity"),
        Column("first", "First", "number", decimals=2),
        Column("last", "Last", "number", decimals=2),
        Column("of", "Of", optional=True),
    )
    return Table("quantities", "Everything that can be followed", columns, tuple(rows), total=len(rows))

"""What is different between two revisions: findings that are new, resolved or moved, packages and values."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.compare.run_difference import RunDifference
from roslens.dashboard.address import PageRef
from roslens.dashboard.charts.line_chart import day
from roslens.dashboard.pages.history import options
from roslens.dashboard.past import Past
from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_list import file_ref
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.dashboard.view import Request, View
from roslens.model.finding import Finding
from roslens.report.run.fix_first import by_urgency

SHOWN = ("loc", "functions", "cyclomatic_complexity.max", "cognitive_complexity.max", "duplication_ratio", "rqv", "rcv")


def build(site: Site, request: Request) -> View | None:
    """Return the page; where nothing else is asked, what is different since the last release."""
    past = site.past
    if past is None or len(past.points) < 2:
        return View(ref=PageRef("difference"), title="Difference", facts={}, shown={"found": None})
    before = past.place_of(request.query.get("before"))
    after = past.place_of(request.query.get("after"))
    after = len(past.points) - 1 if after is None else after
    if before is None:
        release = past.last_release
        before = release if release is not None and release < after else max(0, after - 1)
    before, after = min(before, after), max(before, after)
    found = past.difference(before, after)
    first, last = past.points[before], past.points[after]
    limit = None if request.complete else request.limits.findings
    return View(
        ref=PageRef("difference", query=request.query.pairs),
        title=f"{first.name} to {last.name}",
        facts={
            "before": {"commit": first.commit, "name": first.name},
            "after": {"commit": last.commit, "name": last.name},
            "added": list(found.added),
            "removed": list(found.removed),
            "moved_packages": [
                {"package": one.package, "was_in": one.before, "path": one.after} for one in found.moved
            ],
        },
        tables=(
            _findings(site, past, "new", "New", found.findings.new, limit, last=after),
            _findings(site, past, "resolved", "Resolved", found.findings.gone, limit, last=-1),
            _moved(found, limit),
            _values(past, found),
        ),
        shown={
            "found": found,
            "first": first,
            "last": last,
            "day": day,
            "options": options(past),
            "turned": request.query.get("before") and past.place_of(request.query.get("before")) == after != before,
        },
    )


def _findings(
    site: Site, past: Past, name: str, title: str, found: Sequence[Finding], limit: int | None, *, last: int
) -> Table:
    ordered = by_urgency(found)
    here = last == len(past.points) - 1
    rows = tuple(
        (
            Cell(one.severity.value),
            Cell(one.message),
            Cell(
                f"{one.path}:{one.line}" if one.line else one.path or one.entity,
                # Lines of another revision are not those of the file that is shown.
                ref=file_ref(site, one.path, one.line) if here and one.path else None,
            ),
            Cell(one.rule, ref=PageRef("rule", one.rule) if one.rule in site.rules else None),
        )
        for one in ordered[:limit]
    )
    columns = (
        Column("severity", "Severity", "mark"),
        Column("message", "Finding", "prose"),
        Column("place", "Place", "code"),
        Column("rule", "Rule", optional=True),
    )
    return Table(name, title, columns, rows, total=len(ordered), empty="None.")


def _moved(found: RunDifference, limit: int | None) -> Table:
    rows = tuple(
        (Cell(one.after.severity.value), Cell(one.after.message), Cell(one.before.path), Cell(one.after.path))
        for one in found.findings.moved[:limit]
    )
    columns = (
        Column("severity", "Severity", "mark"),
        Column("message", "Finding", "prose"),
        Column("from", "Was in", "code"),
        Column("to", "Is in", "code"),
    )
    return Table("moved", "Moved to another file", columns, rows, total=len(found.findings.moved), empty="None.")


def _values(past: Past, found: RunDifference) -> Table:
    trends = {key: past.known(key) for key in SHOWN}
    titles = {key: trend.title for key, trend in trends.items() if trend is not None}
    rows = []
    for one in found.values:
        before, after = _text(one.before), _text(one.after)
        if one.quantity in SHOWN and before != after:
            change = one.after - one.before if one.after is not None and one.before is not None else None
            rows.append(
                (
                    Cell(one.package, ref=PageRef("package", one.package)),
                    Cell(
                        one.quantity,
                        text=titles.get(one.quantity, one.quantity),
                        hint=one.quantity,
                        ref=PageRef("trend", one.quantity),
                    ),
                    Cell(one.before, text=before),
                    Cell(one.after, text=after),
                    Cell(change, text="" if change is None else f"{'+' if change > 0 else ''}{_text(change)}"),
                )
            )
    columns = (
        Column("package", "Package"),
        Column("quantity", "Quantity"),
        Column("before", "Before", "number"),
        Column("after", "After", "number"),
        Column("change", "Change", "number"),
    )
    return Table("values", "Values that changed", columns, tuple(rows), total=len(rows), empty="None.")


def _text(value: float | None) -> str:
    if value is None:
        return ""
    return f"{value:,.0f}" if value == int(value) else f"{value:,.2f}"

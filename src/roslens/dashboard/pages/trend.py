"""One quantity over past revisions: a curve of the whole and of the packages that changed most, and each value."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.charts.line_chart import day, line_chart
from roslens.dashboard.pages.history import WHOLE, digits_of, options, revision_of
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.dashboard.view import Request, View
from roslens.model.trend import Trend

CURVES = 5
_NOW = "now"
"""The name of the point that is the files as they are."""


def build(site: Site, request: Request) -> View | None:
    """Return the page; None for a quantity that was measured in no revision."""
    past = site.past
    trend = past.known(request.key) if past is not None else None
    if past is None or trend is None:
        return None
    digits = digits_of(trend)
    asked = [name for name in request.query.all("package") if name in trend.packages]
    names = asked or sorted(trend.packages, key=lambda name: (-_span(trend, name), name))[:CURVES]
    columns = [] if asked else [(WHOLE[trend.whole_is], trend.whole)]
    # The sum of all packages would press the curves of single ones flat.
    apart = trend.whole_is != "median" and not asked and len(trend.packages) > 1
    own = [(name, trend.packages[name]) for name in names]
    whole, single = WHOLE[trend.whole_is].capitalize(), "The packages that changed most" if not asked else "Packages"
    groups = [(whole, columns), (single, own)] if apart else [("" if columns else single, [*columns, *own])]
    drawn = [
        (heading, chart)
        for heading, group in groups
        if (chart := line_chart(past.points, group, past.events, digits)) is not None
    ]
    return View(
        ref=PageRef("trend", request.key, query=request.query.pairs),
        title=trend.title,
        facts={"quantity": trend.quantity, "unit": trend.unit, "whole_is": trend.whole_is},
        tables=(_values(trend, names if not request.complete else list(trend.packages), digits),),
        shown={
            "trend": trend,
            "charts": drawn,
            "names": sorted(trend.packages),
            "asked": asked,
            "measured_now": past.points[-1].name != _NOW or trend.whole[-1] is not None,
            "commits": [one.commit for one in past.points],
            "options": options(past),
        },
        whole=(_values(trend, list(trend.packages), digits),) if request.medium == "folder" else (),
    )


def _span(trend: Trend, name: str) -> float:
    known = [one for one in trend.packages[name] if one is not None]
    return abs(known[-1] - known[0]) if known else 0.0


def _values(trend: Trend, names: list[str], digits: int) -> Table:
    rows = tuple(
        (
            Cell(day(point)),
            Cell(revision_of(point)),
            Cell(trend.whole[place]),
            *(Cell(trend.packages[name][place]) for name in names),
        )
        for place, point in reversed(list(enumerate(trend.points)))
    )
    columns = (
        Column("date", "Date", "day"),
        Column("revision", "Revision", "code"),
        Column("whole", WHOLE[trend.whole_is].capitalize(), "number", decimals=digits),
        *(Column(name, name, "number", decimals=digits) for name in names),
    )
    return Table("values", "Values", columns, rows, total=len(rows))

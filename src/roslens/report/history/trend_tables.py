"""A trend for programs: one JSON document, or a table with a row for each value."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.model.trend import Trend
from roslens.report.writing.csv_table import Cell, Table
from roslens.report.writing.numbers import plain

SCHEMA = "roslens-trend/1"
"""Name and version; within a version keys are only added."""

HEAD = ("quantity", "package", "commit", "time_s", "name", "run", "now", "value", "repository")


def trend_json(trend: Trend) -> str:
    """Return the document."""
    document = {
        "schema": SCHEMA,
        "quantity": trend.quantity,
        "title": trend.title,
        "unit": trend.unit,
        "whole_is": trend.whole_is,
        "points": [
            {"run": one.run, "commit": one.commit, "time_s": plain(one.time_s), "name": one.name, "now": one.now}
            for one in trend.points
        ],
        "whole": [_plain(value) for value in trend.whole],
        "packages": {name: [_plain(value) for value in values] for name, values in trend.packages.items()},
        "repositories": {name: [_plain(value) for value in values] for name, values in trend.repositories.items()},
        "events": [msgspec.to_builtins(one) for one in trend.events],
    }
    return msgspec.json.format(msgspec.json.encode(document), indent=1).decode() + "\n"


def trend_table(trend: Trend) -> Table:
    """Return a row for each value; that of all packages together has no package, and no repository."""
    return HEAD, list(_rows(trend))


def _rows(trend: Trend) -> Iterator[tuple[Cell, ...]]:
    columns = [("", "", trend.whole), *((name, "", values) for name, values in trend.packages.items())]
    columns += [("", name, values) for name, values in trend.repositories.items()]
    for package, repository, values in columns:
        for point, value in zip(trend.points, values, strict=True):
            if value is not None:
                now = "yes" if point.now else "no"
                place = (point.commit, plain(point.time_s), point.name, point.run, now)
                yield (trend.quantity, package, *place, plain(value), repository)


def _plain(value: float | None) -> float | None:
    return None if value is None else plain(value)

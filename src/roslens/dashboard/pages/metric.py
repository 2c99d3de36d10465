"""One quantity: how it is distributed, the bounds of each model, the twenty worst."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.charts.figures import number
from roslens.dashboard.charts.histogram import figures_of, histogram_of
from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_list import file_ref
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.judge.ranges.rate import rate
from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.model.verdict import State

WORST = 20
Values = Sequence[tuple[str, str, float]]


def build(site: Site, request: Request) -> View | None:
    """Return the page; None for an unknown quantity."""
    key, _, fold = request.key.partition(".") if request.key not in site.quantities else (request.key, "", "")
    quantity = site.quantities.get(key)
    if quantity is None or (fold and fold not in {known.value for known in quantity.folds}):
        return None
    kinds = site.kinds_measured[key]
    kind = next((kind for kind in kinds if kind.value == request.query.get("kind")), kinds[0] if kinds else None)
    found = _found(site, request.key, kind)
    values = [value for _, _, value in found]
    whole = all(value == int(value) for value in values)
    digits = 0 if whole else _digits(quantity, kind, fold)
    figures = figures_of(values)
    bounds = _bounds(site, kind, request.key, values) if kind else None
    worst, every = _worst_and_every(site, request, quantity, kind, found, digits)
    return View(
        ref=PageRef("metric", request.key, query=request.query.pairs),
        title=f"{quantity.title} ({fold})" if fold else quantity.title,
        facts={
            "quantity": msgspec.to_builtins(quantity),
            "kind": kind.value if kind else "",
            "figures": msgspec.to_builtins(figures),
        },
        tables=tuple(table for table in (bounds, worst) if table is not None),
        shown={
            "quantity": quantity,
            "kind": kind,
            "kinds": kinds,
            "figures": figures,
            "digits": digits,
            "histogram": histogram_of(values, digits),
            "lines": _lines(site, kind, request.key, whole=whole) if kind else [],
            "folds": [fold.value for fold in quantity.folds],
            "key": key,
        },
        whole=(bounds, every) if bounds and every else (),
    )


def _worst_and_every(
    site: Site, request: Request, quantity: Quantity, kind: EntityKind | None, found: Values, digits: int
) -> tuple[Table | None, Table | None]:
    """Return the table of the worst, and of all where that is a page beside it."""
    if kind is None:
        return None, None
    worst = _worst(site, quantity, kind, found, digits, None if request.complete else WORST)
    beside = request.medium == "folder" and not request.complete
    return worst, _worst(site, quantity, kind, found, digits, None) if beside else None


def _found(site: Site, key: str, kind: EntityKind | None) -> Values:
    """Return the values of what is shown; files of no package are no package."""
    if kind is None:
        return []
    found = site.view.values_of(key, kind)
    return [one for one in found if one[1] != OUTSIDE_PACKAGES] if kind is EntityKind.PACKAGE else found


def _digits(quantity: Quantity, kind: EntityKind | None, fold: str) -> int:
    """Return with how many decimals values are shown; a mean has one at least."""
    folded = kind is not None and kind not in quantity.kinds
    return max(1, quantity.decimals) if folded and fold in {"", "mean"} else quantity.decimals


def _lines(site: Site, kind: EntityKind, key: str, *, whole: bool) -> list[tuple[float, str]]:
    """Return (place, the bound and the models that set it): one line in the distribution for each.

    A bar of whole numbers begins at its number, so the line of an upper bound stands at the end of the bar.
    """
    names: dict[tuple[float, str], list[str]] = {}
    for model, constraint in site.constraints_on(kind, key):
        for side in constraint.sides:
            word = "at most" if side == "max" else "at least"
            names.setdefault((constraint.bound(side), word), []).append(model.name)
    return [
        (bound + (whole and word == "at most"), f"{word} {number(bound)}: {', '.join(models)}")
        for (bound, word), models in sorted(names.items())
    ]


def _bounds(site: Site, kind: EntityKind, key: str, values: Sequence[float]) -> Table:
    rows = []
    for model, constraint in site.constraints_on(kind, key):
        ratings = [rate(value, constraint.range) for value in values]
        high, low = ratings.count(State.HIGH), ratings.count(State.LOW)
        rating = "high" if high else "low" if low else "ok" if values else "unknown"
        rows.append(
            (
                Cell(rating, text=_said(high, low, len(values))),
                Cell(model.name, text=model.title or model.name),
                Cell(str(constraint.range)),
                Cell(high),
                Cell(low),
                Cell(100 * (high + low) / len(values) if values else None),
                Cell("yes" if model in site.run_models else "no"),
            )
        )
    columns = (
        Column("rating", "Result", "mark"),
        Column("model", "Model"),
        Column("range", "Limit"),
        Column("high", "Above", "number"),
        Column("low", "Below", "number"),
        Column("share", "Outside", "number", unit="%", decimals=1),
        Column("judged", "Judged in this run"),
    )
    empty = "No quality model limits it."
    return Table("bounds", "Limits of each quality model", columns, tuple(rows), total=len(rows), empty=empty)


def _said(high: int, low: int, values: int) -> str:
    if not values:
        return "no values"
    outside = [f"{count:,} {word}" for count, word in ((high, "above"), (low, "below")) if count]
    return ", ".join(outside) or "all within"


def _worst(site: Site, quantity: Quantity, kind: EntityKind, found: Values, digits: int, limit: int | None) -> Table:
    named = {EntityKind.FUNCTION: "Function", EntityKind.CLASS: "Class", EntityKind.FILE: "File"}
    columns = (
        Column("entity", named.get(kind, "Package"), "code"),
        *((Column("package", "Package"),) if kind is not EntityKind.PACKAGE else ()),
        *((Column("path", "File", "code", optional=True),) if kind in {EntityKind.FUNCTION, EntityKind.CLASS} else ()),
        Column("value", quantity.title, "number", unit=quantity.unit, bar=True, decimals=digits),
    )
    falling = quantity.better is not Better.HIGHER
    ranked = sorted(found, key=lambda row: (-row[2] if falling else row[2], row[0]))
    rows = tuple(_worst_row(site, kind, quantity, row, linked=limit is not None) for row in ranked[:limit])
    which = "Lowest" if not falling else "Highest"
    title = f"{which} {min(len(found), WORST)} of {len(found):,}"
    table = Table("worst", title, columns, rows, total=len(found), empty="No entity of this kind has a value.")
    return sort_rows(table, "")


def _worst_row(
    site: Site, kind: EntityKind, quantity: Quantity, row: tuple[str, str, float], *, linked: bool
) -> tuple[Cell, ...]:
    entity, package, value = row
    path, _, inside = entity.partition(":")[2].partition("#")
    if not linked:
        own = () if kind is EntityKind.PACKAGE else (path,) if kind is EntityKind.FILE else (inside,)
        more = (path,) if kind in {EntityKind.FUNCTION, EntityKind.CLASS} else ()
        return tuple(Cell(one) for one in (*own, package, *more, value))
    rating = site.rating(kind, quantity.key, value)
    marked = Cell(value, rating="" if rating == "ok" else rating)
    owner = Cell(package, ref=PageRef("package", package))
    if kind is EntityKind.PACKAGE:
        return (owner, marked)
    if kind is EntityKind.FILE:
        return (Cell(path, ref=file_ref(site, path)), owner, marked)
    # One look-up per row: only for the few that are shown.
    known = site.view.entity(entity) if linked else None
    place = file_ref(site, path, known.line) if known else None
    return (Cell(inside, ref=place), owner, Cell(path, ref=file_ref(site, path)), marked)

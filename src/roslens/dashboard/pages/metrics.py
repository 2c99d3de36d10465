"""All quantities: what was measured, on what, how it lies over the packages, which models bound it."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.charts.histogram import figures_of, histogram_of
from roslens.dashboard.measured import Measured, measured_on
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.model.entity import EntityKind
from roslens.model.source import OUTSIDE_PACKAGES

FOLD = "How the values of the parts become the value of the package"


def build(site: Site, request: Request) -> View | None:
    """Return the page."""
    on_packages = measured_on(site.quantities, EntityKind.PACKAGE)
    packages = [package for package in site.packages if package.id != OUTSIDE_PACKAGES]
    rows = []
    for key, quantity in site.quantities.items():
        measured = on_packages.get(key, Measured(key, quantity))
        values = [package.values[key] for package in packages if key in package.values]
        figures = figures_of(values)
        distribution = histogram_of(values, measured.decimals)
        spark = tuple(bar.count for bar in distribution.bars) if distribution else ()
        bounds = {model.name for model in site.models for constraint in model.constraints if constraint.quantity == key}
        digits = measured.decimals
        rows.append(
            (
                Cell(quantity.title, ref=PageRef("metric", key), hint=quantity.text),
                Cell(key),
                Cell(quantity.unit),
                Cell(", ".join(kind.value for kind in quantity.kinds)),
                Cell(measured.fold),
                Cell(figures.n if figures else None),
                *(
                    Cell(value, text="" if value is None else f"{value:,.{digits}f}")
                    for value in ((figures.least, figures.median, figures.most) if figures else (None, None, None))
                ),
                Cell(None, text=" ", spark=spark),
                Cell(" ".join(sorted(bounds)), text=", ".join(sorted(bounds))),
            )
        )
    columns = (
        Column("title", "Metric"),
        Column("key", "Key", "code", optional=True),
        Column("unit", "Unit", optional=True),
        Column("kinds", "Measured on"),
        Column("fold", "Per package", hint=FOLD, optional=True),
        Column("packages", "Packages", "number", hint="Packages that have a value"),
        Column("least", "Least", "number"),
        Column("median", "Median", "number"),
        Column("most", "Most", "number"),
        Column("spark", "Over the packages", hint="How many packages have how much, from least to most", optional=True),
        Column("models", "Bounded by", optional=True),
    )
    table = Table(
        "metrics",
        "Metrics",
        columns,
        tuple(rows),
        total=len(rows),
        identities=tuple(site.quantities),
        empty="Nothing was measured.",
    )
    return View(
        ref=PageRef("metrics", query=request.query.pairs),
        title="Metrics",
        facts={"models": [{"name": model.name, "title": model.title} for model in site.models]},
        tables=(sort_rows(table, request.query.get("sort")),),
    )

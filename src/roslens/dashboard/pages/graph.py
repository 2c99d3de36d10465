"""The package graph: dependencies in depth columns, coloured by findings relative to what is visible."""

from __future__ import annotations

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.charts.figures import number
from roslens.dashboard.charts.ramp import Ramp, ramp_of
from roslens.dashboard.graph_model import Colouring, better_of, colour_title, colour_values, graph_of
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.model.tags import tag_filter


def build(site: Site, request: Request) -> View | None:
    """Return the page."""
    query = request.query
    graph, layout = graph_of(site)
    include, exclude = query.all("include"), query.all("exclude")
    colouring = Colouring(query.get("colour", "findings"), tag_filter(include, exclude), not query.get("aside"))
    values, measured = colour_values(site, colouring)
    decimals = measured.decimals if measured else 1 if colouring.by == "kloc" else 0
    ramp = ramp_of(values, better_of(measured), decimals)
    title = colour_title(colouring, measured)
    table = sort_rows(
        _table(site, title, values, decimals), query.get("sort"), None if request.complete else request.limits.rows
    )
    return View(
        ref=PageRef("graph", query=query.pairs),
        title="Package graph",
        facts={
            "colour": {"by": colouring.by, "title": title, "include": list(include), "exclude": list(exclude)},
            "values": values,
            "graph": msgspec.to_builtins(graph),
        },
        tables=(table,),
        shown={
            "graph": graph,
            "layout": layout,
            "steps": [ramp.step(value) for value in values],
            "values_text": [number(value, decimals) for value in values],
            "colour_title": title,
            "unit": measured.quantity.unit if measured else "",
            "legend": legend(ramp, values),
            "falling": ramp.falling,
            "unfiltered": measured is not None and bool(include or exclude or not colouring.gated),
            "cycles": any(edge.cycle for edge in layout.edges),
            "tags": site.tag_counts,
            "colour_by": colouring.by,
            "aside": not colouring.gated,
        },
    )


def legend(ramp: Ramp, values: list[float | None]) -> list[tuple[str, str, int]]:
    """Return (step, its numbers, how many packages it holds); no data last, if any."""
    steps = [ramp.step(value) for value in values]
    found = [(step, text, steps.count(step)) for step, text in ramp.legend()]
    missing = steps.count("n")
    return [*found, ("n", "not measured", missing)] if missing else found


def _table(site: Site, title: str, values: list[float | None], decimals: int) -> Table:
    graph, _ = graph_of(site)
    columns = (
        Column("package", "Package"),
        Column("value", title, "number", bar=True, decimals=decimals),
        Column("loc", "Code lines", "number"),
        Column("tier", "Tier", "number"),
        Column("needs", "Needs"),
        Column("needed_by", "Needed by"),
    )
    rows = tuple(
        (
            Cell(node.id, ref=PageRef("package", node.id)),
            Cell(value),
            Cell(node.loc),
            Cell(node.tier),
            _names(site.dependencies[node.id]),
            _names(site.dependents[node.id]),
        )
        for node, value in zip(graph.nodes, values, strict=True)
    )
    identities = tuple(str(number) for number in range(len(rows)))
    return Table(
        "graph",
        "Packages and their dependencies",
        columns,
        rows,
        total=len(rows),
        sort="-value",
        empty="No packages.",
        identities=identities,
    )


def _names(packages: tuple[str, ...]) -> Cell:
    return Cell(" ".join(packages), refs=tuple((package, PageRef("package", package)) for package in packages))

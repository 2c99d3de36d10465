"""What could not be analysed: the honest part of every run."""

from __future__ import annotations

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_list import file_ref
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.model.failure import Failure


def build(site: Site, request: Request) -> View | None:
    """Return the page."""
    package, tool = request.query.get("package"), request.query.get("tool")
    failures = [
        failure
        for failure in site.failures
        if (not package or failure.package == package) and (not tool or failure.tool == tool)
    ]
    tools: dict[str, int] = {}
    for failure in site.failures:
        tools[failure.tool] = tools.get(failure.tool, 0) + 1
    limit = None if request.complete else request.limits.rows
    table = sort_rows(failures_table(site, failures), request.query.get("sort"), limit)
    shown = failures[: request.limits.findings]
    return View(
        ref=PageRef("failures", query=request.query.pairs),
        title="Not analysed",
        facts={
            "total": len(site.failures),
            "tools": dict(sorted(tools.items())),
            "failures": [msgspec.to_builtins(failure) for failure in shown],
        },
        tables=(table,),
        shown={
            "details": [failure for failure in shown if failure.detail],
            "matching": len(failures),
            "package": package,
            "tool": tool,
            "tools": dict(sorted(tools.items())),
        },
    )


def failures_table(site: Site, failures: list[Failure]) -> Table:
    """Return one row per failure: what, where, what was expected, what to do."""
    columns = (
        Column("tool", "Step or tool"),
        Column("what", "What was found", "prose"),
        Column("where", "Where", "code"),
        Column("expected", "Expected"),
        Column("advice", "What to do"),
        Column("rest", "The rest of it"),
        Column("package", "Package", optional=True),
    )
    rows = tuple(
        (
            Cell(failure.tool),
            Cell(failure.what),
            Cell(
                str(failure.location) if failure.location else failure.entity,
                ref=file_ref(site, failure.location.path, failure.location.line) if failure.location else None,
            ),
            Cell(failure.expected),
            Cell(failure.advice),
            Cell("was analysed" if failure.partial else "was not analysed"),
            Cell(failure.package, ref=PageRef("package", failure.package) if failure.package in site.by_id else None),
        )
        for failure in failures
    )
    return Table("failures", "Not analysed", columns, rows, total=len(rows), empty="Everything was analysed.")

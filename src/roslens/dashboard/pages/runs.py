"""The runs that are kept: when each was, of which commit, and how much it found."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View

_COLUMNS = (
    Column("run", "Run", "number"),
    Column("started", "Started (UTC)", "day"),
    Column("commit", "Commit", "code"),
    Column("packages", "Packages", "number"),
    Column("files", "Files", "number"),
    Column("findings", "Findings", "number", bar=True, hint="all of them, also in test, generated and vendored code"),
    Column("failures", "Not analysed", "number"),
    Column("models", "Judged by"),
    Column("shown", "Shown here", sparse=True),
)


def build(site: Site, request: Request) -> View | None:
    """Return the page; None where only one run is known."""
    if not site.runs:
        return None
    rows = tuple(
        (
            Cell(one.id),
            Cell(one.header.started.replace("T", " ").partition(".")[0].removesuffix("+00:00")),
            Cell(one.header.commit[:12] + ("+" if one.header.commit.endswith("+") else "")),
            Cell(one.packages),
            Cell(one.files),
            Cell(one.findings),
            Cell(one.failures),
            Cell(", ".join(one.header.models)),
            Cell("this one" if one.id == site.view.id else None),
        )
        for one in site.runs
    )
    limit = None if request.complete else request.limits.rows
    table = Table("runs", "Kept runs", _COLUMNS, rows, total=len(rows), sort="-run")
    return View(
        ref=PageRef("runs", query=request.query.pairs),
        title="Runs",
        facts={"shown": site.view.id},
        tables=(sort_rows(table, request.query.get("sort_runs"), limit),),
    )

"""The runs that are kept: when each was, of which commit, and how much it found."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.store.runs import StoredRun

_COLUMNS = (
    Column("run", "Run", "number"),
    Column("started", "Started (UTC)", "day"),
    Column("commit", "Commit", "code"),
    Column("packages", "Packages", "number"),
    Column("files", "Files", "number"),
    Column("findings", "Findings", "number", bar=True, hint="all of them, also in test, generated and vendored code"),
    Column("failures", "Not analysed", "number"),
    Column("models", "Judged by"),
    Column("shown", "On these pages", sparse=True),
)


def build(site: Site, request: Request) -> View | None:
    """Return the page; None where only one run is known."""
    if not site.runs:
        return None
    rows = tuple(_row(site, one) for one in site.runs)
    limit = None if request.complete else request.limits.rows
    table = Table("runs", "Kept runs", _COLUMNS, rows, total=len(rows), sort="-run")
    return View(
        ref=PageRef("runs", query=request.query.pairs),
        title="Runs",
        facts={"shown": site.view.id},
        tables=(sort_rows(table, request.query.get("sort_runs"), limit),),
    )


def _row(site: Site, run: StoredRun) -> tuple[Cell, ...]:
    """Return a run with links to the pages that show it, or what is different since it."""
    here = run.id == site.view.id
    commit = run.header.commit
    return (
        Cell(run.id, ref=PageRef("overview") if here else None),
        Cell(run.header.started.replace("T", " ").partition(".")[0].removesuffix("+00:00")),
        Cell(commit[:12] + ("+" if commit.endswith("+") else ""), ref=_since(site, commit)),
        Cell(run.packages, ref=PageRef("packages") if here else None),
        Cell(run.files),
        Cell(run.findings, ref=PageRef("findings") if here else None),
        Cell(run.failures, ref=PageRef("failures") if here else None),
        Cell(", ".join(run.header.models)),
        _shown(site, run, here=here),
    )


def _shown(site: Site, run: StoredRun, *, here: bool) -> Cell:
    if here:
        return Cell("this one", ref=PageRef("overview"))
    if site.since is not None and site.since.name == f"run {run.id}":
        return Cell("what is new since", ref=PageRef("findings", query=(("status", "new"),)))
    return Cell(None)


def _since(site: Site, commit: str) -> PageRef | None:
    """Return the page of what is different since a commit; None where the history does not have it."""
    place = site.past.place_of(commit.rstrip("+")) if site.past is not None and commit else None
    if site.past is None or place is None or place == len(site.past.points) - 1:
        return None
    return PageRef("difference", query=(("before", site.past.points[place].commit),))

"""Hotspots: files by how much they change and how complex they are, what changes together, and who knows them."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.charts.scatter import scatter_of
from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_list import file_ref
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.model.process import RepositoryProcess

MOST_DOTS = 400
COUPLED = 50
DEGREE = "commits that change both / mean of those that change each"


def build(site: Site, request: Request) -> View | None:
    """Return the page."""
    process = site.view.process
    files = sorted(
        ((path, values) for one in process for path, values in one.files.items() if values.get("hotspot")),
        key=lambda item: (-item[1]["hotspot"], item[0]),
    )
    dots = [_dot(path, values) for path, values in files[:MOST_DOTS]]
    return View(
        ref=PageRef("hotspots", query=request.query.pairs),
        title="Hotspots",
        facts={"repositories": [{"path": one.path, "head": one.head, "skewed": one.skewed} for one in process]},
        tables=(
            sort_rows(_files(site, files, request), request.query.get("sort_files")),
            _coupled(site, process, request),
            _repositories(site, process),
        ),
        shown={"scatter": scatter_of(dots), "cut": max(0, len(files) - MOST_DOTS), "process": process},
    )


def _dot(path: str, values: dict[str, float]) -> tuple[str, str, float, float, float]:
    churn, revisions = values["churn"], values["revisions"]
    complexity = values["hotspot"] / churn
    text = f"{path}: {churn:,.0f} lines in {revisions:,.0f} commits, complexity {complexity:,.0f}"
    return path, text, churn, complexity, revisions


def _files(site: Site, files: list[tuple[str, dict[str, float]]], request: Request) -> Table:
    limit = None if request.complete else request.limits.entities
    rows = tuple(
        (
            Cell(path, ref=file_ref(site, path)),
            Cell(values["hotspot"]),
            Cell(values["churn"]),
            Cell(values["hotspot"] / values["churn"]),
            Cell(values["revisions"]),
            Cell(values["contributors"]),
            Cell(values["ownership"]),
            Cell(values["time_since_last_commit"]),
        )
        for path, values in files[:limit]
    )
    columns = (
        Column("path", "File", "code"),
        Column("hotspot", "Hotspot", "number", hint="churn x complexity"),
        Column("churn", "Churn", "number", unit="lines"),
        Column("complexity", "Complexity", "number", hint="cyclomatic complexity of all its functions together"),
        Column("revisions", "Commits", "number"),
        Column("contributors", "People", "number"),
        Column("ownership", "Ownership", "number", decimals=2, optional=True),
        Column("time_since_last_commit", "Unchanged", "number", unit="d", optional=True),
    )
    empty = "Changes and complexity are not both known of any file; see Not analysed for what is missing."
    return Table("files", "Files, the hottest first", columns, rows, total=len(files), empty=empty)


def _coupled(site: Site, process: tuple[RepositoryProcess, ...], request: Request) -> Table:
    pairs = [("package", pair) for one in process for pair in one.coupled_packages]
    pairs += [("file", pair) for one in process for pair in one.coupled_files]
    limit = None if request.complete else COUPLED
    rows = tuple(
        (
            Cell(kind),
            Cell(pair.first, ref=PageRef("package", pair.first) if kind == "package" else file_ref(site, pair.first)),
            Cell(
                pair.second, ref=PageRef("package", pair.second) if kind == "package" else file_ref(site, pair.second)
            ),
            Cell(pair.shared),
            Cell(100 * pair.degree),
        )
        for kind, pair in pairs[:limit]
    )
    columns = (
        Column("kind", "Kind"),
        Column("first", "Changes", "code"),
        Column("second", "Together with", "code"),
        Column("shared", "Commits", "number"),
        Column(
            "degree", "Degree", "number", unit="%", hint="commits that change both / mean of those that change each"
        ),
    )
    return Table(
        "coupled",
        "What changes together",
        columns,
        rows,
        total=len(pairs),
        empty="No files change together often enough.",
    )


def _repositories(site: Site, process: tuple[RepositoryProcess, ...]) -> Table:
    keys = (
        "revisions", "contributors", "bus_factor", "age", "releases", "revisions_since_release", "open_issues",
        "closed_issues",
    )  # fmt: skip
    titles = ("Commits", "People", "Bus factor", "Age", "Releases", "Since release", "Open issues", "Closed issues")
    # A workspace that is a repository itself lies at no path below it.
    names = {".": site.name}
    rows = tuple(
        (Cell(one.path, text=names.get(one.path, "")), *(Cell(one.values.get(key)) for key in keys), Cell(one.skewed))
        for one in process
    )
    columns = (
        Column("repository", "Repository", "code"),
        *(
            Column(key, title, "number", unit="d" if key == "age" else "", sparse=key.endswith("issues"))
            for key, title in zip(keys, titles, strict=True)
        ),
        Column("skewed", "Skewed", "number", hint="commits that are dated before a parent of theirs", optional=True),
    )
    return Table("repositories", "Repositories", columns, rows, total=len(rows), empty="None.")

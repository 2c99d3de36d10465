"""All packages as a table: findings and the most important metrics; every value in its CSV twin."""

from __future__ import annotations

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.layout.tiers import cycles_of, needs_of, tiers_of
from roslens.dashboard.measured import measured_on
from roslens.dashboard.site import Site
from roslens.dashboard.tables.field_column import field_cell, field_column
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.result import PackageSummary
from roslens.model.source import number_of_packages
from roslens.model.tags import TagFilter, tag_filter

FIRST = 200
"""Rows of a served page that did not ask for all: with 4,000 a browser lays out 120,000 elements."""
TELLING = (
    "comment_ratio",
    "cyclomatic_complexity",
    "cyclomatic_complexity.max",
    "cognitive_complexity.max",
    "maintainability_index",
    "cbo",
)


def build(site: Site, request: Request) -> View | None:
    """Return the page."""
    query = request.query
    include, exclude = query.all("include"), query.all("exclude")
    table = sort_rows(
        packages_table(
            site, tags=tag_filter(include, exclude), text=query.get("text"), every_value=_every_value(request)
        ),
        query.get("sort"),
        _limit(request),
    )
    table = msgspec.structs.replace(table, all=PageRef("packages", query=query.replaced(show="all")))
    return View(
        ref=PageRef("packages", query=query.pairs),
        title="Packages",
        facts={"include": list(include), "exclude": list(exclude), "text": query.get("text")},
        tables=(table, *_repositories(site, tag_filter(include, exclude), request)),
        shown={"tags": site.tag_counts, "every_value": _every_value(request), "of_all": number_of_packages(site.by_id)},
    )


def _limit(request: Request) -> int | None:
    """Return how many rows are shown: written pages have all, as there is no server for the rest."""
    if request.complete:
        return None
    first = request.medium == "served" and request.query.get("show") != "all"
    return min(FIRST, request.limits.rows) if first else request.limits.rows


def _every_value(request: Request) -> bool:
    return request.complete or request.query.get("columns") == "all"


def packages_table(site: Site, *, tags: TagFilter, text: str = "", every_value: bool = False) -> Table:
    """Return one row per package; findings are those that the tags mean."""
    measured = measured_on(site.quantities, EntityKind.PACKAGE)
    present = {key for package in site.packages for key in package.values}
    tiers = tiers_of_packages(site)
    several = len(site.view.header.repositories) > 1
    keys = [key for key in measured if key in present and key not in _OWN_COLUMNS]
    if not every_value:
        keys = [key for key in TELLING if key in keys]
    columns = (
        Column("package", "Package"),
        Column("findings", "Findings", "number", bar=True),
        Column("errors", "Errors", "number"),
        Column("warnings", "Warnings", "number"),
        Column("notes", "Notes", "number"),
        Column(
            "aside",
            "Elsewhere",
            "number",
            hint="Findings in test, generated or vendored code: they fail no check",
            optional=True,
        ),
        Column("per_kloc", "Per kLOC", "number", hint="Findings per 1,000 lines, both of own code", decimals=1),
        field_column(EntityKind.PACKAGE),
        Column("loc", "Code lines", "number", bar=True, hint="Lines with code"),
        *(
            Column(
                key,
                measured[key].title,
                "number",
                unit=measured[key].quantity.unit,
                hint=measured[key].quantity.text,
                decimals=measured[key].decimals,
            )
            for key in keys
        ),
        Column("dependencies", "Needs", "number", hint="Packages of the workspace that it needs"),
        Column("dependents", "Needed by", "number", hint="Packages of the workspace that need it"),
        Column("tier", "Tier", "number", hint="Longest chain of dependencies below it"),
        Column("files", "Files", "number", optional=True),
        Column("functions", "Functions", "number", optional=True),
        Column("failures", "Not analysed", "number", optional=True),
        *((Column("repository", "Repository"),) if several else ()),
        *((Column("version", "Version"), Column("path", "Path")) if every_value else ()),
    )
    needle = text.strip().casefold()
    packages = [package for package in site.packages if needle in f"{package.id} {package.description}".casefold()]
    rows = tuple(
        (
            Cell(package.id, ref=PageRef("package", package.id), hint=package.description),
            *_counts(site, package, tags),
            field_cell(EntityKind.PACKAGE, package.values, site.quantities),
            Cell(package.values.get("loc")),
            *(
                Cell(
                    package.values.get(key), rating=_flag(site.rating(EntityKind.PACKAGE, key, package.values.get(key)))
                )
                for key in keys
            ),
            Cell(len(site.dependencies[package.id])),
            Cell(len(site.dependents[package.id])),
            Cell(tiers[package.id]),
            Cell(package.files),
            Cell(package.functions),
            Cell(package.failures or None, ref=PageRef("failures", query=(("package", package.id),))),
            *((Cell(package.repository),) if several else ()),
            *((Cell(package.version), Cell(package.path)) if every_value else ()),
        )
        for package in packages
    )
    return Table(
        "packages",
        "Packages",
        columns,
        rows,
        total=len(rows),
        sort="-findings",
        empty="No package matches.",
        identities=tuple(package.id for package in packages),
    )


def _repositories(site: Site, tags: TagFilter, request: Request) -> tuple[Table, ...]:
    """Return the repositories as a table, where there is more than one."""
    found = site.view.header.repositories
    if len(found) < 2:
        return ()
    columns = (
        Column("repository", "Repository"),
        Column("packages", "Packages", "number"),
        Column("findings", "Findings", "number", bar=True),
        Column(
            "per_kloc", "Per kLOC", "number", hint="Findings per 1,000 lines of code of all its packages", decimals=1
        ),
        Column("loc", "Code lines", "number", bar=True, hint="Lines with code"),
        Column("version", "Version", hint="Branch, tag or commit that was fetched", optional=True),
        Column("commit", "Commit", "code", hint="With + where files differ from it"),
        Column("url", "From", optional=True),
    )
    rows = []
    for one in found:
        inside = [site.by_id[key] for key in one.packages if key in site.by_id]
        findings = sum(sum(site.severity_counts_of(package, tags).values()) for package in inside)
        loc = sum(package.values.get("loc", 0) for package in inside)
        rows.append(
            (
                Cell(one.name, hint=one.path),
                Cell(len(inside)),
                Cell(findings),
                Cell(1000 * findings / loc if loc else None),
                Cell(loc),
                Cell(one.version),
                Cell(one.commit[:12] + one.commit[40:]),
                Cell(one.url),
            )
        )
    table = Table(
        "repositories", "Repositories", columns, tuple(rows), total=len(rows), sort="-findings",
        empty="No repository.", identities=tuple(one.path for one in found),
    )  # fmt: skip
    limit = None if request.complete else request.limits.rows
    return (sort_rows(table, request.query.get("sort_repositories"), limit),)


_OWN_COLUMNS = frozenset({"loc", "tier", "dependents", "dependencies"})


def _flag(rating: str) -> str:
    return "" if rating == "ok" else rating


def _counts(site: Site, package: PackageSummary, tags: TagFilter) -> tuple[Cell, ...]:
    by_severity = site.severity_counts_of(package, tags)
    total, aside = sum(by_severity.values()), site.aside_of(package, tags)
    own = PageRef("findings", query=(("package", package.id), ("role", "gated")))
    rest = PageRef("findings", query=(("package", package.id), ("role", "aside")))
    return (
        Cell(total, ref=own if total else None),
        Cell(by_severity[Severity.ERROR]),
        Cell(by_severity[Severity.WARNING]),
        Cell(by_severity[Severity.NOTE]),
        Cell(aside, ref=rest if aside else None),
        Cell(site.findings_per_kloc(package, tags)),
    )


def tiers_of_packages(site: Site) -> dict[str, int]:
    """Return the tier of each package in the graph of the workspace."""
    place = {package.id: number for number, package in enumerate(site.packages)}
    edges = [(place[package], place[needed]) for package, needs in site.dependencies.items() for needed in needs]
    needs = needs_of(len(place), edges)
    tiers = tiers_of(needs, cycles_of(needs))
    return {package: tiers[number] for package, number in place.items()}

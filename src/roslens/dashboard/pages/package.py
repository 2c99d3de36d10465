"""One package: its findings, its metrics against each model, its functions and classes ranked, its files."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.computation.node_rows import nodes_table
from roslens.dashboard.computation.unstarted_rows import unstarted_table
from roslens.dashboard.pages.packages import tiers_of_packages
from roslens.dashboard.site import Site
from roslens.dashboard.tables.entity_tables import classes_table, files_table, functions_table
from roslens.dashboard.tables.finding_list import filter_of, list_findings, select
from roslens.dashboard.tables.finding_table import findings_table
from roslens.dashboard.tables.metric_rows import metrics_table
from roslens.dashboard.tables.table import Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.model.entity import EntityKind
from roslens.model.result import PackageResult


def build(site: Site, request: Request) -> View | None:
    """Return the page; None for an unknown package."""
    summary = site.by_id.get(request.key)
    result = site.view.package(request.key) if summary else None
    if summary is None or result is None:
        return None
    wanted = filter_of(request.query, package=summary.id)
    found = list_findings(site, wanted, request)
    tables = [_sorted(table, request) for table in _tables(site, result)]
    started = nodes_table(site.book, summary.name)
    if started.total:
        tables.append(_sorted(started, request))
    loose = _sorted(unstarted_table(site.book, package=summary.name), request)
    if loose.total:
        tables.append(loose)
    if request.complete:
        tables.append(findings_table(site, select(site, wanted), found.total))
    severities = site.severity_counts_of(summary)
    return View(
        ref=PageRef("package", summary.id, query=request.query.pairs),
        title=summary.id,
        facts={
            "package": _facts(site, result),
            "severities": {severity.value: count for severity, count in severities.items()},
            "aside": site.aside_of(summary),
            **found.facts(),
        },
        tables=tuple(tables),
        shown={
            "summary": summary,
            "manifest": result.package,
            "severities": severities,
            "aside": site.aside_of(summary),
            "found": found,
            "needs": site.dependencies[summary.id],
            "needed_by": site.dependents[summary.id],
            "outside": site.outside_dependencies(summary.id),
            "tier": tiers_of_packages(site)[summary.id],
            "failures": result.failures,
            "tags": _tags(site, summary.id),
            "loose": loose.total,
            "started": started.total,
        },
    )


def _tables(site: Site, result: PackageResult) -> tuple[Table, ...]:
    return (
        metrics_table(site, result.entities),
        functions_table(site, [entity for entity in result.entities if entity.kind is EntityKind.FUNCTION]),
        classes_table(site, [entity for entity in result.entities if entity.kind is EntityKind.CLASS]),
        files_table(site, result),
    )


def _sorted(table: Table, request: Request) -> Table:
    limit = request.limits.rows if table.name in {"metrics", "files", "nodes", "unstarted"} else request.limits.entities
    return sort_rows(table, request.query.get(f"sort_{table.name}"), None if request.complete else limit)


def _tags(site: Site, package: str) -> dict[str, int]:
    counts: dict[str, int] = {}
    for _, count in site.counts(package):
        for tag in count.tags:
            counts[tag] = counts.get(tag, 0) + count.count
    return dict(sorted(counts.items(), key=lambda item: (-item[1], item[0])))


def _facts(site: Site, result: PackageResult) -> dict[str, object]:
    package = result.package
    summary = site.by_id[package.id]
    return {
        "id": package.id,
        "name": package.name,
        "path": package.path,
        "version": package.version,
        "build_type": package.build_type,
        "description": summary.description,
        "maintainers": [person.name for person in package.maintainers],
        "licenses": [licence.name for licence in package.licenses],
        "needs": list(site.dependencies[package.id]),
        "needed_by": list(site.dependents[package.id]),
        "outside": list(site.outside_dependencies(package.id)),
        "values": dict(summary.values),
        "failures": [str(failure) for failure in result.failures],
    }

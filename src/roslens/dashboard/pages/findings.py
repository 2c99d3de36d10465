"""All findings: filtered by the address, grouped by rule or file."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_list import filter_of, list_findings, select
from roslens.dashboard.tables.finding_table import findings_table
from roslens.dashboard.tables.set_aside_table import set_aside_table
from roslens.dashboard.view import Request, View


def build(site: Site, request: Request) -> View | None:
    """Return the page."""
    wanted = filter_of(request.query)
    found = list_findings(site, wanted, request)
    tables = (findings_table(site, select(site, wanted), found.total),) if request.complete else ()
    whole = not wanted.active and wanted.package is None and not wanted.rule and not wanted.path
    hushed = set_aside_table(site, request.limits.rows) if whole else None
    if hushed is not None and hushed.rows:
        tables = (*tables, hushed)
    return View(
        ref=PageRef("findings", query=request.query.pairs),
        title="Findings",
        facts=found.facts(),
        tables=tables,
        shown={"found": found, "tags": site.tag_counts, "hushed": hushed},
    )

"""All findings: filtered by the address, grouped by rule or file."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.finding_list import filter_of, findings_table, list_findings, select
from roslens.dashboard.site import Site
from roslens.dashboard.view import Request, View


def build(site: Site, request: Request) -> View | None:
    """Return the page."""
    wanted = filter_of(request.query)
    found = list_findings(site, wanted, request)
    tables = (findings_table(site, select(site, wanted), found.total),) if request.complete else ()
    return View(
        ref=PageRef("findings", query=request.query.pairs),
        title="Findings",
        facts=found.facts(),
        tables=tables,
        shown={"found": found, "tags": site.tag_counts},
    )

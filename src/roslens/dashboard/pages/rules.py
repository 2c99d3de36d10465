"""Every rule of the run, also those that nothing broke."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.model.tags import tag_filter


def build(site: Site, request: Request) -> View | None:
    """Return the page."""
    query = request.query
    include, exclude, text = query.all("include"), query.all("exclude"), query.get("text").strip()
    wanted = tag_filter(include, exclude)
    counts = {one.rule: (one.gated, one.count - one.gated, one.packages) for one in site.broken_rules()}
    columns = (
        Column("severity", "Severity", "mark"),
        Column("title", "What it finds"),
        Column("rule", "Rule", "code", optional=True),
        Column("findings", "Findings", "number", bar=True),
        Column("aside", "Elsewhere", "number", hint="In test, generated or vendored code: they fail no check"),
        Column("packages", "Packages", "number"),
        Column("tool", "Found by", optional=True),
        Column("tags", "Tags", optional=True),
    )
    rows = tuple(
        (
            Cell(rule.severity.value),
            Cell(rule.title, ref=PageRef("rule", rule.id)),
            Cell(rule.id, ref=PageRef("rule", rule.id)),
            *map(Cell, counts.get(rule.id, (0, 0, 0))),
            Cell(rule.tool, text="limit" if rule.tool == "judge" else ""),
            Cell(" ".join(rule.tags)),
        )
        for rule in site.rules.values()
        if wanted.matches(rule.tags) and text.casefold() in f"{rule.id} {rule.title} {rule.tool}".casefold()
    )
    table = Table("rules", "Rules", columns, rows, total=len(rows), sort="-findings", empty="No rule matches.")
    broken = sum(1 for rule in site.rules if rule in counts)
    return View(
        ref=PageRef("rules", query=query.pairs),
        title="Rules",
        facts={
            "include": list(include),
            "exclude": list(exclude),
            "text": text,
            "known": len(site.rules),
            "broken": broken,
        },
        tables=(sort_rows(table, query.get("sort"), None if request.complete else request.limits.rows),),
        shown={"tags": site.tag_counts},
    )

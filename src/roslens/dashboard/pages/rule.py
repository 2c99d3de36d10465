"""One rule: what it finds, why it matters, where it is broken."""

from __future__ import annotations

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_list import filter_of, list_findings, select
from roslens.dashboard.tables.finding_table import findings_table
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.model.weight.consequence import weight_text
from roslens.model.words.silence_comment import measured_text, silence_comment


def build(site: Site, request: Request) -> View | None:
    """Return the page; None for an unknown rule."""
    rule = site.rules.get(request.key)
    if rule is None:
        return None
    wanted = filter_of(request.query, rule=rule.id, group="file")
    found = list_findings(site, wanted, request)
    limit = None if request.complete else request.limits.rows
    tables = [sort_rows(_packages(site, rule.id), request.query.get("sort_packages"), limit)]
    if request.complete:
        tables.append(findings_table(site, select(site, wanted), found.total))
    return View(
        ref=PageRef("rule", rule.id, query=request.query.pairs),
        title=rule.id,
        facts={"rule": msgspec.to_builtins(rule), **found.facts()},
        tables=tuple(tables),
        shown={
            "info": rule,
            "found": found,
            "tags": {},
            "weight": weight_text(*rule.weight, unproven=rule.unproven),
            "measured": measured_text(rule),
            "silence": silence_comment(rule),
        },
    )


def _packages(site: Site, rule: str) -> Table:
    counts: dict[str, list[int]] = {}
    for owner, count in site.counts():
        if count.rule == rule:
            sums = counts.setdefault(owner, [0, 0])
            sums[0] += count.count
            sums[1] += count.gated
    columns = (
        Column("package", "Package"),
        Column("findings", "Findings", "number", bar=True),
        Column("aside", "Elsewhere", "number", hint="In test, generated or vendored code: they fail no check"),
    )
    rows = tuple(
        (
            Cell(owner or "(workspace)", ref=PageRef("package", owner) if owner else None),
            Cell(gated, ref=_listed(rule, owner, "gated") if gated else None),
            Cell(count - gated, ref=_listed(rule, owner, "aside") if count > gated else None),
        )
        for owner, (count, gated) in counts.items()
    )
    return Table(
        "packages",
        "Packages that break it",
        columns,
        rows,
        total=len(rows),
        sort="-findings",
        empty="Nothing breaks it.",
    )


def _listed(rule: str, package: str, role: str) -> PageRef:
    return PageRef("findings", query=(("rule", rule), ("package", package), ("role", role)))

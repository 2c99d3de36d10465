"""The findings that were set aside, as a table."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_list import file_ref
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.model.set_aside import Disposition, SetAside

_STATES = {
    Disposition.SUPPRESSED: "comment",
    Disposition.IGNORED: "[[ignore]]",
    Disposition.ACCEPTED: "accepted",
    Disposition.FALSE_POSITIVE: "false positive",
}


def set_aside_table(site: Site, limit: int) -> Table:
    """Return one row per finding: what, where, who set it aside and why; at most ``limit`` rows."""
    found = list(site.view.set_aside())
    columns = (
        Column("rule", "Rule", "code"),
        Column("where", "Where", "code"),
        Column("message", "Finding"),
        Column("state", "Set aside by"),
        Column("reason", "Reason"),
        Column("by", "Said in", "code", optional=True),
    )
    rows = tuple(_row(site, one) for one in found[:limit])
    return Table("set_aside", "Set aside", columns, rows, total=len(found), empty="Nothing was set aside.")


def _row(site: Site, one: SetAside) -> tuple[Cell, ...]:
    finding = one.finding
    place = f"{finding.path}:{finding.line}" if finding.line else finding.path or finding.entity
    return (
        Cell(finding.rule, ref=PageRef("rule", finding.rule) if finding.rule in site.rules else None),
        Cell(place, ref=file_ref(site, finding.path, finding.line) if finding.path else None),
        Cell(finding.message),
        Cell(_STATES[one.state]),
        Cell(one.reason),
        Cell(one.by),
    )

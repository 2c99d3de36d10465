"""Findings as a table: a row each, with what the pages show of them."""

from __future__ import annotations

from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_table import COLUMNS, findings_table


def test_each_finding_is_a_row_with_its_consequence(site: Site) -> None:
    found = list(site.view.findings())
    table = findings_table(site, found, len(found))
    names = [column.key for column in COLUMNS]
    rows = [dict(zip(names, (cell.value for cell in row), strict=True)) for row in table.rows]
    assert [(row["rule"], row["consequence"], row["certainty"]) for row in rows] == [
        (one.rule, one.weight[0].value, one.weight[1].value) for one in found
    ]

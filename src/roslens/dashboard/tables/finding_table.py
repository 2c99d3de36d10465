"""Findings as a table, a row each: what the CSV of a page holds."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_list import package_of, role_of
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.model.finding import Finding

COLUMNS = (
    Column("severity", "Severity", "mark"),
    Column("consequence", "Consequence"),
    Column("certainty", "Certainty"),
    Column("rule", "Rule", "code"),
    Column("message", "Message"),
    Column("package", "Package"),
    Column("path", "File", "code"),
    Column("line", "Line", "number"),
    Column("column", "Column", "number"),
    Column("entity", "Entity", "code"),
    Column("tags", "Tags"),
    Column("tool", "Tool"),
    Column("role", "Code"),
    Column("model", "Model"),
    Column("quantity", "Quantity", "code"),
    Column("value", "Value", "number"),
    Column("bound", "Bound", "number"),
    Column("fingerprint", "Fingerprint", "code"),
)


def findings_table(site: Site, found: Iterable[Finding], total: int) -> Table:
    """Return findings as a table, for the twins."""
    rows = tuple(
        tuple(
            Cell(value)
            for value in (
                finding.severity.value,
                finding.weight[0].value,
                finding.weight[1].value,
                finding.rule,
                finding.message,
                package_of(site, finding),
                finding.path,
                finding.line or None,
                finding.column or None,
                finding.entity,
                " ".join(finding.tags),
                finding.tool,
                role_of(site, finding),
                finding.model,
                finding.quantity,
                finding.value,
                finding.bound,
                finding.fingerprint,
            )
        )
        for finding in found
    )
    return Table("findings", "Findings", COLUMNS, rows, total=total)

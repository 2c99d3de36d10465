"""What somebody set aside is listed below all findings, with who and why, and counts in no other number."""

from __future__ import annotations

from roslens.dashboard.site import Site
from roslens.dashboard.tables.set_aside_table import set_aside_table
from roslens.model.finding import Finding, Severity
from roslens.model.set_aside import Disposition, SetAside


def test_rows_say_who_and_why(bare_site: Site, monkeypatch) -> None:
    finding = Finding("a.rule", Severity.NOTE, "m", "src/x.cpp", 3)
    found = [SetAside(finding, Disposition.FALSE_POSITIVE, f"reason {number}", "0123") for number in range(3)]
    monkeypatch.setattr(bare_site.view, "set_aside", lambda: iter(found))
    table = set_aside_table(bare_site, 2)
    assert (table.total, len(table.rows)) == (3, 2)
    assert [cell.value for cell in table.rows[0]] == [
        "a.rule",
        "src/x.cpp:3",
        "m",
        "false positive",
        "reason 0",
        "0123",
    ]

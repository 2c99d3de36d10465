"""What is wrong with a configuration as tables: what is sure, and apart from it what is in doubt."""

from __future__ import annotations

from roslens.dashboard.computation.book import Book, ref_of
from roslens.dashboard.computation.system import System
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.model.configuration import Proof
from roslens.model.finding import Finding
from roslens.report.run.fix_first import Gravity, gravity

_COLUMNS = (
    Column("severity", "Severity", "mark"),
    Column("message", "What was found", "prose"),
    Column("about", "About", "name"),
    Column("place", "Where", "code"),
    Column("rule", "Rule", "code"),
)


def finding_tables(book: Book, system: System) -> tuple[Table, Table]:
    """Return the findings that are sure and those in doubt: the gravest first, then by rule and place.

    Rows are identified by the place of the finding in ``system.findings``.
    """
    order = sorted(range(len(system.findings)), key=lambda number: _order(system.findings[number]))
    sure = [number for number in order if not system.findings[number].doubts]
    doubted = [number for number in order if system.findings[number].doubts]
    return (
        _table(book, system, "findings", "Findings", sure),
        _table(book, system, "doubts", "Findings in doubt", doubted),
    )


def _order(finding: Finding) -> tuple[Gravity, str, str, int]:
    return (gravity(finding), finding.rule, finding.path, finding.line)


def _table(book: Book, system: System, name: str, title: str, numbers: list[int]) -> Table:
    rows = tuple(_row(book, system, system.findings[number]) for number in numbers)
    identities = tuple(map(str, numbers))
    return Table(name, title, _COLUMNS, rows, total=len(rows), identities=identities, empty="None.")


def _row(book: Book, system: System, finding: Finding) -> tuple[Cell, ...]:
    elements = [system.elements[number] for number in system.elements_of(finding)]
    names = " ".join(element.name for element in elements)
    return (
        Cell(finding.severity.value),
        Cell(finding.message),
        Cell(names, refs=tuple((element.name, ref_of(system, element)) for element in elements)),
        book.place(Proof(finding.path, finding.line)),
        Cell(finding.rule, ref=book.rule(finding.rule)),
    )

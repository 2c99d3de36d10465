"""A package's result as the rows that a store keeps of it: made where the package was measured, written by one process.

To make them takes longer than to write them, and of all that crosses between processes they are the smallest.
"""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from roslens.model.entity import EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.result import PackageResult
from roslens.model.set_aside import SetAside
from roslens.store import rows
from roslens.store.columns import by_kind, measured_rows
from roslens.store.rows import Row
from roslens.store.summary import summarise


class UnitRows(msgspec.Struct, frozen=True, array_like=True):
    """Rows of each table, without the number of their unit; findings with their tags instead of the number of these.

    Attributes:
        package: its id.
        manifest: what it declares, as JSON.
        summary: as JSON.
        files: of the table of files; the others likewise.
    """

    package: str
    manifest: str
    summary: str
    files: list[tuple[object, ...]]
    entities: list[tuple[object, ...]]
    measured: list[tuple[object, ...]]
    findings: list[tuple[object, ...]]
    failures: list[tuple[object, ...]]
    set_aside: list[tuple[object, ...]]


def unit_rows(result: PackageResult, *, brief: bool = False) -> UnitRows:
    """Return the rows; findings are in order of their places.

    Args:
        result: of the package.
        brief: without what was measured of its files, classes and functions, which takes most of the room.

    Raises:
        UnicodeEncodeError: a text is none that UTF-8 can write, see :mod:`roslens.store.encodable`.
    """
    entities = by_kind(one for one in result.entities if not brief or one.kind is EntityKind.PACKAGE)
    return UnitRows(
        result.package.id,
        rows.to_json(result.package),
        rows.to_json(summarise(result)),
        list(rows.file_rows(result.files)),
        list(rows.entity_rows(entities)),
        list(measured_rows(entities)),
        rows_of_findings(result.findings),
        rows_of_failures(result.failures),
        rows_of_set_aside(result.set_aside),
    )


def rows_of_findings(findings: Iterable[Finding]) -> list[Row]:
    """Return the rows of findings, in order of their places."""
    return list(rows.finding_rows(sorted(findings, key=_place)))


def rows_of_failures(failures: Iterable[Failure]) -> list[Row]:
    """Return the rows of failures, in their order."""
    return list(rows.failure_rows(failures))


def rows_of_set_aside(items: Iterable[SetAside]) -> list[Row]:
    """Return the rows of what was set aside, in order of the places of their findings."""
    return list(rows.set_aside_rows(sorted(items, key=lambda one: _place(one.finding))))


def _place(finding: Finding) -> tuple[str, int, int, str, str, str]:
    return (finding.path, finding.line, finding.column, finding.rule, finding.entity, finding.message)

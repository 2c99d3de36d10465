"""The result as tables for spreadsheets: one CSV file per table, with a header line."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TextIO

from roslens.judge.quality.unusual import percentiles
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.result import PackageSummary
from roslens.model.tags import TagFilter
from roslens.report.writing.csv_table import Cell, Table, write_rows
from roslens.store.read import RunView


def write_findings(view: RunView, stream: TextIO, tags: TagFilter | None = None) -> None:
    """Write the table of findings.

    Args:
        view: the run.
        stream: where to; opened with ``newline=""`` if it is a file.
        tags: which findings are meant; all for None.

    Raises:
        StoreError: the store cannot be read.
        OSError: the stream cannot be written.
    """
    write_table(view, "findings", stream, tags)


def write_folder(view: RunView, folder: Path, tags: TagFilter | None = None) -> None:
    """Write every table into the folder, as ``<table>.csv``; what is there under these names is replaced.

    Raises:
        StoreError: the store cannot be read.
        OSError: the folder cannot be made or written; no file is left half written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for name in TABLES:
        part = folder / f"{name}.csv.part"
        try:
            with part.open("w", encoding="utf-8", newline="") as stream:
                write_table(view, name, stream, tags)
            part.replace(folder / f"{name}.csv")
        finally:
            part.unlink(missing_ok=True)


def write_table(view: RunView, name: str, stream: TextIO, tags: TagFilter | None = None) -> None:
    """Write one of :data:`TABLES`; only that of findings is filtered by ``tags``.

    Raises:
        KeyError: there is no such table.
        StoreError: the store cannot be read.
        OSError: the stream cannot be written.
    """
    write_rows(TABLES[name](view, tags or TagFilter()), stream)


def _packages(view: RunView, tags: TagFilter) -> Table:
    packages = view.packages()
    quantities = sorted({quantity for package in packages for quantity in package.values})
    head = (
        "id",
        "name",
        "path",
        "repository",
        "version",
        "build_type",
        "dependencies",
        "files",
        "classes",
        "functions",
    )
    counts = (*(f"{severity.value}s" for severity in Severity), "failures")
    standing = {package.id: percentiles(EntityKind.PACKAGE, package.values) for package in packages}
    known = sorted({key for found in standing.values() for key in found})
    return (
        (*head, *counts, *quantities, *(f"{key}.percentile" for key in known)),
        (
            (
                package.id,
                package.name,
                package.path,
                package.repository,
                package.version,
                package.build_type,
                " ".join(package.dependencies),
                package.files,
                package.classes,
                package.functions,
                *(_found(package, severity, tags) for severity in Severity),
                package.failures,
                *(package.values.get(quantity) for quantity in quantities),
                *(standing[package.id].get(key) for key in known),
            )
            for package in packages
        ),
    )


def _repositories(view: RunView, tags: TagFilter) -> Table:
    packages = {package.id: package for package in view.packages()}

    def rows() -> Iterator[tuple[Cell, ...]]:
        for one in view.header.repositories:
            inside = [packages[key] for key in one.packages if key in packages]
            found = (sum(_found(package, severity, tags) for package in inside) for severity in Severity)
            loc = sum(package.values.get("loc", 0) for package in inside)
            yield (one.name, one.path, one.url, one.version, one.commit, len(inside), loc, *found)

    head = ("name", "path", "url", "version", "commit", "packages", "loc")
    return ((*head, *(f"{severity.value}s" for severity in Severity)), rows())


def _found(package: PackageSummary, severity: Severity, tags: TagFilter) -> int:
    return sum(rule.count for rule in package.rules if rule.severity is severity and tags.matches(rule.tags))


def _files(view: RunView, _tags: TagFilter) -> Table:
    return (
        ("path", "package", "language", "role", "size", "content_hash"),
        (
            (file.path, package, file.language.value, file.role.value, file.size, file.content_hash)
            for package, file in view.files()
        ),
    )


def _entities(view: RunView, _tags: TagFilter) -> Table:
    quantities = view.measured()
    return (
        ("id", "kind", "name", "path", "line", "end_line", "parent", "approximate", *quantities),
        (
            (
                entity.id,
                entity.kind.value,
                entity.name,
                entity.path,
                entity.line,
                entity.end_line,
                entity.parent,
                "yes" if entity.approximate else "no",
                *(entity.values.get(quantity) for quantity in quantities),
            )
            for entity in view.entities()
        ),
    )


_FINDING_HEAD = (
    "rule",
    "severity",
    "message",
    "package",
    "path",
    "line",
    "column",
    "end_line",
    "end_column",
    "entity",
    "tags",
    "tool",
    "fingerprint",
    "gated",
    "model",
    "quantity",
    "value",
    "bound",
    "consequence",
    "certainty",
)


def _findings(view: RunView, tags: TagFilter) -> Table:
    return (_FINDING_HEAD, _finding_rows(view, tags))


def _finding_rows(view: RunView, tags: TagFilter) -> Iterator[tuple[Cell, ...]]:
    for package, finding in view.owned_findings(tags):
        yield (
            finding.rule,
            finding.severity.value,
            finding.message,
            package,
            finding.path,
            finding.line,
            finding.column,
            finding.end_line,
            finding.end_column,
            finding.entity,
            " ".join(finding.tags),
            finding.tool,
            finding.fingerprint,
            "yes" if finding.gated else "no",
            finding.model,
            finding.quantity,
            finding.value,
            finding.bound,
            finding.weight[0].value,
            finding.weight[1].value,
        )


def _set_aside(view: RunView, tags: TagFilter) -> Table:
    return (
        ("state", "reason", "by", "rule", "severity", "message", "package", "path", "line", "entity", "fingerprint"),
        (
            (
                one.state.value,
                one.reason,
                one.by,
                one.finding.rule,
                one.finding.severity.value,
                one.finding.message,
                one.package,
                one.finding.path,
                one.finding.line,
                one.finding.entity,
                one.finding.fingerprint,
            )
            for one in view.set_aside(tags=tags)
        ),
    )


def _failures(view: RunView, _tags: TagFilter) -> Table:
    return (
        ("tool", "what", "expected", "advice", "package", "path", "line", "column", "entity", "partial"),
        (
            (
                failure.tool,
                failure.what,
                failure.expected,
                failure.advice,
                failure.package,
                failure.location.path if failure.location else "",
                failure.location.line if failure.location else 0,
                failure.location.column if failure.location else 0,
                failure.entity,
                "yes" if failure.partial else "no",
            )
            for failure in view.failures()
        ),
    )


def _rules(view: RunView, _tags: TagFilter) -> Table:
    return (
        ("id", "title", "severity", "tags", "tool", "description", "rationale", "url", "consequence", "certainty"),
        (
            (
                rule.id,
                rule.title,
                rule.severity.value,
                " ".join(rule.tags),
                rule.tool,
                rule.description,
                rule.rationale,
                rule.url,
                rule.weight[0].value,
                "unproven" if rule.unproven else rule.weight[1].value,
            )
            for rule in view.rules()
        ),
    )


TABLES: dict[str, Callable[[RunView, TagFilter], Table]] = {
    "repositories": _repositories,
    "packages": _packages,
    "files": _files,
    "entities": _entities,
    "findings": _findings,
    "set_aside": _set_aside,
    "failures": _failures,
    "rules": _rules,
}
"""The tables by name. ``entities`` has a column for every quantity, which makes one of measurements superfluous."""

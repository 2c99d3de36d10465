"""Functions, classes and files ranked, with what is beyond the bounds of the run's models marked."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from roslens.dashboard.address import PageRef
from roslens.dashboard.measured import measured_on
from roslens.dashboard.site import Site
from roslens.dashboard.tables.field_column import field_cell, field_column
from roslens.dashboard.tables.finding_list import file_ref
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.model.entity import Entity, EntityKind
from roslens.model.result import PackageResult

_OF_FUNCTIONS = (
    "cyclomatic_complexity",
    "cognitive_complexity",
    "eloc",
    "loc",
    "nesting",
    "parameters",
    "calls",
    "static_paths",
)
_OF_CLASSES = ("wmc", "mac", "cbo", "dit", "noc", "lcom", "fan_in", "fan_out")
_OF_FILES = ("loc", "comment_ratio", "cyclomatic_complexity.max", "maintainability_index")


def functions_table(site: Site, functions: Sequence[Entity]) -> Table:
    """Return functions, the most complex first."""
    return _ranking(site, "functions", "Functions", EntityKind.FUNCTION, functions, _OF_FUNCTIONS)


def classes_table(site: Site, classes: Sequence[Entity]) -> Table:
    """Return classes, those with most weight first."""
    return _ranking(site, "classes", "Classes", EntityKind.CLASS, classes, _OF_CLASSES)


def _ranking(
    site: Site, name: str, title: str, kind: EntityKind, entities: Sequence[Entity], wanted: tuple[str, ...]
) -> Table:
    present = {key for entity in entities for key in entity.values}
    measured = measured_on(site.quantities, kind)
    keys = [key for key in wanted if key in present and key in measured]
    columns = (
        Column("name", kind.value.capitalize(), "code"),
        Column("path", "File", "code", optional=True),
        Column("line", "Line", "number", optional=True),
        *(
            Column(
                key,
                measured[key].title,
                "number",
                unit=measured[key].quantity.unit,
                hint=measured[key].quantity.text,
                decimals=measured[key].quantity.decimals,
                bar=place == 0,
            )
            for place, key in enumerate(keys)
        ),
        field_column(kind),
        Column("approximate", "Sure?", hint="Approximate where part of it could not be parsed", optional=True),
    )
    rows = tuple(
        (
            Cell(entity.name, ref=file_ref(site, entity.path, entity.line)),
            Cell(entity.path, ref=file_ref(site, entity.path)),
            Cell(entity.line or None),
            *(_value(site, kind, key, entity.values.get(key)) for key in keys),
            field_cell(kind, entity.values, site.quantities),
            Cell("approximate" if entity.approximate else ""),
        )
        for entity in entities
    )
    if not any(entity.approximate for entity in entities):
        columns, rows = columns[:-1], tuple(row[:-1] for row in rows)
    return Table(
        name,
        title,
        columns,
        rows,
        total=len(rows),
        sort=f"-{keys[0]}" if keys else "name",
        empty=f"No {title.lower()}.",
    )


def _value(site: Site, kind: EntityKind, key: str, value: float | None) -> Cell:
    rating = site.rating(kind, key, value) if value is not None else ""
    return Cell(value, rating="" if rating == "ok" else rating)


def files_table(site: Site, result: PackageResult) -> Table:
    """Return the files of a package with their findings."""
    values = {entity.path: entity.values for entity in result.entities if entity.kind is EntityKind.FILE}
    counts = Counter(finding.path for finding in result.findings)
    present = {key for found in values.values() for key in found}
    measured = measured_on(site.quantities, EntityKind.FILE)
    keys = [key for key in _OF_FILES if key in present and key in measured]
    columns = (
        Column("path", "File", "code"),
        Column("findings", "Findings", "number", bar=True),
        Column("language", "Language"),
        Column("role", "Code"),
        *(
            Column(
                key, measured[key].title, "number", unit=measured[key].quantity.unit, decimals=measured[key].decimals
            )
            for key in keys
        ),
        Column("size", "Size", "number", unit="bytes", optional=True),
    )
    rows = tuple(
        (
            Cell(file.path, ref=PageRef("file", file.path), text=_below(file.path, result.package.path)),
            Cell(counts[file.path]),
            Cell(file.language.value),
            Cell(file.role.value),
            *(_value(site, EntityKind.FILE, key, values.get(file.path, {}).get(key)) for key in keys),
            Cell(file.size),
        )
        for file in result.files
    )
    return Table("files", "Files", columns, rows, total=len(rows), sort="-findings", empty="No files.")


def _below(path: str, folder: str) -> str:
    return path.removeprefix(folder + "/") if folder not in {"", "."} else path

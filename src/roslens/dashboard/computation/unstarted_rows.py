"""What code makes that no known program starts, as a table: by package, and never drawn as a node that runs."""

from __future__ import annotations

from roslens.dashboard.computation.book import Book
from roslens.dashboard.computation.endpoint_rows import conditions_cell
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.model.configuration import ConfiguredEndpoint, ConfiguredNode
from roslens.model.unstarted import REASONS
from roslens.report.graph.unstarted_text import VERBS, unit_name

NAME = "unstarted"
_TITLE = "Started by no known program"
_COLUMNS = (
    Column("package", "Package", "name"),
    Column("unit", "Made by", "code"),
    Column("does", "Does"),
    Column("name", "Name", "name"),
    Column("type", "Type", "code"),
    Column("place", "Made at", "code"),
    Column("conditions", "Only if", "code", sparse=True),
    Column("reason", "Why"),
)
_SHORT = {"program": "not built", "script": "not started", "plugin": "not loaded", "library": "not used"}
"""Why it is in no node, so short that rows stay low; all of it is the hint, and in the twins."""


def unstarted_table(book: Book, generation: str = "", package: str = "") -> Table:
    """Return the table, of a version of ROS or of a package; code that is not the users' own is left out.

    What is of a version without a page of its own stands on those of the other one.
    """
    elsewhere = {one.configuration.generation for one in book.systems.values()} - {generation}
    rows = [
        _row(book, node, end)
        for one in book.unstarted
        if not generation or one.generation not in elsewhere
        for node in one.nodes
        if not node.role and package in ("", node.package)
        for end in node.endpoints
    ]
    identities = tuple(map(str, range(len(rows))))
    return Table(NAME, _TITLE, _COLUMNS, tuple(rows), total=len(rows), identities=identities, empty="Nothing.")


def _row(book: Book, node: ConfiguredNode, end: ConfiguredEndpoint) -> tuple[Cell, ...]:
    name = end.endpoint.name
    return (
        Cell(node.package, ref=book.package(node.package)),
        Cell(f"{node.kind} {unit_name(node)}"),
        Cell(VERBS[end.endpoint.role]),
        Cell(name, hint="" if end.resolved else f"given as {end.given}"),
        Cell(end.endpoint.type, text="" if end.endpoint.type else "unknown"),
        book.place(end.proof),
        conditions_cell(end.conditions),
        Cell(REASONS.get(node.kind, ""), text=_SHORT.get(node.kind, ""), hint=REASONS.get(node.kind, "")),
    )

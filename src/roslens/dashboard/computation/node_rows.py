"""The nodes that a package brings, as a table of its page."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.computation.book import Book, ref_of
from roslens.dashboard.computation.system import System
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.model.configuration import ConfiguredNode

NAME = "nodes"
_COLUMNS = (
    Column("node", "Node", "name"),
    Column("executable", "Executable", "code"),
    Column("place", "Defined at", "code"),
    Column("started", "Started by"),
    Column("findings", "Findings about it", "number"),
)


def nodes_table(book: Book, package: str) -> Table:
    """Return the nodes of a package, each name once, with the first configuration that starts it."""
    found: dict[tuple[str, str], list[tuple[System, int, ConfiguredNode]]] = {}
    for system in book.systems.values():
        for number, node in enumerate(system.nodes):
            if node.package == package:
                found.setdefault((node.name, node.executable), []).append((system, number, node))
    rows = tuple(_row(book, held) for _, held in sorted(found.items()))
    return Table(NAME, "Nodes", _COLUMNS, rows, total=len(rows), identities=tuple(map(str, range(len(rows)))))


def _row(book: Book, held: list[tuple[System, int, ConfiguredNode]]) -> tuple[Cell, ...]:
    system, number, node = held[0]
    element = system.elements[number]
    started = system.configuration.title + (f" and {len(held) - 1} more" if len(held) > 1 else "")
    return (
        Cell(node.name, ref=ref_of(system, element)),
        Cell(node.executable),
        book.place(node.defined),
        Cell(started, ref=PageRef("computation", system.slug, (("select", element.key),))),
        Cell(len(system.findings_on(element))),
    )

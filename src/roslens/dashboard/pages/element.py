"""The page of a node, topic, service or action in a report of a run: its interface, and the code behind it.

The code is the way on from a topic that is late: to the lines, what was found in them, and who changed them last.
"""

from __future__ import annotations

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.computation.book import ref_of
from roslens.dashboard.computation.element_pages import build_node, build_topic
from roslens.dashboard.computation.system import Kind
from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_list import FindingFilter, select
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.dashboard.view import Request, View
from roslens.model.finding import Severity

_COLUMNS = (
    Column("file", "File", "code"),
    Column("node", "Node", "name", sparse=True),
    Column("package", "Package", "name"),
    Column("findings", "Findings", "number", hint="in this file, of what counts for gates"),
    Column("worst", "Worst", "mark", sparse=True),
    Column("changed_by", "Last changed by", sparse=True),
    Column("changed", "On", "day", sparse=True),
    Column("commit", "Commit", "code", sparse=True),
    Column("subject", "Commit message", optional=True, sparse=True),
)


def build(site: Site, request: Request, page: str) -> View | None:
    """Return the page of a node or, with ``page`` topic, of a topic, service or action; None for an unknown one."""
    view = (build_node if page == "node" else build_topic)(site.book, request)
    found = site.book.find(page, request.key)
    if view is None or found is None:
        return view
    system, number = found
    is_node = system.elements[number].kind is Kind.NODE
    files: dict[tuple[str, int], int] = {}
    if is_node and (defined := system.nodes[number].defined) is not None and defined.path in site.places:
        files[defined.path, number] = defined.line
    for end in system.ends_of(number):
        proof = end.configured.proof
        if proof.path in site.places and not end.configured.implicit:
            files.setdefault((proof.path, end.node), proof.line)
    if not files:
        return view
    rows = tuple(
        (_file(path, line), _node(site, view, system.elements[node].name, node, is_node), *_about(site, path))
        for (path, node), line in files.items()
    )
    title = "Its code" if is_node else "The code at its ends"
    table = Table("code", title, _COLUMNS, rows, total=len(rows), identities=tuple(map(str, range(len(rows)))))
    return msgspec.structs.replace(view, tables=(table, *view.tables))


def _file(path: str, line: int) -> Cell:
    text = f"{path}:{line}" if line else path
    return Cell(text, ref=PageRef("file", path, anchor=f"L{line}" if line else ""))


def _node(site: Site, view: View, name: str, number: int, is_node: bool) -> Cell:
    if is_node:
        return Cell()
    system = site.book.systems[view.ref.key.partition("/")[0]]
    return Cell(name, ref=ref_of(system, system.elements[number]))


def _about(site: Site, path: str) -> tuple[Cell, ...]:
    package = site.places[path].package
    found = [one for one in select(site, FindingFilter(path=path)) if one.gated]
    worst = max((one.severity for one in found), key=lambda severity: severity.rank, default=Severity.NOTE)
    change = site.last_change(path)
    return (
        Cell(package, ref=PageRef("package", package)),
        Cell(len(found), ref=PageRef("file", path, anchor="findings") if found else None),
        Cell(worst.value if found else None),
        Cell(change.author if change else None),
        Cell(change.date if change else None),
        Cell(change.commit if change else None),
        Cell(change.subject if change else None),
    )

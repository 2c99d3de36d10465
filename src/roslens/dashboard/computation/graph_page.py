"""The computation graph of one configuration, with a table of its nodes and one of its endpoints."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.computation.book import Book, ref_of
from roslens.dashboard.computation.endpoint_rows import conditions_cell, endpoint_table
from roslens.dashboard.computation.finding_rows import finding_tables
from roslens.dashboard.computation.noise import DEFAULT, NONE, PRESETS, presets_of
from roslens.dashboard.computation.picture import Left, style_of
from roslens.dashboard.computation.system import KIND_OF_ROLE, Kind, System
from roslens.dashboard.computation.unstarted_rows import unstarted_table
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.model.graphs.completeness import completeness_of

_ENDPOINTS = ("node", "does", "name", "type", "qos", "place", "conditions", "sure", "callback", "more")


def build(book: Book, request: Request) -> View | None:
    """Return the page; None for an unknown configuration."""
    system = book.systems.get(request.key)
    if system is None:
        return None
    query = request.query
    left = Left(presets_of(",".join(query.all("noise"))), query.all("hide"))
    graph = book.graph(system, left)
    wanted = query.get("topics")
    as_lines = graph.many if wanted not in {"lines", "marks"} else wanted == "lines"
    nodes = sort_rows(_nodes(book, system), query.get("sort_nodes"))
    endpoints = _endpoints(book, system, request)
    sure, doubted = (sort_rows(table, query.get(f"sort_{table.name}")) for table in finding_tables(book, system))
    loose = unstarted_table(book, system.configuration.generation)
    loose = sort_rows(loose, query.get(f"sort_{loose.name}"), None if request.complete else request.limits.rows)
    known = completeness_of(system.configuration)
    return View(
        ref=PageRef("computation", system.slug, query=query.pairs),
        title=f"Computation graph: {system.configuration.title}",
        facts={
            "configuration": {
                "slug": system.slug,
                "title": system.configuration.title,
                "generation": system.configuration.generation,
                "arguments": msgspec.to_builtins(system.configuration.arguments),
                "included": list(system.configuration.included),
            },
            "left_out": {"presets": sorted(left.presets), "patterns": list(left.patterns)},
            "elements": [_element(book, system, number) for number in range(len(system.elements))],
            "wires": msgspec.to_builtins(system.wires),
            "findings": msgspec.to_builtins(system.findings),
            "counted": book.counted,
            "unresolved": msgspec.to_builtins(system.configuration.unresolved),
            "completeness": msgspec.to_builtins(known),
            "note": book.note,
        },
        tables=(nodes, endpoints, sure, doubted, *((loose,) if loose.total else ())),
        shown={
            "note": book.note,
            "known": known,
            "counted": book.counted,
            "system": system,
            "systems": alike(book.systems.values()),
            "graph": graph,
            "drawing": graph.lines if as_lines else graph.topics,
            "as_lines": as_lines,
            "drawn": graph.flows if as_lines else graph.wires,
            "refs": [ref_of(system, element) for element in system.elements],
            "style_of": style_of,
            "presets": PRESETS,
            "left": left,
            "noise": noise_text(left.presets),
            "picture": _picture(system, graph, left, as_lines=as_lines),
            "unresolved": [(one, book.place(one.proof)) for one in system.configuration.unresolved],
            "counts": _counts(system, set(graph.topics.places)),
            "loose": loose.total,
            "hidden": len(system.elements) - len(graph.topics.places),
        },
    )


def alike(systems: Iterable[System]) -> tuple[tuple[System, ...], ...]:
    """Return the systems, those that start nodes of the same names together, each kind where its first one stands."""
    found: dict[tuple[str, ...], list[System]] = {}
    for system in systems:
        names = tuple(sorted(node.name for node in system.nodes))
        # Of what starts nothing, or no name that is known, it is not said that it is the same.
        key = names if any(node.resolved for node in system.nodes) else (system.slug, "")
        found.setdefault(key, []).append(system)
    return tuple(map(tuple, found.values()))


def _endpoints(book: Book, system: System, request: Request) -> Table:
    """Return the table of endpoints; where it is cut, what every node has goes first."""
    most = None if request.complete else request.limits.rows
    ends = list(enumerate(system.ends))
    if most is not None and len(ends) > most:
        ends.sort(key=lambda pair: pair[1].configured.implicit)
    table = endpoint_table(book, system, ends, _ENDPOINTS, "endpoints", "Endpoints")
    return sort_rows(table, request.query.get("sort_endpoints"), most)


def noise_text(presets: frozenset[str]) -> str:
    """Return the presets as an address names them: nothing for the default ones."""
    if presets == DEFAULT:
        return ""
    return ",".join(preset.key for preset in PRESETS if preset.key in presets) or NONE


def _picture(system: System, graph: object, left: Left, *, as_lines: bool) -> dict[str, object]:
    """Return what the script needs."""
    found: dict[str, object] = dict(msgspec.to_builtins(graph, str_keys=True))
    found["nodes"] = found.pop("marks")
    found["ends"] = [wire.endpoints for wire in system.wires]
    found["presets"] = [preset.key for preset in PRESETS]
    found["default"] = sorted(DEFAULT)
    found["about"] = [system.elements_of(finding) for finding in system.findings]
    found["drawn"] = {"noise": sorted(left.presets), "hide": list(left.patterns), "lines": as_lines}
    return found


def _element(book: Book, system: System, number: int) -> dict[str, object]:
    element = system.elements[number]
    found: dict[str, object] = dict(msgspec.to_builtins(element))
    node = system.nodes[number] if number < len(system.nodes) else None
    if node:
        found |= {"place": book.place(node.proof).value, "package": node.package, "executable": node.executable}
    found["findings"] = [finding.message for finding in system.findings_on(element)]
    return found


def _counts(system: System, visible: set[int]) -> dict[str, int]:
    """Return how many of each kind are shown."""
    found = {kind.value: sum(system.elements[number].kind is kind for number in visible) for kind in Kind}
    return {kind: count for kind, count in found.items() if count or kind == "node"}


def _nodes(book: Book, system: System) -> Table:
    columns = (
        Column("node", "Node", "name"),
        Column("kind", "Kind"),
        Column("package", "Package", "name"),
        Column("executable", "Executable", "code", sparse=True),
        Column("started", "Started at", "code"),
        Column("defined", "Defined at", "code"),
        Column("conditions", "Only if", "code", sparse=True),
        Column("sure", "Sure"),
        Column("endpoints", "Endpoints", "number", hint="without those that every node has"),
        Column("findings", "Findings", "number"),
    )
    rows = []
    for node, element in zip(system.nodes, system.elements, strict=False):
        rows.append(
            (
                Cell(node.name, ref=ref_of(system, element)),
                Cell(node.kind),
                Cell(node.package),
                Cell(node.executable),
                book.place(node.proof),
                book.place(node.defined),
                conditions_cell(node.conditions),
                Cell(node.proof.sure if node.resolved else f"{node.proof.sure}, name not resolved"),
                Cell(sum(not one.implicit for one in node.endpoints if one.endpoint.role in KIND_OF_ROLE)),
                Cell(len(system.findings_on(element))),
            )
        )
    identities = tuple(str(number) for number in range(len(rows)))
    return Table("nodes", "Nodes", columns, tuple(rows), total=len(rows), identities=identities, empty="No nodes.")

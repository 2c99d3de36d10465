"""A page per node, its interface with what shows it; and per topic, service or action, with who is at which end."""

from __future__ import annotations

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.computation.book import Book, ref_of
from roslens.dashboard.computation.endpoint_rows import conditions_cell, endpoint_table
from roslens.dashboard.computation.system import Element, Kind, System
from roslens.dashboard.tables.table import Cell, Column, Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.model.configuration import ConfiguredNode, ConfiguredParameter, Proof
from roslens.model.graph import Role
from roslens.report.run.fix_first import gravity

_SECTIONS = (
    ("publishes", "Publishes", (Role.PUBLISHER,)),
    ("subscribes", "Subscribes to", (Role.SUBSCRIPTION,)),
    ("serves", "Serves", (Role.SERVICE_SERVER, Role.ACTION_SERVER)),
    ("calls", "Calls", (Role.SERVICE_CLIENT, Role.ACTION_CLIENT)),
)
_SIDES = {
    Kind.TOPIC: (
        ("publishers", "Publishers", Role.PUBLISHER, "No node of this configuration publishes."),
        ("subscriptions", "Subscriptions", Role.SUBSCRIPTION, "No node of this configuration subscribes."),
    ),
    Kind.SERVICE: (
        ("servers", "Servers", Role.SERVICE_SERVER, "It has no server."),
        ("clients", "Clients", Role.SERVICE_CLIENT, "It has no client."),
    ),
    Kind.ACTION: (
        ("servers", "Servers", Role.ACTION_SERVER, "It has no server."),
        ("clients", "Clients", Role.ACTION_CLIENT, "It has no client."),
    ),
}
_OF_NODE = ("name", "type", "qos", "place", "conditions", "callback", "sure", "more")
_OF_TOPIC = ("node", "type", "qos", "hash", "place", "conditions", "callback", "sure", "more")


def build_node(book: Book, request: Request) -> View | None:
    """Return the page of a node; None for an unknown one."""
    found = book.find("node", request.key)
    if found is None:
        return None
    system, number = found
    node, element = system.nodes[number], system.elements[number]
    ends = [(place, end) for place, end in enumerate(system.ends) if end.node == number]
    own = [(place, end) for place, end in ends if not end.configured.implicit]
    # What has a name leads somewhere.
    own.sort(key=lambda one: not one[1].configured.resolved)
    # Of a node without source here, that it has none of these would be a guess.
    nothing = "None." if node.defined is not None or own else "Not known: its source was not found in this workspace."
    tables = [
        endpoint_table(
            book,
            system,
            [(place, end) for place, end in own if end.configured.endpoint.role in roles],
            ("does", *_OF_NODE) if len(roles) > 1 else _OF_NODE,
            name,
            title,
            nothing,
        )
        for name, title, roles in _SECTIONS
    ]
    rest = [(place, end) for place, end in ends if end.configured.implicit]
    tables += [
        _parameters(book, node),
        *_overrides(book, node),
        _timers(book, node),
        _remaps(book, node),
        endpoint_table(book, system, rest, ("does", "name", "type", "qos"), "implicit", "What every node has"),
    ]
    return _view(
        book,
        request,
        system,
        element,
        tables,
        facts={"node": {key: value for key, value in _node_facts(node).items() if value}},
        shown={
            "facts": _node_rows(book, system, node),
            "unknown": node.defined is None and not own,
            "unresolved": [
                (one, book.place(one.proof)) for one in system.configuration.unresolved if one.node == node.name
            ],
        },
    )


def build_topic(book: Book, request: Request) -> View | None:
    """Return the page of a topic, service or action; None for an unknown one."""
    found = book.find("topic", request.key)
    if found is None:
        return None
    system, number = found
    element = system.elements[number]
    ends = [(place, end) for place, end in enumerate(system.ends) if end.channel == number]
    tables = [
        endpoint_table(
            book,
            system,
            [(place, end) for place, end in ends if end.configured.endpoint.role is role],
            _OF_TOPIC,
            name,
            title,
            empty,
        )
        for name, title, role, empty in _SIDES[element.kind]
    ]
    types = sorted({end.configured.endpoint.type for _, end in ends} - {""})
    hashes = sorted({end.configured.endpoint.hash for _, end in ends} - {""})
    rows = [("Type", Cell(", ".join(types) or "unknown"))]
    if hashes:
        rows.append(("Hash", Cell(", ".join(hashes))))
    return _view(
        book,
        request,
        system,
        element,
        tables,
        facts={"topic": {"name": element.name, "kind": element.kind.value, "types": types, "hashes": hashes}},
        shown={"facts": rows, "unresolved": []},
    )


def _view(
    book: Book,
    request: Request,
    system: System,
    element: Element,
    tables: list[Table],
    *,
    facts: dict[str, object],
    shown: dict[str, object],
) -> View:
    page = "node" if element.kind is Kind.NODE else "topic"
    findings = sorted(system.findings_on(element), key=gravity)
    ordered = [
        sort_rows(table, request.query.get(f"sort_{table.name}"), None if request.complete else request.limits.rows)
        for table in tables
    ]
    return View(
        ref=PageRef(page, request.key, query=request.query.pairs),
        title=element.name,
        facts={"configuration": system.slug, **facts, "findings": msgspec.to_builtins(findings)},
        tables=tuple(ordered),
        shown={
            "note": book.note,
            "element": element,
            "system": system,
            "findings": [(one, book.place(Proof(one.path, one.line))) for one in findings],
            **shown,
        },
    )


def _node_facts(node: ConfiguredNode) -> dict[str, object]:
    kept = (
        "name",
        "package",
        "executable",
        "kind",
        "unit",
        "container",
        "machine",
        "anonymous",
        "conditions",
        "resolved",
    )
    return {key: value for key in kept if (value := getattr(node, key))}


def _node_rows(book: Book, system: System, node: ConfiguredNode) -> list[tuple[str, Cell]]:
    """Return what is said of the node besides its tables, as (title, cell)."""
    inside = [other for other in system.nodes if other.container == node.name]
    holder = next((place for place, other in enumerate(system.nodes) if other.name == node.container), None)
    rows = [
        ("Started at", book.place(node.proof)),
        ("Defined at", book.place(node.defined)),
        ("In code", Cell(_unit(node))),
        ("Package", Cell(node.package, ref=book.package(node.package))),
        ("Executable", Cell(node.executable)),
        ("Only if", Cell(" and ".join(node.conditions))),
        (
            "Loaded into",
            Cell(node.container, ref=ref_of(system, system.elements[holder]) if holder is not None else None),
        ),
        ("Holds", Cell(", ".join(other.name for other in inside))),
        ("Machine", Cell(node.machine)),
        ("Name", Cell("gets a random end" if node.anonymous else "")),
    ]
    return [(title, cell) for title, cell in rows if cell.value]


def _unit(node: ConfiguredNode) -> str:
    """Return the class or function of the node as its language writes it."""
    path = node.defined.path if node.defined is not None else ""
    return node.unit if path.endswith(".py") else node.unit.replace(".", "::")


def _parameters(book: Book, node: ConfiguredNode) -> Table:
    columns = (
        Column("name", "Parameter", "name"),
        Column("value", "Value", "code"),
        Column("type", "Type", "code"),
        Column("default", "Default", "code", sparse=True),
        Column("range", "Range", "code", sparse=True),
        Column("terms", "Terms", sparse=True),
        Column("access", "In code", sparse=True),
        Column("place", "Declared or read at", "code", sparse=True),
        Column("set_by", "Set at", "code", sparse=True),
        Column("written_by", "Written at", "code", optional=True, sparse=True),
        Column("conditions", "Only if", "code", optional=True, sparse=True),
        Column("description", "Description", optional=True, sparse=True),
    )
    rows = tuple(
        (
            Cell(one.name),
            Cell(one.value, text="" if one.value is not None else "unknown"),
            Cell(one.type if one.set_type in {"", one.type} else f"{one.type}, set as {one.set_type}"),
            Cell(one.default),
            Cell(one.range),
            Cell(_terms(one)),
            Cell(one.access),
            book.place(one.proof),
            book.place(one.set_by),
            book.place(one.written_by),
            conditions_cell(one.conditions),
            Cell(one.description),
        )
        for one in node.parameters
        if not one.repeats_an_endpoint
    )
    return Table("parameters", "Parameters", columns, rows, total=len(rows), empty="None.")


def _overrides(book: Book, node: ConfiguredNode) -> list[Table]:
    """Return a table of parameters that would change the quality of service of endpoints, if any are not set."""
    columns = (
        Column("name", "Parameter", "name"),
        Column("value", "Value", "code"),
        Column("type", "Type", "code"),
        Column("place", "Declared at", "code"),
    )
    rows = tuple(
        (
            Cell(one.name),
            Cell(one.value, text="" if one.value is not None else "unknown"),
            Cell(one.type),
            book.place(one.proof),
        )
        for one in node.parameters
        if one.repeats_an_endpoint
    )
    return [Table("overrides", "QoS overrides not set", columns, rows, total=len(rows))] if rows else []


def _terms(one: ConfiguredParameter) -> str:
    words = ["read only"] if one.read_only else []
    words += ["of any type"] if one.dynamic else []
    words += [f"one of {', '.join(one.allowed)}"] if one.allowed else []
    return "; ".join((*words, *one.constraints))


def _timers(book: Book, node: ConfiguredNode) -> Table:
    columns = (
        Column("period", "Period", "number", unit="s", decimals=3),
        Column("rate", "Rate", "number", unit="Hz", decimals=2),
        Column("callback", "Callback", "code"),
        Column("group", "Callback group", sparse=True),
        Column("place", "Made at", "code"),
    )
    rows = tuple(
        (
            Cell(one.period_s),
            Cell(1 / one.period_s if one.period_s else None),
            Cell(one.callback),
            Cell(one.group),
            book.place(one.proof),
        )
        for one in node.timers
    )
    return Table("timers", "Timers", columns, rows, total=len(rows), empty="None.")


def _remaps(book: Book, node: ConfiguredNode) -> Table:
    columns = (
        Column("source", "Remapping of", "code"),
        Column("target", "to", "code"),
        Column("used", "Matched"),
        Column("place", "Written at", "code"),
    )
    rows = tuple(
        (
            Cell(one.source),
            Cell(one.target),
            Cell("not known" if one.uncertain else "yes" if one.used else "nothing"),
            book.place(one.proof),
        )
        for one in node.remaps
    )
    return Table("remaps", "Remappings", columns, rows, total=len(rows), empty="None.")

"""Endpoints as rows of tables, the same cells on every page."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from roslens.dashboard.computation.book import Book, ref_of
from roslens.dashboard.computation.system import End, System
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.model.configuration import ConfiguredEndpoint
from roslens.model.graphs.end import VERB
from roslens.model.qos import Qos

_LONGEST_CONDITION = 100

COLUMNS = {
    "node": Column("node", "Node", "name"),
    "does": Column("does", "Does"),
    "name": Column("name", "Name", "name"),
    "type": Column("type", "Type", "code"),
    "qos": Column("qos", "Quality of service", sparse=True),
    "place": Column("place", "Made at", "code"),
    "conditions": Column("conditions", "Only if", "code", sparse=True),
    "sure": Column("sure", "Sure"),
    "callback": Column("callback", "Callback", "code", optional=True, sparse=True),
    "hash": Column("hash", "Hash", "code", optional=True, sparse=True),
    "more": Column("more", "Notes", optional=True, sparse=True),
}


def endpoint_table(
    book: Book,
    system: System,
    ends: Iterable[tuple[int, End]],
    columns: Sequence[str],
    name: str,
    title: str,
    empty: str = "None.",
) -> Table:
    """Return a table of endpoints.

    Args:
        book: knows which files have a page.
        system: that the endpoints are of.
        ends: with their numbers in the system, which identify the rows.
        columns: keys of :data:`COLUMNS`.
        name: of the table.
        title: of the table.
        empty: what is said where there are none.
    """
    rows, identities = [], []
    for number, end in ends:
        cells = _cells(book, system, end)
        rows.append(tuple(cells[key] for key in columns))
        identities.append(str(number))
    found = tuple(COLUMNS[key] for key in columns)
    return Table(name, title, found, tuple(rows), total=len(rows), identities=tuple(identities), empty=empty)


def _cells(book: Book, system: System, end: End) -> dict[str, Cell]:
    one = end.configured
    node, channel = system.elements[end.node], system.elements[end.channel]
    return {
        "node": Cell(node.name, ref=ref_of(system, node)),
        "does": Cell(VERB[one.endpoint.role] + (f" ({channel.kind.value})" if channel.kind.value != "topic" else "")),
        "name": Cell(
            one.endpoint.name, ref=ref_of(system, channel), hint="" if one.resolved else f"given as {one.given}"
        ),
        "type": Cell(one.endpoint.type, text="" if one.endpoint.type else "unknown"),
        "qos": Cell(qos_text(one)),
        "place": book.place(one.proof),
        "conditions": conditions_cell(one.conditions),
        "sure": Cell(one.proof.sure if one.resolved else f"{one.proof.sure}, name not resolved", hint=one.proof.how),
        "callback": _callback(one.callback),
        "hash": Cell(one.endpoint.hash),
        "more": _notes(one),
    }


def conditions_cell(conditions: Sequence[str]) -> Cell:
    """Return conditions; of many words the first, the rest is left to the hint and to the twins."""
    text = " and ".join(conditions)
    if len(text) <= _LONGEST_CONDITION:
        return Cell(text)
    return Cell(text, text=text[: _LONGEST_CONDITION - 1].rstrip() + "…", hint=text)


def _callback(name: str) -> Cell:
    """Return a callback by the last two parts of its name: the class and the function."""
    parts = name.split(".")
    return Cell(name, text=".".join(parts[-2:]), hint=name) if len(parts) > 2 else Cell(name)


def _notes(one: ConfiguredEndpoint) -> Cell:
    """Return the notes; the place of a remapping, long and without a gap, is left to the hint."""
    text = notes(one)
    if one.remapped is None or not one.remapped.place:
        return Cell(text)
    return Cell(text, text=text.replace(f" at {one.remapped.place}", "", 1), hint=text)


def notes(one: ConfiguredEndpoint) -> str:
    """Return in words what else is known: remapping, group, where from if not from code."""
    found = []
    if one.remapped:
        found.append(f"remapped at {one.remapped.place}" if one.remapped.place else "remapped")
    if one.group:
        found.append(f"callback group {one.group}")
    if one.proof.origin.value not in {"code", "launch"}:
        found.append(
            {"catalogue": "known of this package", "hint": "said in roslens.toml", "implicit": "every node has it"}[
                one.proof.origin.value
            ]
        )
    return "; ".join(found)


def qos_text(one: ConfiguredEndpoint) -> str:
    """Return the quality of service, or queue and latch of ROS 1, in words."""
    if one.endpoint.qos is None:
        found = [f"queue {one.queue}"] if one.queue >= 0 else []
        return ", ".join([*found, *(["latched"] if one.latched else [])]) or one.qos_unknown
    text = policies(one.endpoint.qos)
    return f"{text}; {one.qos_unknown}" if one.qos_unknown else text


def policies(qos: Qos) -> str:
    """Return policies as words; what is unknown or the default of every endpoint is left out."""
    found = [qos.reliability.replace("_", " "), qos.durability.replace("_", " ")]
    history = qos.history.replace("_", " ")
    found.append(f"{history} {qos.depth}" if qos.depth and qos.history != "keep_all" else history)
    found += [
        f"{title} {seconds:g} s"
        for title, seconds in (("deadline", qos.deadline_s), ("lifespan", qos.lifespan_s), ("lease", qos.lease_s))
        if seconds
    ]
    if qos.liveliness not in {"", "automatic"}:
        found.append(f"liveliness {qos.liveliness.replace('_', ' ')}")
    return ", ".join(part for part in found if part)

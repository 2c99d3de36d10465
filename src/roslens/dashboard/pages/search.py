"""What has a given text in its name: packages, rules, metrics, files."""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from textwrap import shorten

from roslens.dashboard.address import PageRef
from roslens.dashboard.pages.entity import page_of
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.dashboard.view import Request, View
from roslens.model.source import Role

MOST = 50
MOST_OF_ALL = 2000
"""Maximum number of rows if all are requested."""


def build(site: Site, request: Request) -> View | None:
    """Return the page with the best matches."""
    text = request.query.get("q").strip()
    needle = text.casefold()
    found = [entry for entry in everything(site) if needle and needle in _searched(*entry[:3])]
    most = MOST_OF_ALL if request.query.get("show") == "all" or request.complete else MOST
    best = heapq.nsmallest(most, enumerate(found), key=lambda item: (_order(needle, *item[1][:3]), item[0]))
    rows = tuple((Cell(kind), Cell(name, ref=ref), Cell(more)) for _, (kind, name, more, ref) in best)
    columns = (Column("kind", "Kind"), Column("name", "Name", "name"), Column("more", "What it is"))
    empty = "Nothing has this in its name." if text else "Type a part of a name."
    every = PageRef("search", query=request.query.replaced(show="all"))
    table = Table(
        "results", "Results", columns, rows, total=len(found), empty=empty, all=every if most == MOST else None
    )
    return View(
        ref=PageRef("search", query=request.query.pairs),
        title="Search",
        facts={"text": text},
        tables=(table,),
        shown={"text": text},
    )


def _searched(kind: str, name: str, more: str) -> str:
    """Return where a text is looked for; the role of a file is what a reader sees, no name of it."""
    return name.casefold() if kind == "file" else f"{name} {more}".casefold()


def _order(needle: str, kind: str, name: str, more: str) -> tuple[int, int, bool, int]:
    """Order by how well the name fits; among whole names and beginnings packages come first, then files of own code."""
    rank, length = _rank(needle, name)
    own = name.casefold().rpartition("/")[2]
    if kind in _FIRST and rank > 1 and needle in own:
        rank = 1
    return (rank, _FIRST.index(kind) if kind in _FIRST else len(_FIRST), kind == "file" and bool(more), length)


def everything(site: Site) -> Iterator[tuple[str, str, str, PageRef]]:
    """Yield kind, name, what it is and page of all that can be searched for."""
    for package in site.packages:
        yield "package", package.id, _brief(package.description), PageRef("package", package.id)
    yield from _elements(site)
    yield from _running(site)
    for key, quantity in site.quantities.items():
        yield "metric", quantity.title, key, PageRef("metric", key)
    for rule in site.rules.values():
        yield "rule", rule.id, rule.title, PageRef("rule", rule.id)
    for path, place in site.places.items():
        role = place.file.role
        yield "file", path, "" if role is Role.OWN else role.value, PageRef("file", path)


def _elements(site: Site) -> Iterator[tuple[str, str, str, PageRef]]:
    """Yield nodes, topics, services and actions, each name once, with the page of the first graph that has it."""
    found: dict[tuple[str, str], tuple[str, PageRef, int]] = {}
    for ref in site.book.refs():
        if ref.page != "computation" and (held := site.book.find(ref.page, ref.key)):
            system, number = held
            element = system.elements[number]
            title, first, count = found.get((element.kind.value, element.name), (system.configuration.title, ref, 0))
            found[element.kind.value, element.name] = (title, first, count + 1)
    for (kind, name), (title, ref, count) in found.items():
        yield kind, name, title if count == 1 else f"in {count} launch files", ref


def _running(site: Site) -> Iterator[tuple[str, str, str, PageRef]]:
    """Yield hosts, nodes and topics that are watched and that no graph read from source has."""
    for one in site.running():
        if one.kind in _WATCHED and one.name and page_of(site, one.entity) is None:
            yield one.kind, one.name, "running", PageRef("entity", query=(("id", one.entity),))


_WATCHED = ("host", "node", "topic", "service", "action")
_FIRST = ("package", "file")


def _rank(needle: str, name: str) -> tuple[int, int]:
    """Order: the whole name, then its beginning, then the beginning of its last part, then anywhere; short first."""
    folded = name.casefold()
    # Users omit the slash that every name of ROS begins with.
    if folded in (needle, f"/{needle}"):
        return (0, 0)
    if folded.startswith(needle):
        return (1, len(name))
    if folded.rpartition("/")[2].startswith(needle):
        return (2, len(name))
    return (3, len(name))


def _brief(text: str) -> str:
    """Return the beginning of a text up to a word, with a sign where more follows."""
    return shorten(text, 110, placeholder=" …")

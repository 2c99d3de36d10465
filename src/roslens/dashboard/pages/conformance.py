"""Expected against actual: differences between extracted source, the running system, recordings and references."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import msgspec

from roslens.compare.conformance.claim import NODE, PARAMETER, TOPIC
from roslens.compare.conformance.disparity import Conformance, Disparity
from roslens.compare.conformance.explain import RUNNING
from roslens.compare.conformance.side import Side, SideKind
from roslens.dashboard.address import PageRef
from roslens.dashboard.computation.book import ref_of
from roslens.dashboard.computation.difference_picture import (
    SIGNS,
    WORDS,
    DifferencePicture,
    Standing,
    difference_picture,
)
from roslens.dashboard.computation.system import KIND_OF_ROLE, System
from roslens.dashboard.pages.entity import page_of
from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_list import file_ref
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.dashboard.view import Request, View
from roslens.model.errors import RoslensError
from roslens.model.finding import Severity
from roslens.model.graph import Role

KIND_WORDS = {"source": "Source", "running": "Running", "recording": "Recorded", "reference": "Expected"}
"""The heading of a side's column, by its kind."""
FIRST = 12
"""Rows of differences before the picture; all of them where they are asked for."""
_OVER = {RUNNING: "what ran"}
"""Who is right, said of a recording."""
HIGHEST_LEFT = 2000
"""Maximum number of rows in a table; the CSV twin has all."""


def build(site: Site, request: Request) -> View:
    """Return the page of the configuration that is asked for, or of the one that fits best."""
    against = site.against
    ref = PageRef("conformance", query=request.query.pairs)
    names = [system.slug for system in site.book.systems.values()]
    if against is None or not names:
        return View(ref, "Expected against actual", {}, shown={"found": None, "problem": "", "names": names})
    chosen = request.query.get("configuration")
    chosen = chosen if chosen in names else ""
    try:
        name, found, others = against(chosen)
    except RoslensError as error:
        shown = {"found": None, "problem": str(error), "names": names}
        return View(ref, "Expected against actual", {"problem": str(error)}, shown=shown)
    limit = None if request.complete else HIGHEST_LEFT
    first = FIRST if limit and request.query.get("show") != "all" else limit
    system = site.book.systems.get(name)
    grave = [one for one in found.disparities if one.severity is not Severity.NOTE]
    notes = [one for one in found.disparities if one.severity is Severity.NOTE]
    counts = Counter(one.severity.value for one in found.disparities)
    return View(
        ref,
        "Expected against actual",
        {
            "configuration": name,
            "sides": [{"title": title, "kind": kind} for title, kind in zip(found.titles, found.kinds, strict=True)],
            "agreed": found.agreed,
            "notes": list(found.notes),
        },
        tables=(
            msgspec.structs.replace(
                _table(site, system, found, "differences", "Differences", grave, first),
                all=PageRef("conformance", query=request.query.replaced(show="all", configuration=name)),
            ),
            _table(site, system, found, "notes", "As it should be, or undecided", notes, limit),
        ),
        shown={
            "found": found,
            "problem": "",
            "names": names,
            "chosen": name,
            "note": site.book.note,
            "counts": counts,
            "picture": _picture(site, system, found, others) if system else None,
            "words": WORDS,
            "signs_of": SIGNS,
            "standings": {one.value: one for one in Standing},
            "signs": [(one.value, SIGNS[one], WORDS[one]) for one in Standing if one is not Standing.ALIKE],
            "sides": list(zip(found.titles, (KIND_WORDS[kind] for kind in found.kinds), strict=True)),
        },
    )


def _table(
    site: Site, system: System | None, found: Conformance, name: str, title: str, rows: Sequence[Disparity],
    limit: int | None,
) -> Table:  # fmt: skip
    sides = tuple(
        # Of two recordings, the heading names which.
        Column(f"side{place}", side if found.kinds.count(kind) > 1 else KIND_WORDS[kind], "code", hint=side)
        for place, (side, kind) in enumerate(zip(found.titles, found.kinds, strict=True))
    )
    columns = (
        Column("severity", "Severity", "mark"),
        Column("what", "What", "code"),
        Column("aspect", "Differs in", optional=True),
        *sides,
        Column("right", "Correct side"),
        Column("why", "Why", "prose"),
        Column("place", "Place", "code", optional=True, sparse=True),
    )
    cells = tuple(_row(site, system, found, one) for one in rows[:limit])
    return Table(name, title, columns, cells, len(rows), empty="Nothing differs.")


def _row(site: Site, system: System | None, found: Conformance, one: Disparity) -> tuple[Cell, ...]:
    path, _, line = one.place.rpartition(":")
    goes = "goes" if one.also == 1 else "go"
    also = f" {one.also} of its endpoints and parameters {goes} with it." if one.also else ""
    return (
        Cell(one.severity.value),
        Cell(one.subject, ref=_page(site, system, one), hint=one.reason.value.replace("_", " ")),
        Cell(one.aspect.value),
        *(Cell(text) for text in one.values),
        Cell(one.right if SideKind.RUNNING.value in found.kinds else _OVER.get(one.right, one.right)),
        Cell(one.why + also),
        Cell(one.place, ref=file_ref(site, path, int(line)) if path and line.isdecimal() else None),
    )


def _page(site: Site, system: System | None, one: Disparity) -> PageRef | None:
    """Return the page of the node or of what it speaks over: of this configuration, of another one, or of what runs."""
    if one.kind in (NODE, PARAMETER):
        kind, wanted = NODE, one.node
    else:
        kind, wanted = TOPIC if one.kind == TOPIC else KIND_OF_ROLE[Role(one.kind)].value, one.name
    if system is not None:
        for element in system.elements:
            if element.name == wanted and element.kind.value == kind and (ref := ref_of(system, element)) is not None:
                return ref
    return _elsewhere(site, f"{kind}:{wanted}")


def _elsewhere(site: Site, entity: str) -> PageRef | None:
    """Return the page of what this configuration does not have; None where nothing but the other side tells of it."""
    found = page_of(site, entity)
    if found is None and any(one.entity == entity for one in site.running()):
        return PageRef("entity", query=(("id", entity),))
    return found


def _picture(site: Site, system: System, found: Conformance, others: Sequence[Side]) -> DifferencePicture:
    made = difference_picture(system, found.disparities, others)
    elements = tuple(
        one if one.ref is not None else msgspec.structs.replace(one, ref=_elsewhere(site, one.key))
        for one in made.elements
    )
    return msgspec.structs.replace(made, elements=elements)

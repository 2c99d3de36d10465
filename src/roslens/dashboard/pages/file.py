"""One file: its source with findings in the margin, and its functions."""

from __future__ import annotations

from collections import defaultdict

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.site import Site
from roslens.dashboard.sources.colours import colour
from roslens.dashboard.sources.source_rows import CodeLine
from roslens.dashboard.tables.entity_tables import classes_table, functions_table
from roslens.dashboard.tables.finding_list import filter_of, select
from roslens.dashboard.tables.finding_table import findings_table
from roslens.dashboard.tables.table import Table, sort_rows
from roslens.dashboard.view import Request, View
from roslens.model.entity import EntityKind
from roslens.model.finding import Finding


def build(site: Site, request: Request) -> View | None:
    """Return the page; None for a file that is not part of the run."""
    place = site.places.get(request.key)
    if place is None:
        return None
    path = place.file.path
    wanted = filter_of(request.query, path=path)
    found = list(select(site, wanted))
    entities = list(site.view.entities(package=place.package, path=path))
    tables = [
        sort_rows(table, request.query.get(f"sort_{table.name}"), None if request.complete else request.limits.rows)
        for table in (
            functions_table(site, [entity for entity in entities if entity.kind is EntityKind.FUNCTION]),
            classes_table(site, [entity for entity in entities if entity.kind is EntityKind.CLASS]),
        )
    ]
    whole: tuple[Table, ...] = ()
    if request.complete:
        tables.append(findings_table(site, found, len(found)))
    elif request.medium == "folder" and not any(table.cut for table in tables):
        whole = (*tables, findings_table(site, found, len(found)))
    text = site.sources.text(path)
    lines, first = _lines(site, request, path, found)
    own = next((entity for entity in entities if entity.kind is EntityKind.FILE), None)
    return View(
        ref=PageRef("file", path, query=request.query.pairs),
        title=path,
        facts={
            "file": msgspec.to_builtins(place.file),
            "package": place.package,
            "values": dict(own.values) if own else {},
            "filter": wanted.facts(),
            "total": len(found),
            "findings": [msgspec.to_builtins(finding) for finding in found],
            "readable": text is not None,
            "changed": text is not None and text.changed,
            "lines": len(text.lines) if text else 0,
        },
        tables=tuple(tables),
        shown={
            "place": place,
            "lines": lines,
            "first": first,
            "whole": [finding for finding in found if not _on_a_line(finding, text.lines if text else ())],
            "found_count": len(found),
            "change": site.last_change(path),
            "filter": wanted,
            "failures": [failure for failure in site.failures if failure.location and failure.location.path == path],
        },
        whole=whole,
    )


def _on_a_line(finding: Finding, lines: tuple[str, ...]) -> bool:
    return 0 < finding.line <= len(lines)


def _lines(site: Site, request: Request, path: str, found: list[Finding]) -> tuple[list[CodeLine], int]:
    """Return the coloured lines and the number of the first one; a huge file is shown around ``?line=``."""
    text = site.sources.text(path)
    if text is None:
        return [], 1
    most = request.limits.lines
    first = 1
    if len(text.lines) > most:
        wanted = request.query.number("line", 1)
        first = max(1, min(wanted - most // 4, len(text.lines) - most + 1))
    at: dict[int, list[Finding]] = defaultdict(list)
    for finding in found:
        at[finding.line].append(finding)
    cut = text.lines[first - 1 : first - 1 + most]
    coloured = colour(cut, site.sources.language(path))
    marks = site.code_marks.of(path)
    return [
        CodeLine(number, pieces, tuple(at.get(number, ())), marks.get(number, ()))
        for number, pieces in enumerate(coloured, start=first)
    ], first

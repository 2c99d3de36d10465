"""From a path to a page and one of its forms: HTML, the JSON twin, the CSV twin of a table."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from roslens.dashboard.address import PLACES
from roslens.dashboard.computation import graph_page
from roslens.dashboard.pages import (
    conformance,
    difference,
    element,
    failures,
    file,
    findings,
    graph,
    help,  # noqa: A004 - the page's name
    history,
    hotspots,
    metric,
    metrics,
    overview,
    package,
    packages,
    rule,
    rules,
    runs,
    search,
    trend,
)
from roslens.dashboard.site import Site
from roslens.dashboard.view import Request, View

PAGES: dict[str, Callable[[Site, Request], View | None]] = {
    "overview": overview.build,
    "graph": graph.build,
    "computation": lambda site, request: graph_page.build(site.book, request),
    "node": lambda site, request: element.build(site, request, "node"),
    "topic": lambda site, request: element.build(site, request, "topic"),
    "packages": packages.build,
    "package": package.build,
    "file": file.build,
    "findings": findings.build,
    "runs": runs.build,
    "history": history.build,
    "trend": trend.build,
    "difference": difference.build,
    "conformance": conformance.build,
    "hotspots": hotspots.build,
    "metrics": metrics.build,
    "metric": metric.build,
    "rules": rules.build,
    "rule": rule.build,
    "failures": failures.build,
    "search": search.build,
    "help": help.build,
}
"""Every page by name; a new page is a module of ``pages``, a template of the same name and a line here."""


OF_THE_PAST = frozenset({"runs", "history", "trend", "difference", "hotspots"})
"""Pages that a run has only where past revisions were analysed, or git's history was looked at."""


SERVED_ALONE = frozenset({"conformance"})
"""Pages that only a server has: a written report has none of them."""


class Target(msgspec.Struct, frozen=True):
    """What a path means. ``form`` is html, json or csv; ``table`` names the table of a CSV, empty for the first."""

    page: str
    key: str = ""
    form: str = "html"
    table: str = ""


def candidates(path: str) -> list[Target]:
    """Return what a decoded path may mean, the best guess first.

    A key may itself end with ``.json`` (a file ``config.json`` has a page), so the page of the whole key comes before
    the twin of a shorter one.
    """
    path = path.strip("/")
    if not path:
        return [Target("overview")]
    found = []
    for page, place in PLACES.items():
        if place.endswith("/"):
            if path.startswith(place) and len(path) > len(place):
                key = path.removeprefix(place)
                found += [Target(page, key), *_twins(page, key)]
        elif page not in PAGES:
            continue
        elif path == place:
            found.append(Target(page))
        else:
            found += [target for target in _twins(page, path) if target.key == place]
    return [target if PLACES[target.page].endswith("/") else _keyless(target) for target in found]


def _keyless(target: Target) -> Target:
    return Target(target.page, "", target.form, target.table)


def _twins(page: str, path: str) -> list[Target]:
    rest, _, form = path.rpartition(".")
    if form == "json" and rest:
        return [Target(page, rest, "json")]
    if form == "csv" and rest:
        before, _, table = rest.rpartition(".")
        twins = [Target(page, rest, "csv")]
        if before and table.isidentifier():
            twins.insert(0, Target(page, before, "csv", table))
        return twins
    return []

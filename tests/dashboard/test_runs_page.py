"""The list of runs: each leads to what these pages have of it."""

from __future__ import annotations

import msgspec
import pytest

from roslens.dashboard.address import PageRef
from roslens.dashboard.pages import runs
from roslens.dashboard.since_run import SinceRun
from roslens.dashboard.site import Site
from roslens.dashboard.view import Query, Request
from roslens.model.trend import TrendPoint
from roslens.store.runs import StoredRun


class Revisions:
    """Two revisions, as the past of a workspace knows them."""

    points = (TrendPoint(1, "a" * 40, 1.0, "v1"), TrendPoint(2, "b" * 40, 2.0, "now"))

    def place_of(self, name: str) -> int | None:
        return next((place for place, one in enumerate(self.points) if one.commit.startswith(name)), None)


def test_the_run_that_is_shown_and_the_one_before_lead_to_their_pages(
    site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    header = site.view.header
    shown = site.view.id
    kept = [
        StoredRun(number, msgspec.structs.replace(header, commit=commit), 8, 90, 500, 70, 0)
        for number, commit in ((shown + 2, "c" * 40), (shown + 1, f"{'a' * 40}+"), (shown, "b" * 40))
    ]
    monkeypatch.setattr(site, "runs", tuple(kept))
    monkeypatch.setattr(site, "since", SinceRun(f"run {shown + 1}", list, list))
    monkeypatch.setattr(site, "past", Revisions())
    view = runs.build(site, Request(query=Query([])))
    assert view is not None
    links = {row[0].value: {cell.ref for cell in row if cell.ref} for row in view.tables[0].rows}
    assert links == {
        shown + 2: set(),
        shown + 1: {
            PageRef("findings", query=(("status", "new"),)),
            PageRef("difference", query=(("before", "a" * 40),)),
        },
        shown: {PageRef("overview"), PageRef("packages"), PageRef("findings"), PageRef("failures")},
    }

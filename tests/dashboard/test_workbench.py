"""What one does with a list of findings: see what is new, what one function breaks, and leave a rule out."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from dashboard.conftest import Client

from roslens.dashboard.gate_line import GateLine
from roslens.dashboard.server import create_app
from roslens.dashboard.since_run import SinceRun
from roslens.dashboard.site import Site
from roslens.dashboard.tables.finding_list import filter_of, list_findings
from roslens.dashboard.view import Limits, Query, Request
from roslens.report.run.fix_first import gravity
from roslens.store.runs import StoredRun


@pytest.fixture
def since(site: Site) -> Iterator[SinceRun]:
    """The run as if every third of its findings were new and two were resolved."""
    now = tuple(site.view.findings())
    gated = [one for one in now if one.gated]
    before = [one for place, one in enumerate(gated) if place % 3]
    site.since = SinceRun("run 4", lambda: before, lambda: now)
    yield site.since
    site.since = None


def listed(site: Site, **query: str) -> Any:
    asked = Query(query.items())
    return list_findings(site, filter_of(asked), Request(query=asked, limits=Limits(findings=100_000, excerpts=False)))


def test_new_and_old_are_all_that_counts_for_gates(site: Site, since: SinceRun) -> None:
    gated = sum(one.gated for one in site.view.findings())
    new, old = listed(site, status="new"), listed(site, status="old")
    assert new.total > 0
    assert new.total + old.total == gated
    assert since.added == new.total
    assert all(one.is_new for group in new.groups for one in group.findings)
    assert not any(one.is_new for group in old.groups for one in group.findings)


def test_the_overview_says_how_it_stands_and_since_which_run(site: Site, since: SinceRun) -> None:
    site.gate = GateLine("passes", ("0 errors",))
    try:
        page = Client(create_app(site)).get("/").text
    finally:
        site.gate = None
    assert "Passes the gate: 0 errors" in page
    assert f"+{since.added:,}</a> / \N{MINUS SIGN}{since.resolved} since run 4" in page


def test_without_an_earlier_run_nothing_is_new_and_nothing_asked(site: Site) -> None:
    page = Client(create_app(site)).get("/findings").text
    assert 'name="status"' not in page
    assert listed(site, status="new").total == 0


def test_a_rule_is_left_out_of_list_and_twin_and_comes_back(site: Site) -> None:
    whole = listed(site)
    rule = whole.groups[0].key
    rest = listed(site, without=rule)
    assert rest.total == whole.total - whole.groups[0].total
    assert rule not in {group.key for group in rest.groups}
    client = Client(create_app(site))
    assert rule in client.get("/findings").text
    page = client.get(f"/findings?without={rule}").text
    assert f'aria-label="show {rule} again"' in page
    assert f",{rule}," not in client.get(f"/findings.csv?without={rule}").text


def test_by_function_one_row_has_all_that_it_breaks_the_worst_first(site: Site) -> None:
    found = listed(site, group="function")
    assert found.total == listed(site).total
    assert sum(group.total for group in found.groups) == found.total
    worst, rules = [], []
    for group in found.groups:
        assert len({one.finding.entity or one.finding.path for one in group.findings}) == 1
        gated = [one.finding for one in group.findings if one.finding.gated]
        worst.append((not gated, min(gravity(one.finding) for one in group.findings if one.finding.gated or not gated)))
        rules.append(len({one.rule for one in gated}))
    assert worst == sorted(worst)
    first = [count for count, one in zip(rules, worst, strict=True) if one == worst[0]]
    assert first == sorted(first, reverse=True)


def test_pages_by_function_hold_every_group_once(site: Site) -> None:
    whole, start, seen = listed(site, group="function"), 0, []
    while True:
        asked = Query([("group", "function"), ("start", str(start))])
        page = list_findings(site, filter_of(asked), Request(query=asked, limits=Limits(findings=20, excerpts=False)))
        seen += [group.key for group in page.groups]
        if not page.step:
            break
        start += page.step
    assert seen == [group.key for group in whole.groups]


def test_kept_runs_are_a_page_where_there_are_several(site: Site) -> None:
    client = Client(create_app(site))
    assert client.get("/runs").status_code == 404
    assert ">Runs<" not in client.get("/").text
    header = site.view.header
    site.runs = (StoredRun(4, header, 8, 90, 500, 70, 0), StoredRun(site.view.id, header, 8, 90, 500, 66, 1))
    try:
        page = client.get("/runs")
        rows = client.get("/runs.json").json()["tables"]["runs"]["rows"]
    finally:
        site.runs = ()
    assert page.status_code == 200
    assert f"show run {site.view.id}" in page.text
    assert {row["run"]: row["findings"] for row in rows} == {4: 70, site.view.id: 66}
    assert [row["shown"] for row in rows].count("this one") == 1

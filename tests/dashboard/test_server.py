"""The pages over HTTP: every page and twin, what is refused, what every answer carries."""

from __future__ import annotations

import csv
import io
import json
import re
import socket
from contextlib import closing
from typing import Any

import pytest
from dashboard.conftest import Client
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.dashboard.address import PageRef, ServedLinks
from roslens.dashboard.export import pages_of
from roslens.dashboard.routes import OF_THE_PAST, PAGES, SERVED_ALONE
from roslens.dashboard.server import create_app, serve
from roslens.dashboard.site import Site
from roslens.dashboard.view import Request
from roslens.model.errors import UsageError


def _one_of_each(site: Site) -> list[PageRef]:
    return list({ref.page: ref for ref in pages_of(site)}.values())


def test_every_page_and_its_twins_answer(site: Site, client: Any) -> None:
    links = ServedLinks()
    refs = _one_of_each(site)
    assert {ref.page for ref in refs} == PAGES.keys() - OF_THE_PAST - SERVED_ALONE
    for ref in refs:
        page = client.get(links.to(ref))
        assert page.status_code == 200
        assert page.headers["content-type"] == "text/html; charset=utf-8"
        twin = client.get(links.twin(ref, "json"))
        assert twin.status_code == 200
        assert (twin.json()["page"], twin.json()["key"]) == (ref.page, ref.key)
        view = PAGES[ref.page](site, Request(ref.key, complete=True))
        assert view is not None
        for table in view.tables:
            found = client.get(links.twin(ref, f"{table.name}.csv"))
            assert found.headers["content-type"] == "text/csv; charset=utf-8"
            rows = list(csv.reader(io.StringIO(found.text, newline="")))
            assert rows[0] == [column.key for column in table.columns]
            assert len(rows) == 1 + len(table.rows)


def test_what_runs_is_a_page_beside_the_others(site: Site) -> None:
    robot = ScriptedRobot()
    robot.run(3)
    client = Client(create_app(site, snapshot=robot.page.newest))
    assert '<a href="/live/">Live</a>' in client.get("/").text
    to = client.get("/live")
    assert (to.status_code, to.headers["location"]) == (307, "/live/")
    page = client.get("/live/")
    assert page.status_code == 200
    assert "/lidar" in page.text
    assert '<a href="/">Overview</a> <a href="/graph">Graph</a>' in page.text
    assert client.get("/live/snapshot.json").json() == json.loads(robot.page.newest())
    asked = set(re.findall(r'(?:src|href)="([^"#]+)"', page.text))
    assert {"web/live/main.js", "/packages"} <= asked
    for one in asked:
        expected = 303 if one.startswith("/entity?") else 200
        assert client.get(one if one.startswith("/") else f"/live/{one}").status_code == expected, one


def test_the_overview_says_how_many_findings_no_check_counts(site: Site, client: Any) -> None:
    aside = sum(not finding.gated for finding in site.view.findings())
    assert aside > 0
    page, twin = client.get("/"), client.get("/overview.json")
    assert f"{aside} more findings in test, generated or vendored code do not count here." in page.text
    assert twin.json()["counts"]["aside"] == aside


def test_without_a_watch_no_page_speaks_of_what_runs(client: Any) -> None:
    assert "/live" not in client.get("/").text
    assert client.get("/live/").status_code == 404


def test_the_twin_of_a_filtered_page_is_filtered(client: Any) -> None:
    everything = client.get("/findings.json").json()["total"]
    errors = client.get("/findings.json", params={"severity": "error"}).json()["total"]
    rows = list(csv.DictReader(io.StringIO(client.get("/findings.csv", params={"severity": "error"}).text)))
    assert 0 < errors < everything
    assert len(rows) == errors
    assert {row["severity"] for row in rows} == {"error"}


@pytest.mark.parametrize(
    "path", ["/nothing", "/packages/none", "/files/../../etc/passwd", "/help.csv", "/rules/x.json"]
)
def test_an_unknown_page_says_what_helps(client: Any, path: str) -> None:
    answer = client.get(path)
    assert answer.status_code == 404
    assert "There is nothing at" in answer.text
    assert "Search for it, or start at the overview" in answer.text


def test_a_hostile_address_is_escaped(client: Any) -> None:
    answer = client.get("/%3Cscript%3Ealert(1)%3C/script%3E")
    assert answer.status_code == 404
    assert "<script>alert" not in answer.text
    assert "<script>alert" not in client.get("/search", params={"q": "<script>alert(1)"}).text
    assert '"><b' not in client.get("/findings", params={"text": '"><b onload=x>'}).text


def test_text_from_source_is_escaped(site: Site, client: Any) -> None:
    shown = "".join(client.get(ServedLinks().to(PageRef("file", path))).text for path in list(site.places)[:5])
    assert "<script>alert" not in shown
    assert "&lt;script&gt;alert" in shown


@pytest.mark.parametrize("host", ["evil.example", "evil.example:8080", "", "localhost.evil.example"])
def test_foreign_host_names_are_refused(client: Any, host: str) -> None:
    answer = client.get("/", headers={"host": host})
    assert answer.status_code == 421
    assert "Expected localhost or an address" in answer.text
    assert "finding" not in answer.text


@pytest.mark.parametrize("host", ["localhost", "localhost:8080", "127.0.0.1:80", "[::1]:8080", "ROBOT", "robot.:80"])
def test_own_names_and_addresses_are_answered(client: Any, host: str) -> None:
    assert client.get("/", headers={"host": host}).status_code == 200


@pytest.mark.parametrize("path", ["/", "/nothing", "/findings.json", "/rules.csv", "/web/main.js"])
def test_every_answer_is_guarded(client: Any, path: str) -> None:
    headers = client.get(path).headers
    policy = headers["content-security-policy"]
    assert "default-src 'self'" in policy
    assert "unsafe-inline" not in policy
    assert "frame-ancestors 'none'" in policy
    assert headers["x-content-type-options"] == "nosniff"


def test_pages_need_nothing_that_the_policy_forbids(site: Site, client: Any) -> None:
    for ref in _one_of_each(site):
        text = client.get(ServedLinks().to(ref)).text
        assert " style=" not in text
        assert " onclick=" not in text
        assert "<style" not in text
        assert "<script>" not in text


def test_a_port_in_use_is_said(site: Site) -> None:
    with closing(socket.create_server(("127.0.0.1", 0))) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(UsageError, match=f"cannot listen on 127.0.0.1:{port}.*expected a free port.*--port 0"):
            serve(site, port=port)


@pytest.mark.parametrize("port", [-1, 65536])
def test_a_port_that_is_none_is_said(site: Site, port: int) -> None:
    with pytest.raises(UsageError, match="expected a number from 0 to 65535"):
        serve(site, port=port)


def test_the_computation_graph_is_a_picture_too(client: Any) -> None:
    found = client.get("/computation/rover.svg")
    assert found.headers["content-type"] == "image/svg+xml"
    assert found.text.startswith("<svg")
    assert client.get("/computation/nothing.svg").status_code == 404


def test_the_address_of_no_graph_leads_to_the_richest(site: Site, client: Any) -> None:
    found = client.get("/computation", follow_redirects=False)
    assert found.status_code == 303
    assert found.headers["location"] == f"/computation/{next(iter(site.book.systems))}"

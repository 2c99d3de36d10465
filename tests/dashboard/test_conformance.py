"""The page of what is expected against what is there."""

from __future__ import annotations

from typing import Any

import msgspec
import pytest
from dashboard.conftest import Client

from roslens.cli.conformance.shown_sides import against
from roslens.compare.conformance.observed import running_side
from roslens.compare.conformance.side import Side
from roslens.dashboard.pages import conformance
from roslens.dashboard.server import create_app
from roslens.dashboard.site import Site
from roslens.dashboard.view import Query, Request
from roslens.model.errors import UsageError
from roslens.model.graph import Graph, Node

SCRIPT = "<script>alert(1)</script>"


def running(site: Site) -> Graph:
    """Return what runs: all of the first configuration but one node, and one that nobody knows."""
    first = next(iter(site.book.systems.values()))
    graph = first.configuration.graph()
    gone = "/lidar" if any(one.name == "/lidar" for one in graph.nodes) else graph.nodes[0].name
    return msgspec.structs.replace(
        graph,
        nodes=(*(one for one in graph.nodes if one.name != gone), Node(f"/{SCRIPT}")),
        endpoints=tuple(one for one in graph.endpoints if one.node != gone),
    )


@pytest.fixture
def shown(site: Site) -> Any:
    """Return a client of a site that is held against what runs."""
    graph = running(site)
    site.against = against(site, lambda: [running_side(graph, "what runs")])
    yield Client(create_app(site))
    site.against = None


def test_what_differs_is_a_row_with_who_is_right(shown: Any) -> None:
    found = shown.get("/conformance.json").json()
    assert [side["kind"] for side in found["sides"]] == ["source", "running"]
    rows = shown.get("/conformance.differences.csv").text
    assert "not there" in rows
    assert found["tables"]["differences"]
    page = shown.get("/conformance")
    assert page.status_code == 200
    assert "who is right, and why" in page.text


def test_names_from_outside_are_text(shown: Any) -> None:
    page = shown.get("/conformance").text
    assert SCRIPT not in page
    assert "&lt;script&gt;" in page


def test_the_navigation_names_the_page_only_where_there_is_one(site: Site) -> None:
    client = Client(create_app(site))
    assert 'href="/conformance"' not in client.get("/").text
    empty = client.get("/conformance")
    assert "roslens serve --live" in empty.text


def test_another_configuration_can_be_chosen_and_an_unknown_one_is_the_best(shown: Any, site: Site) -> None:
    names = list(site.book.systems)
    assert shown.get(f"/conformance.json?configuration={names[-1]}").json()["configuration"] == names[-1]
    assert shown.get("/conformance.json?configuration=nobody").json()["configuration"] in names


def test_sides_that_cannot_be_read_are_told(site: Site) -> None:
    def sides() -> list[Side]:
        raise UsageError("what runs was not seen yet", expected="a node that runs")

    site.against = against(site, sides)
    page = Client(create_app(site)).get("/conformance")
    site.against = None
    assert page.status_code == 200
    assert "what runs was not seen yet" in page.text


def test_the_first_differences_are_shown_before_the_picture_and_all_where_asked(
    shown: Any, site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(conformance, "FIRST", 1)
    text = shown.get("/conformance").text
    assert text.index('id="differences"') < text.index('id="difference"')
    found = conformance.build(site, Request()).table("differences")
    assert (len(found.rows), found.cut) == (1, True)
    whole = conformance.build(site, Request(query=Query(found.all.query))).table("differences")
    assert len(whole.rows) == whole.total == found.total > 1

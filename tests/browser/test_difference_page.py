"""The Diff page: what differs is marked in the graph by sign and word, and the table says the same."""

from __future__ import annotations

import re
import socket
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import uvicorn
from dashboard.fake_run import FakeRun
from dashboard.test_conformance import running
from playwright.sync_api import Browser, Page, expect

from roslens.cli.conformance.shown_sides import against
from roslens.compare.conformance.observed import running_side
from roslens.dashboard.server import create_app

RULES = Path(__file__).with_name("accessible.js").read_text(encoding="utf-8")
Open = Callable[..., Page]


@pytest.fixture(scope="module")
def served() -> Iterator[str]:
    """Return the address of a server whose source is held against what runs: one node less and one more."""
    listening = socket.socket()
    listening.bind(("127.0.0.1", 0))
    made: list[uvicorn.Server] = []
    ready = threading.Event()

    def serve() -> None:
        # The store's connection belongs to the thread that opens it.
        site = FakeRun().site()
        graph = running(site)
        site.against = against(site, lambda: [running_side(graph, "what runs")])
        config = uvicorn.Config(create_app(site), log_level="error", lifespan="off", ws="none")
        made.append(uvicorn.Server(config))
        ready.set()
        made[0].run(sockets=[listening])

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    assert ready.wait(60), "the server did not start within 60 s"
    yield f"http://127.0.0.1:{listening.getsockname()[1]}"
    made[0].should_exit = True
    thread.join(10)


@pytest.fixture
def visit_difference(browser: Browser, served: str, visitor_class: type[Any]) -> Iterator[Open]:
    """Open pages of that server; fails the test on any problem that they show."""
    visitor = visitor_class(browser, served)
    yield visitor.open
    visitor.close()
    assert not visitor.problems


def test_what_differs_is_marked_by_sign_and_word(visit_difference: Open) -> None:
    page = visit_difference("/conformance")
    gone = page.locator('.difference .node[data-key="node:/lidar"]')
    expect(gone).to_have_class(re.compile("missing"))
    expect(gone.locator(".standing")).to_have_text("\N{MINUS SIGN} not there")
    expect(gone.locator("title")).to_contain_text("node /lidar, not there")
    added = page.locator(".difference .node.added.node .standing").first
    expect(added).to_have_text("+ not in source")
    dashes = page.evaluate(
        "() => ['missing', 'added', 'alike'].map(one => "
        "getComputedStyle(document.querySelector(`.difference .wires .${one}`) || document.body).strokeDasharray)"
    )
    assert dashes[0] != dashes[2]
    expect(page.locator(".difference-legend")).to_contain_text("not there: 1")
    expect(page.locator('[id$="differences"] table')).to_contain_text("node /lidar")


def test_a_list_that_is_cut_leads_to_all_of_it_beside_its_amount(visit_difference: Open) -> None:
    page = visit_difference("/conformance")
    beside = page.locator("#differences .bar-line")
    if "of" in beside.locator(".count").inner_text():
        beside.get_by_role("link", name="all").click()
    expect(page.locator("#differences .cut")).to_have_count(0)


def test_a_node_stands_where_the_graph_of_the_source_has_it(visit_difference: Open) -> None:
    page = visit_difference("/conformance")
    where = "one => one.getAttribute('transform').match(/-?[\\d.]+/g).map(Number)"
    here = {
        name: page.locator(f'.difference .node[data-key="node:{name}"]').evaluate(where)
        for name in ("/lidar", "/odometry", "/navigation/planner")
    }
    page.goto(page.url.replace("/conformance", "/computation/rover"))
    there = {name: page.locator(f'.node.node[data-name="{name}"]').evaluate(where) for name in here}
    assert here == there


def test_the_picture_zooms_and_leads_to_the_pages_of_elements(visit_difference: Open) -> None:
    page = visit_difference("/conformance")
    scene = page.locator(".difference .scene")
    expect(scene).to_have_attribute("transform", re.compile("scale|matrix"))
    before = scene.get_attribute("transform")
    page.locator('.difference [data-do="zoom-in"]').click()
    expect(scene).not_to_have_attribute("transform", before or "")
    page.locator('.difference .node[data-key="node:/lidar"] .outline').click()
    expect(page).to_have_url(re.compile("/nodes/rover/lidar$"))


def test_one_goes_from_a_difference_to_the_next(visit_difference: Open) -> None:
    page = visit_difference("/conformance")
    marked = page.locator(".difference .node:is(.missing, .added, .differs)")
    chosen = page.locator(".difference .node.selected")
    page.get_by_role("button", name="Next difference").click()
    expect(chosen).to_have_attribute("data-key", marked.nth(0).get_attribute("data-key") or "")
    expect(chosen).to_be_in_viewport()
    page.keyboard.press("n")
    expect(chosen).to_have_attribute("data-key", marked.nth(1).get_attribute("data-key") or "")


def test_without_scripts_the_picture_stands(visit_difference: Open) -> None:
    page = visit_difference("/conformance", java_script_enabled=False)
    expect(page.locator(".difference .node.missing .standing")).to_be_visible()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1440, 420])
def test_it_is_accessible_and_no_wider_than_the_screen(visit_difference: Open, scheme: str, width: int) -> None:
    page = visit_difference("/conformance", color_scheme=scheme, viewport={"width": width, "height": 900})
    page.wait_for_load_state("networkidle")
    assert {name: found for name, found in page.evaluate(RULES).items() if found} == {}
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")

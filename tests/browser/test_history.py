"""Going back undoes what was chosen, and the focus of the keyboard is never lost."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from roslens.dashboard.computation.pages import computation_file

Visit = Callable[..., Page]


def focused(page: Page) -> str:
    """Return the tag that has the focus."""
    return str(page.evaluate("document.activeElement.tagName"))


def test_back_undoes_selection_focus_filter_and_metric_one_by_one(visit: Visit, facts: Any) -> None:
    page = visit("/graph")
    name = facts.names[0]
    page.locator("#colour").select_option("metric:loc")
    page.get_by_label("tests, generated and vendored code too").check()
    page.locator(f'#nodes .node[href="/packages/{name}"]').dispatch_event("click")
    expect(page.locator("#graph-selected h2")).to_have_text(name)
    page.get_by_role("button", name="Focus on it").click()
    expect(page.locator("#graph-crumbs")).to_be_visible()
    page.go_back()
    expect(page.locator("#graph-crumbs")).to_be_hidden()
    expect(page.locator("#graph-selected h2")).to_have_text(name)
    page.go_back()
    expect(page.locator("#nodes .node.selected")).to_have_count(0)
    expect(page.get_by_label("tests, generated and vendored code too")).to_be_checked()
    page.go_back()
    expect(page.get_by_label("tests, generated and vendored code too")).not_to_be_checked()
    expect(page.locator("#colour")).to_have_value("metric:loc")
    page.go_back()
    expect(page.locator("#colour")).to_have_value("findings")
    expect(page.locator("#legend-title")).to_contain_text("Findings")
    expect(page).to_have_url(re.compile(r"/graph(\?view=[^&]*)?$"))
    page.go_forward()
    expect(page.locator("#colour")).to_have_value("metric:loc")


def test_back_undoes_what_is_chosen_on_a_computation_graph(visit: Visit) -> None:
    page = visit("/computation/rover")
    page.get_by_label("Topics", exact=True).select_option("lines")
    page.locator("#graph-selected").get_by_role("button", name="/odometry", exact=True).click()
    expect(page.locator("#graph-selected h2")).to_have_text("/odometry")
    page.go_back()
    expect(page.locator(".node.selected")).to_have_count(0)
    expect(page.get_by_label("Topics", exact=True)).to_have_value("lines")
    page.go_back()
    expect(page.get_by_label("Topics", exact=True)).to_have_value("marks")
    expect(page.locator(".nodes .node.topic:not([hidden])").first).to_be_attached()


def test_back_undoes_filters_of_a_list(visit: Visit) -> None:
    page = visit("/findings")
    total = page.locator("#findings").get_attribute("data-total")
    page.get_by_label("Severity").select_option("error")
    expect(page.locator("#findings")).not_to_have_attribute("data-total", total or "")
    page.go_back()
    expect(page.locator("#findings")).to_have_attribute("data-total", total or "")
    expect(page.get_by_label("Severity")).to_have_value("")
    expect(page).to_have_url(re.compile("/findings$"))


def test_back_works_in_one_file_too(browser: Browser, made_up: Any, tmp_path: Path) -> None:
    path = tmp_path / "rover.html"
    computation_file({"rover": made_up.robot()}, path)
    page = browser.new_context(viewport={"width": 1280, "height": 800}).new_page()
    page.goto(path.as_uri())
    panel = page.locator("section.current .panel")
    panel.get_by_role("button", name="/odometry", exact=True).click()
    expect(panel.locator("h2")).to_have_text("/odometry")
    panel.get_by_role("link", name="Open its page").click()
    expect(page.locator("section.current h1")).to_have_text("/odometry")
    page.go_back()
    expect(page.locator("section.current .panel h2")).to_have_text("/odometry")
    page.go_back()
    expect(page.locator("section.current .node.selected")).to_have_count(0)
    page.context.close()


@pytest.mark.parametrize("box", ["#include-chips", "#exclude-chips"])
def test_tab_goes_on_from_a_tag_box(visit: Visit, box: str) -> None:
    page = visit("/graph")
    page.locator(box).focus()
    expect(page.locator(f"{box} ~ .options")).to_be_visible()
    page.keyboard.press("Tab")
    assert focused(page) == "INPUT"
    assert page.evaluate("document.activeElement.id || document.activeElement.name") in {"exclude-chips", "aside"}
    page.keyboard.press("Shift+Tab")
    assert page.evaluate("document.activeElement.id") == box.removeprefix("#")


@pytest.mark.parametrize("path", ["/graph", "/computation/rover"])
def test_the_focus_goes_where_the_table_and_the_picture_are(visit: Visit, path: str) -> None:
    page = visit(path)
    page.locator("#graph-canvas").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("t")
    assert page.evaluate("document.activeElement.matches('.graph-table .scroll')")
    page.keyboard.press("t")
    assert page.evaluate("document.activeElement.id") == "graph-canvas"
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    expect(page.locator(".node.selected")).to_have_count(1)


def test_the_focus_stays_in_panel_and_crumbs(visit: Visit) -> None:
    page = visit("/computation/rover")
    panel = page.locator("#graph-selected")
    panel.get_by_role("button", name="/odometry", exact=True).focus()
    page.keyboard.press("Enter")
    expect(panel.locator("h2")).to_have_text("/odometry")
    expect(panel.locator("h2")).to_be_focused()
    panel.get_by_role("button", name="Focus on it").press("Enter")
    more = page.get_by_role("button", name="One step more")
    more.press("Enter")
    expect(more).to_be_focused()
    page.get_by_role("button", name="Clear the focus").last.press("Enter")
    expect(page.locator("#graph-canvas")).to_be_focused()

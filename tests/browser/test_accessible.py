"""Four rules of accessibility that pages broke once, checked on every page as the rules of axe-core 4.10 state them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page

Visit = Callable[..., Page]
PAGES = [
    "/",
    "/graph",
    "/computation/rover",
    "/computation/rover?topics=lines",
    "/nodes/rover/rover_follower",
    "/topics/rover/topic/scan",
    "/packages",
    "/packages/rover_base",
    "/files/src/rover/rover_base/src/base_node.cpp",
    "/findings",
    "/findings?group=file",
    "/rules",
    "/rules/ros.calls.max",
    "/metrics",
    "/metrics/loc",
    "/failures",
    "/search?q=rover",
    "/help",
]
CROSSED = """() => [...document.querySelectorAll(".distribution")].flatMap((chart) => {
  const boxes = (one) => [...chart.querySelectorAll(one)].map((each) => each.getBoundingClientRect());
  const lines = boxes(".bounds line");
  return boxes(".bounds text").flatMap((text) =>
    lines.filter((line) => line.x > text.left && line.x < text.right && line.top < text.bottom - 4));
})"""
RULES = Path(__file__).with_name("accessible.js").read_text(encoding="utf-8")


def broken(page: Page) -> dict[str, list[str]]:
    """Return the elements that break a rule, by the rules that are broken."""
    return {name: found for name, found in page.evaluate(RULES).items() if found}


@pytest.mark.parametrize("path", PAGES)
def test_no_page_breaks_them(visit_example: Visit, path: str) -> None:
    page = visit_example(path)
    page.wait_for_load_state("networkidle")
    assert broken(page) == {}
    # What stands beyond the edge of a scrolled table makes its head no higher, and words of limits cross no line.
    assert max(page.locator("thead").evaluate_all("heads => [0, ...heads.map((one) => one.offsetHeight)]")) < 80
    assert page.evaluate(CROSSED) == []


def test_names_that_are_cut_break_them_neither(visit: Visit) -> None:
    page = visit("/graph")
    assert "…" in "".join(page.locator("#nodes .node text").all_text_contents())
    assert broken(page) == {}


@pytest.mark.parametrize(
    ("name", "markup"),
    [
        ("nested-interactive", "<details><summary>a <a href='#'>b</a></summary></details>"),
        ("link-in-text-block", "<p>words <a class='go' href='#'>link</a> words</p>"),
        ("label-content-name-mismatch", "<button aria-label='other'>shown</button>"),
        ("scrollable-region-focusable", f"<div class='source'><code>{'x' * 2000}</code></div>"),
    ],
)
def test_each_check_finds_what_breaks_its_rule(visit: Visit, name: str, markup: str) -> None:
    page = visit("/help")
    assert broken(page) == {}
    page.evaluate("markup => document.querySelector('main').insertAdjacentHTML('beforeend', markup)", markup)
    assert {rule: len(found) for rule, found in broken(page).items()} == {name: 1}


def test_an_element_of_the_graph_is_called_by_kind_and_whole_name(visit: Visit) -> None:
    page = visit("/computation/rover")
    assert page.get_by_role("link", name="topic /scan, error", exact=True).count() == 1
    assert page.get_by_role("link", name="node /lidar", exact=True).count() == 1

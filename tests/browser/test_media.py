"""The same pages on paper, on narrow screens, without scripts, and over a real run, light and dark."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect

Visit = Callable[..., Page]

PLACES = (
    "/", "/graph", "/packages", "/packages/nav2_amcl", "/findings", "/findings?group=file", "/metrics",
    "/metrics/cyclomatic_complexity", "/rules", "/rules/ros.calls.max", "/search?q=costmap", "/failures", "/help",
)  # fmt: skip
EXAMPLES = (
    "/", "/graph", "/packages", "/packages/rover_navigation", "/files/src/rover/rover_navigation/src/recovery.cpp",
    "/findings", "/metrics", "/metrics/loc", "/metrics/cyclomatic_complexity.max", "/rules", "/failures",
)  # fmt: skip


def sticking_out(page: Page) -> list[str]:
    """Return what makes the page wider than the window, but for what scrolls by itself."""
    return list(
        page.evaluate(
            """document.documentElement.scrollWidth <= document.documentElement.clientWidth ? [] :
            ["page", ...[...document.querySelectorAll("body *")]
            .filter((one) => one.getBoundingClientRect().right > innerWidth && !one.closest(".scroll, .plot, .source"))
            .map((one) => `${one.tagName} ${one.getAttribute("class")}`).slice(0, 5)]"""
        )
    )


def test_narrow_pages_do_not_scroll_sideways(visit: Visit, flagged_file: str) -> None:
    page = visit("/", viewport={"width": 800, "height": 900})
    base = page.url.rstrip("/")
    for path in (*PLACES, flagged_file):
        page.goto(base + path)
        assert sticking_out(page) == [], path
        expect(page.locator("nav[aria-label=Pages]")).to_be_visible()


def test_print_leaves_the_chrome_out(visit: Visit) -> None:
    page = visit("/graph", color_scheme="dark")
    page.emulate_media(media="print")
    for hidden in ("nav[aria-label=Pages]", "form.search", ".panel", ".graph-tools .buttons", ".twins >> nth=0"):
        expect(page.locator(hidden)).to_be_hidden()
    for shown in ("#graph-svg", "#graph-legend", ".colophon"):
        expect(page.locator(shown)).to_be_visible()
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    page.goto(page.url.replace("/graph", "/findings"))
    expect(page.locator("form.filters")).to_be_hidden()
    expect(page.locator(".finding").first).to_be_visible()


ON_SHEET = """svg => {
    const room = svg.getBoundingClientRect();
    return [...svg.querySelectorAll(".nodes > .node:not([hidden])")].map((one) => {
      const box = one.getBoundingClientRect();
      const across = box.left >= room.left - 1 && box.right <= room.right + 1;
      const down = box.top >= room.top - 1 && box.bottom <= room.bottom + 1;
      return across && down && getComputedStyle(one.querySelector("text")).display !== "none";
    });
}"""


def test_a_computation_graph_is_printed_whole_on_one_page(visit: Visit) -> None:
    page = visit("/computation/rover")
    scene = page.locator("#graph-svg .scene")
    page.locator('[data-do="zoom-in"]').click(click_count=3)
    # The picture is drawn anew when the zoom has come to rest.
    expect(scene).to_have_attribute("transform", re.compile(r"scale\(2"))
    before = scene.get_attribute("transform")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.emulate_media(media="print")
    found = page.locator("#graph-svg").evaluate(ON_SHEET)
    assert len(found) > 10
    assert all(found)
    page.emulate_media(media="screen")
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert scene.get_attribute("transform") == before
    page.emulate_media(media="null")
    sheets = re.findall(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", page.pdf(prefer_css_page_size=True))
    assert any(float(width) > float(height) for width, height in sheets), "the graph is on a wide sheet"


def test_pages_are_complete_without_scripts(visit: Visit, fetch: Callable[[str], str]) -> None:
    page = visit("/packages", java_script_enabled=False)
    base = page.url.removesuffix("/packages")
    rows = page.locator("#packages tbody tr")
    assert rows.count() == len(fetch("/packages.csv").splitlines()) - 1
    page.locator("#packages th", has_text="Code lines").get_by_role("link").click()
    expect(page.locator("#packages th", has_text="Code lines")).to_have_attribute("aria-sort", "descending")
    page.goto(base + "/graph")
    expect(page.locator("#graph-table table")).to_be_visible()
    assert page.locator("#graph-table tbody tr").count() == rows.count() or page.locator("#nodes .node").count() == 38
    expect(page.locator("#graph-svg")).to_be_visible()
    expect(page.locator(".js >> visible=true")).to_have_count(0)
    page.locator("#colour").select_option("kloc")
    page.locator("#exclude").fill("calls")
    page.locator("#graph-form").get_by_role("button", name="Apply").click()
    expect(page.locator("#legend-title")).to_contain_text("Findings per 1,000 lines")
    page.goto(base + "/findings")
    page.locator("#severity").select_option("error")
    page.get_by_role("button", name="Apply").click()
    expect(page.locator(".finding").first).to_have_attribute("data-severity", "error")
    page.locator(".finding summary").first.click()
    expect(page.locator(".finding .more").first).to_be_visible()


@pytest.mark.parametrize("scheme", ["light", pytest.param("dark", marks=pytest.mark.nightly)])
def test_every_page_of_a_real_run_opens(visit_example: Visit, scheme: str) -> None:
    page = visit_example("/", color_scheme=scheme)
    base = page.url.rstrip("/")
    for path in EXAMPLES:
        page.goto(base + path)
        expect(page.locator("h1").first).to_be_attached()
        text = page.locator("main").inner_text()
        # Signs that a value or markup went into the page undone; rules are called after undefined names.
        told = text.replace("{{}}", "").replace("launch.undefined_name", "").replace("python.undefined_name", "")
        for leak in ("<span", "&lt;", "undefined", "None", "{{"):
            assert leak not in told or path.startswith("/files/"), f"{leak} on {path}"
        duplicates = page.evaluate(
            "[...document.querySelectorAll('[id]')].map(one => one.id).filter((id, at, all) => all.indexOf(id) !== at)"
        )
        assert duplicates == [], path


def test_text_has_enough_contrast_in_both_schemes(visit: Visit) -> None:
    for scheme in ("light", "dark"):
        page = visit("/findings", color_scheme=scheme)
        ratios = page.evaluate(
            """[...document.querySelectorAll("main a, main .count, main label, .message, .colophon p")]
            .slice(0, 200).map(one => {
            const light = (text) => {
              const parts = text.match(/[\\d.]+/g).slice(0, 3).map(Number).map(part => part / 255)
                .map(part => part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
              return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2];
            };
            const [a, b] = [light(getComputedStyle(one).color), light(getComputedStyle(document.body).backgroundColor)];
            return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
            })"""
        )
        assert len(ratios) > 20
        assert min(ratios) >= 4.5, scheme

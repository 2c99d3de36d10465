"""The live page at other moments, and its plots: a scripted robot had a fault, and somebody looks back."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from dashboard.live.scripted_robot import ScriptedRobot
from playwright.sync_api import Browser, Locator, Page, expect

from roslens.dashboard.live.serving import LivePage

Open = Callable[..., Page]
KILLED = 40.0
SLIDE = "(one, at) => { one.value = at; one.dispatchEvent(new Event('input', { bubbles: true })); }"


@pytest.fixture(scope="module")
def robot() -> ScriptedRobot:
    """Return a robot whose lidar died at 37 s while its host was busy since 26 s, and which is fine since 51 s."""
    robot = ScriptedRobot()
    robot.run(20)
    robot.cpu["rover"] = 99.0
    robot.run(10)
    robot.gone.add("/lidar")
    robot.run(15)
    robot.gone.clear()
    robot.cpu.clear()
    robot.run(20)
    return robot


@pytest.fixture
def follow(robot: ScriptedRobot, browser: Browser, visitor_class: Any) -> Iterator[Open]:
    """Open the page of the robot; fails the test on any problem that it shows."""
    with LivePage(robot.page.newest, detail=robot.page.detail, past=robot.page.past) as live:
        visitor = visitor_class(browser, live.url.rstrip("/"))
        yield visitor.open
        visitor.close()
        assert not visitor.problems


def row(page: Page, entity: str) -> Locator:
    """Return the first row of an entity."""
    return page.locator(f'#rows tr[data-entity="{entity}"]').first


def test_at_in_the_address_shows_that_moment_everywhere(follow: Open) -> None:
    page = follow(f"/?at={KILLED}&select=topic:/scan")
    expect(page.locator(".cause > .alert").first).to_contain_text("is gone → /scan silent")
    expect(page.locator("#then")).to_contain_text("This is how it was at 12:00:40.0")
    expect(row(page, "topic:/scan").locator(".state")).to_have_text("absent")
    expect(page.locator("#detail .mark").first).to_have_text("absent")
    expect(page.locator("#when")).to_have_text("12:00:40.0")
    expect(page.locator("#pulse-word")).to_have_text("past")
    page.locator("#now").click()
    expect(page.locator("#pulse-word")).to_have_text("live")
    expect(page.locator("#then")).not_to_be_visible()
    expect(page.locator("#headline")).to_have_text("Nothing is wrong")
    expect(row(page, "topic:/scan").locator(".state")).to_have_text("ok")
    expect(page.locator("#detail .mark").first).to_have_text("ok")
    expect(page).not_to_have_url(re.compile("at="))


def test_the_graph_stands_still_while_moments_pass(follow: Open) -> None:
    where = """() => [document.querySelector("#scene").getAttribute("transform"),
        ...[...document.querySelectorAll("#items .item")].map((one) => one.getAttribute("transform"))]"""
    page = follow()
    expect(page.locator("#slider")).to_be_visible()
    now = page.evaluate(where)
    for time in ("20", "12", "40"):
        page.locator("#slider").evaluate(SLIDE, time)
        expect(page.locator("#when")).to_have_text(f"12:00:{time}.0")
        assert page.evaluate(where) == now
    page.keyboard.press("n")
    expect(page.locator("#pulse-word")).to_have_text("live")
    assert page.evaluate(where) == now


def test_the_node_that_died_is_named_before_its_busy_host(follow: Open) -> None:
    page = follow(f"/?at={KILLED}")
    names = page.locator(".cause > .alert .name")
    expect(names).to_have_text(["/lidar", "rover"])
    expect(page.locator(".cause > .alert").nth(1)).to_contain_text("cpu is high")


def test_the_slider_and_its_marks_lead_to_moments(follow: Open) -> None:
    page = follow()
    expect(page.locator("#slider")).to_be_visible()
    page.locator("#slider").evaluate(SLIDE, KILLED)
    expect(page).to_have_url(re.compile(r"at=40$"))
    expect(page.locator("#headline")).to_contain_text("2 wrong")
    page.locator("#marks .gone").first.click(force=True)
    expect(page.locator("#moment")).to_have_text("12:00:37.0")
    page.keyboard.press("]")
    expect(page.locator("#moment")).not_to_have_text("12:00:37.0")
    page.keyboard.press("n")
    expect(page.locator("#moment")).to_have_text("now")


def test_the_handle_stands_at_the_end_where_the_end_is_shown(follow: Open) -> None:
    page = follow()
    expect(page.locator("#slider")).to_be_visible()
    assert page.locator("#slider").evaluate("(one) => one.value === one.max")
    page.locator("#slider").evaluate(SLIDE, KILLED)
    expect(page.locator("#moment")).to_have_text("12:00:40.0")
    page.locator("#slider").evaluate(SLIDE, page.locator("#slider").get_attribute("max"))
    expect(page.locator("#moment")).to_have_text("now")


def test_playback_goes_on_and_ends_at_now(follow: Open) -> None:
    page = follow("/?at=60")
    page.locator("#speed").select_option("60")
    page.locator("#play").click()
    expect(page.locator("#moment")).to_have_text("now")
    expect(page.locator("#play")).to_have_text("Play")


def test_two_moments_are_compared(follow: Open) -> None:
    page = follow("/?at=20")
    page.locator("#hold").click()
    page.locator("#slider").evaluate(SLIDE, KILLED)
    page.locator("#differences a").click()
    expect(page.locator("h1")).to_have_text("Two moments compared")
    first = page.locator(".compared tbody tr").first
    expect(first).to_contain_text("absent")
    page.locator(".compared a", has_text="/scan").first.click()
    expect(page).to_have_url(re.compile(r"select=topic%3A/scan&at=40"))
    expect(row(page, "topic:/scan")).to_have_class(re.compile("chosen"))


def test_what_changed_and_no_constraint_judges_is_folded(follow: Open) -> None:
    page = follow(f"/compared?from=20&to={KILLED}")
    expect(page.locator(".workspace")).to_have_text("rover")
    judged, others = page.locator(".compared").all()
    assert "connection" not in judged.inner_text()
    expect(others).to_be_hidden()
    page.locator(".unjudged summary").click()
    expect(others.locator("tr", has_text="/lidar > /scan > /slam")).to_be_visible()


def test_back_undoes_a_selection(follow: Open) -> None:
    page = follow()
    row(page, "topic:/scan").click()
    row(page, "node:/camera").click()
    expect(page.locator("#detail h3")).to_have_text("node /camera")
    page.go_back()
    expect(page.locator("#detail h3")).to_have_text("topic /scan")
    expect(row(page, "topic:/scan")).to_have_class(re.compile("chosen"))
    page.go_back()
    expect(page.locator("#detail")).not_to_be_visible()


def test_a_plot_has_the_band_its_values_and_a_gap_in_words(follow: Open) -> None:
    page = follow("/?select=node:/lidar")
    plot = page.locator("#plots .plot")
    expect(plot).to_have_count(1)
    expect(plot).to_have_attribute("aria-label", re.compile(r"^CPU from .* last 12\.5 %, expected <= 80 %, 1 gap$"))
    expect(plot.locator("canvas")).to_be_visible()
    # Where nobody points, the legend has the last value.
    expect(plot.locator(".u-legend")).to_contain_text("12.5 %")
    page.locator(".plot-signals summary").click()
    page.get_by_label("Memory", exact=True).check()
    expect(plot).to_have_count(2)
    page.locator('[data-plot="reach"]').select_option("120")
    expect(plot.first).to_be_visible()


def test_a_part_of_a_plot_is_looked_at_closer_and_all_of_it_again(follow: Open) -> None:
    page = follow("/?select=host:rover")
    over = page.locator("#plots .u-over").first
    over.scroll_into_view_if_needed()
    box = over.bounding_box()
    assert box
    page.mouse.move(box["x"] + box["width"] * 0.8, box["y"] + 20)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.9, box["y"] + 20, steps=4)
    page.mouse.up()
    whole = page.get_by_role("button", name="Whole stretch")
    expect(whole).to_be_visible()
    whole.click()
    expect(whole).not_to_be_visible()


def test_every_row_in_sight_has_a_sparkline(follow: Open) -> None:
    page = follow()
    expect(row(page, "topic:/scan").locator(".spark path")).to_have_attribute("d", re.compile("M.*L"))
    expect(row(page, "host:rover").locator(".spark path")).to_have_attribute("d", re.compile("M.*L"))


def test_a_moment_of_which_nothing_is_kept_is_said(follow: Open) -> None:
    page = follow("/?at=-100000")
    expect(page.locator("#when")).to_contain_text("12:0")
    assert page.locator("#headline").count() == 1


def test_without_scripts_a_moment_of_the_past_is_read_too(follow: Open) -> None:
    page = follow(f"/?at={KILLED}", java_script_enabled=False)
    expect(page.locator("#then")).to_contain_text("This is how it was at 12:00:40.0")
    expect(page.locator(".alert").first).to_contain_text("/lidar")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_narrow_screen_does_not_scroll_sideways(follow: Open, scheme: str) -> None:
    page = follow(f"/?at={KILLED}&select=topic:/scan", viewport={"width": 420, "height": 800}, color_scheme=scheme)
    expect(page.locator("#plots canvas").first).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")

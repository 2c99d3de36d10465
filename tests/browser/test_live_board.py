"""The board of what runs, by the rows of the requirements that it answers; a scripted robot has faults."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from dashboard.live.scripted_robot import REFERENCE, ScriptedRobot
from playwright.sync_api import Browser, Locator, Page, expect

from roslens.dashboard.access.person import Person, Role
from roslens.dashboard.access.policy import Access
from roslens.dashboard.live.serving import LivePage

Open = Callable[..., Page]
TOKEN = "t" * 32
RULES = Path(__file__).with_name("accessible.js").read_text(encoding="utf-8")


@pytest.fixture
def robot() -> ScriptedRobot:
    """Return a robot whose lidar died while its host was over its limit."""
    robot = ScriptedRobot()
    robot.run(20)
    robot.cpu["rover"] = 99.0
    robot.run(5)
    robot.gone.add("/lidar")
    robot.run(12)
    return robot


@pytest.fixture
def follow(robot: ScriptedRobot, browser: Browser, visitor_class: Any) -> Iterator[Open]:
    """Open the page of the robot; fails the test on any problem that it shows."""
    page = robot.page
    access = Access({TOKEN: Person("anna", Role.OPERATE)})
    with LivePage(page.newest, detail=page.detail, past=page.past, board=page.board, access=access) as live:
        visitor = visitor_class(browser, live.url.rstrip("/"))
        yield visitor.open
        visitor.close()
        assert not visitor.problems


def row(page: Page, entity: str) -> Locator:
    """Return the first row of an entity."""
    return page.locator(f'#rows tr[data-entity="{entity}"]').first


def test_tree_of_host_node_topic_and_connection_with_roll_up(follow: Open) -> None:
    page = follow()
    levels = {"host:rover": "1", "node:/lidar": "2", "topic:/scan": "3", "connection:/lidar > /scan > /slam": "4"}
    for entity, level in levels.items():
        expect(row(page, entity)).to_have_attribute("aria-level", level)
    expect(row(page, "host:rover").locator(".state")).to_have_text("high")
    expect(row(page, "host:rover").locator(".below")).to_have_text(re.compile(r"2 absent.* below"))
    expect(row(page, "host:base").locator(".state")).to_have_text("ok")


def test_states_have_sign_word_and_colour_and_what_is_not_judged_is_not_ok(follow: Open) -> None:
    page = follow()
    for entity, state, word in (
        ("host:rover", "high", "high"),
        ("topic:/scan", "absent", "absent"),
        ("topic:/odom", "ok", "ok"),
        ("topic:/planner/status", "unjudged", "not judged"),
    ):
        cell = row(page, entity).locator(".state")
        expect(cell).to_have_text(word)
        expect(cell.locator("use")).to_have_attribute("href", f"#g-{state}")
    expect(page.locator("#counts")).to_contain_text("not judged")


def test_cpu_and_memory_of_hosts_and_nodes_with_every_signal_in_the_panel(follow: Open) -> None:
    page = follow("/?select=host:rover")
    expect(row(page, "host:rover")).to_contain_text("99 %")
    expect(row(page, "node:/camera")).to_contain_text("84 MB")
    panel = page.locator("#detail")
    expect(panel).to_contain_text("Every signal that was sampled (2)")
    expect(panel).to_contain_text("rover.yaml:")


def test_rate_bandwidth_jitter_and_latency_of_each_connection(follow: Open) -> None:
    page = follow("/?select=connection:/odometry > /odom > /slam")
    panel = page.locator("#detail")
    for title in ("Rate", "Bandwidth", "Jitter", "Mean latency"):
        expect(panel.get_by_role("cell", name=title, exact=True)).to_be_visible()


def test_network_and_temperature_of_a_host_beside_its_processor(robot: ScriptedRobot, follow: Open) -> None:
    robot.sampled["base"] = {"network_in": 2e6, "network_out": 1e6, "temperature": 71.5}
    robot.run(2)
    panel = follow("/?select=host:base").locator("#detail")
    for title, value in (
        ("Network in", "2 MB/s"),
        ("Network out", "1 MB/s"),
        ("Temperature", "71.5 degC"),
        ("CPU", "31 %"),
    ):
        line = panel.locator("tr", has=panel.page.get_by_role("cell", name=title, exact=True))
        expect(line.first).to_contain_text(value)


def test_what_comes_out_of_a_node_is_held_against_what_went_in(robot: ScriptedRobot, follow: Open) -> None:
    robot.processing["/cmd_vel"] = 0.012
    robot.run(2)
    panel = follow("/?select=connection:/planner > /cmd_vel > /odometry").locator("#detail")
    line = panel.locator("tr", has=panel.page.get_by_role("cell", name="Mean processing time", exact=True))
    expect(line.first).to_contain_text("12 ms")


def test_edge_labels_and_tooltips_say_what_the_table_says(follow: Open) -> None:
    page = follow("/?select=topic:/odom")
    rate = row(page, "topic:/odom").locator("td.num").first.inner_text()
    assert rate == "50 Hz"
    told = page.locator("#lines title").evaluate_all("all => all.map(one => one.textContent)")
    assert any("/odom" in one and rate in one for one in told)
    words = page.locator("#lines text").evaluate_all("all => all.map(one => one.textContent)")
    assert any(rate in one for one in words)


def test_an_alert_points_at_the_faulty_part_first_cause_first(follow: Open) -> None:
    page = follow()
    first = page.locator(".cause > .alert").first
    expect(first.locator(".name")).to_have_text("/lidar")
    expect(first).to_contain_text("is gone → /scan silent → /planner, /slam without input")
    expect(page.locator(".cause > .alert .name")).to_have_text(["/lidar", "rover"])
    first.locator(".name").click()
    expect(row(page, "node:/lidar")).to_have_class(re.compile("chosen"))


def noted(page: Page, note: Callable[[], object]) -> None:
    """Note something of an alert, and return once the monitor knows it: what is made before does not show it."""
    with page.expect_response(lambda one: one.request.method == "POST", timeout=60_000):
        note()


def test_who_may_operate_acknowledges_mutes_and_takes_it_back(robot: ScriptedRobot, follow: Open) -> None:
    page = follow(f"/?token={TOKEN}")
    second = page.locator(".cause > .alert", has_text="rover")
    noted(page, second.get_by_role("button", name="Acknowledge").click)
    robot.run()
    expect(second.locator(".noted")).to_have_text("acknowledged by anna")
    noted(page, second.get_by_role("button", name="Undo").click)
    robot.run()
    expect(second.locator(".noted")).to_have_count(0)
    noted(page, lambda: second.get_by_label("Mute rover for").select_option("600"))
    robot.run()
    expect(page.locator("#muted summary")).to_have_text("1 muted")
    expect(page.locator("#headline")).to_contain_text("1 muted, 1 wrong")
    expect(page.locator(".cause > .alert .name")).to_have_text(["/lidar"])
    expect(row(page, "host:rover").locator(".state")).to_have_text("high")
    page.locator("#muted summary").click()
    expect(page.locator("#muted .noted")).to_have_text(re.compile(r"muted by anna until 12:\d\d:\d\d"))
    noted(page, page.locator("#muted").get_by_role("button", name="Undo").click)
    robot.run()
    expect(page.locator("#muted")).not_to_be_visible()


def test_who_may_only_look_has_no_buttons(follow: Open) -> None:
    page = follow()
    expect(page.locator(".cause > .alert").first).to_be_visible()
    expect(page.get_by_role("button", name="Acknowledge")).to_have_count(0)


def test_reference_with_what_each_constraint_matches_and_a_draft_to_accept(follow: Open) -> None:
    page = follow()
    page.get_by_role("link", name="References").click()
    table = page.locator(".constraints")
    line = table.locator("tr", has_text="rover.topic.scan.rate")
    expect(line).to_contain_text("rate 8..12 Hz")
    # What it is about, and what it matches.
    expect(line.get_by_role("link", name="/scan")).to_have_count(2)
    page.get_by_label(re.compile("/planner/status")).check()
    page.get_by_role("button", name="Make a document").click()
    expect(page.locator("#accepted + pre")).to_contain_text('topic: "/planner/status"')
    table.get_by_role("link", name="/scan").first.click()
    expect(row(page, "topic:/scan")).to_have_class(re.compile("chosen"))


def test_what_several_constraints_judge_is_said(browser: Browser, visitor_class: Any) -> None:
    robot = ScriptedRobot(reference=REFERENCE + "  - {topic: /scan, rate: '>= 5 Hz'}\n")
    robot.run(30)
    page = robot.page
    with LivePage(page.newest, board=page.board) as live:
        visitor = visitor_class(browser, live.url.rstrip("/"))
        shown = visitor.open("/references")
        expect(shown.get_by_role("heading", name="Judged more than once")).to_be_visible()
        expect(shown.locator("main")).to_contain_text("8..12 Hz")
        shown.get_by_role("button", name="Choose all").click()
        expect(shown.locator(".proposals input:not(:checked)")).to_have_count(0)
        visitor.close()
        assert not visitor.problems


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("path", ["/?select=host:rover", "/?at=20", "/references", "/compared?from=20&to=40"])
def test_no_screen_breaks_the_rules_of_accessibility(follow: Open, path: str, scheme: str) -> None:
    page = follow(path, color_scheme=scheme)
    page.wait_for_load_state()
    if "select" in path:
        expect(page.locator("#plots canvas").first).to_be_visible()
    assert {name: found for name, found in page.evaluate(RULES).items() if found} == {}


@pytest.mark.parametrize("path", ["/", "/references", "/compared?from=20&to=40"])
def test_no_screen_scrolls_sideways_at_420_pixels(follow: Open, path: str) -> None:
    page = follow(path, viewport={"width": 420, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")

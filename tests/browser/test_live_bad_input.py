"""The live page where something is not as it should be: clocks, monitors, a browser that slept, very many alerts."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import msgspec
import pytest
from dashboard.live.scripted_robot import ScriptedRobot
from playwright.sync_api import Browser, Page, expect

from roslens.cli.page.page_document import bounded
from roslens.dashboard.access.person import Person, Role
from roslens.dashboard.access.policy import Access
from roslens.dashboard.live import snapshot_stream
from roslens.dashboard.live.serving import LivePage
from roslens.dashboard.live.snapshot import Alert, Snapshot

KEYS = ("a" * 32, "b" * 32)
SKEW_S = 3 * 3600
SKEWED = f"const right = Date.now; Date.now = () => right() - {1000 * SKEW_S};"


@pytest.fixture
def visitor_of(browser: Browser, request: pytest.FixtureRequest) -> Callable[[str], Any]:
    """Return what makes a visitor that is closed at the end."""
    visitor_class = request.getfixturevalue("visitor_class")

    def make(base: str) -> Any:
        made = visitor_class(browser, base.rstrip("/"))
        request.addfinalizer(made.close)
        return made

    return make


def at(page: Page, robot: ScriptedRobot) -> None:
    """Wait until the page shows the newest second of the robot."""
    expect(page.locator("#when")).to_have_text(f"12:{int(robot.now) // 60:02}:{robot.now % 60:04.1f}")


def test_a_viewer_whose_clock_is_wrong_sees_the_times_of_the_monitor(visitor_of: Callable[[str], Any]) -> None:
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(30)
    with LivePage(robot.page.newest, detail=robot.page.detail, past=robot.page.past) as live:
        visitor = visitor_of(live.url)
        page = visitor.open(timezone_id="Asia/Kathmandu")
        page.context.add_init_script(SKEWED)
        page.reload()
        robot.run()
        at(page, robot)
        expect(page.locator("#pulse-word")).to_have_text("live")
        expect(page.locator("#lost")).to_be_hidden()
        expect(page.locator("#alerts time").first).to_have_text(re.compile(r"^for 3\d s$"))
        page.locator("#slider").evaluate("one => { one.value = 10; one.dispatchEvent(new Event('input')); }")
        expect(page.locator("#then")).to_contain_text("This is how it was at 12:00:10.0")
        visitor.close()
        assert not visitor.problems


def test_a_browser_that_slept_shows_now_when_it_wakes(
    visitor_of: Callable[[str], Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """What it missed is more than is kept, so it is told all."""
    monkeypatch.setattr(snapshot_stream, "MOST_KEPT", 5)
    robot = ScriptedRobot()
    with LivePage(robot.page.newest) as live:
        visitor = visitor_of(live.url)
        page = visitor.open()
        at(page, robot)
        session = page.context.new_cdp_session(page)
        session.send("Page.setWebLifecycleState", {"state": "frozen"})
        robot.gone.add("/lidar")
        robot.run(60)
        session.send("Page.setWebLifecycleState", {"state": "active"})
        at(page, robot)
        expect(page.locator("#headline")).to_contain_text("wrong")
        expect(page.locator("#lost")).to_be_hidden()
        robot.gone.clear()
        robot.run(20)
        at(page, robot)
        expect(page.locator("#headline")).to_have_text("Nothing is wrong")
        visitor.close()
        assert not visitor.problems


def test_another_monitor_in_the_place_of_the_first_is_followed(visitor_of: Callable[[str], Any]) -> None:
    """The page of the first one holds what the second never told."""
    first = ScriptedRobot()
    live = LivePage(first.page.newest)
    visitor = visitor_of(live.url)
    page = visitor.open()
    at(page, first)
    port = int(live.url.rsplit(":", 1)[1].strip("/"))
    live.close()
    second = ScriptedRobot({"/other": "base"}, [("/other", "/elsewhere", ("/other",), 10, 10)])
    second.run(10)
    with LivePage(second.page.newest, port=port):
        at(page, second)
        expect(page.locator('#rows tr[data-entity="topic:/elsewhere"]').first).to_be_attached()
        expect(page.locator('#rows tr[data-entity="node:/lidar"]')).to_have_count(0)
        second.run()
        at(page, second)


def test_two_monitors_on_one_machine_keep_their_sessions_apart(visitor_of: Callable[[str], Any]) -> None:
    robots = (ScriptedRobot(), ScriptedRobot())
    robots[1].rates["/scan"] = 3
    robots[1].run(6)
    lives = [
        LivePage(robot.page.newest, access=Access({key: Person("Ada", Role.VIEW)}, view_needs_token=True))
        for robot, key in zip(robots, KEYS, strict=True)
    ]
    visitor = visitor_of(lives[0].url)
    page = visitor.open(f"/?token={KEYS[0]}")
    other = page.context.new_page()
    other.goto(f"{lives[1].url}?token={KEYS[1]}")
    for _ in range(2):
        expect(page.locator("#headline")).to_have_text("Nothing is wrong")
        expect(other.locator("#headline")).to_contain_text("1 wrong")
        page.reload()
        other.reload()
    visitor.close()
    assert not visitor.problems
    for live in lives:
        live.close()


def test_ten_thousand_alerts_are_counted_and_the_first_of_them_shown(visitor_of: Callable[[str], Any]) -> None:
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(6)
    found = msgspec.json.decode(robot.page.newest(), type=Snapshot)
    (one,) = found.alerts

    def alerts(count: int) -> tuple[Alert, ...]:
        return tuple(
            msgspec.structs.replace(one, key=f"k{number}", entity=f"topic:/t{number}", name=f"/t{number}")
            for number in range(count)
        )

    newest = [msgspec.json.encode(bounded(msgspec.structs.replace(found, alerts=alerts(10_000))))]
    with LivePage(lambda: newest[0]) as live:
        visitor = visitor_of(live.url)
        page = visitor.open()
        expect(page.locator("#headline")).to_contain_text("10000 wrong")
        expect(page.locator("#alerts")).to_contain_text("9,900 more; the table has them all.")
        assert page.locator("#alerts .cause").count() == 100
        newest[0] = msgspec.json.encode(bounded(msgspec.structs.replace(found, alerts=alerts(3))))
        expect(page.locator("#headline")).to_contain_text("3 wrong")
        expect(page.locator("#alerts .cause")).to_have_count(3)
        visitor.close()
        assert not visitor.problems

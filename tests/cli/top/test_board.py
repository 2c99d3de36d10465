"""The screen of `roslens top`, driven by Textual's pilot; what it shows is compared as text."""

import asyncio
from concurrent.futures import ThreadPoolExecutor

import pytest
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.cli.top.feed import AddressFeed, PageFeed
from roslens.model.errors import UsageError
from roslens.report.writing.terminal import Terminal

pytest.importorskip("textual", reason="the extra `top` is not installed: `make .venv/stamp`")
pytestmark = pytest.mark.timed

from roslens.cli.top.board import Board  # noqa: E402 - needs Textual


def terminal(width):
    return Terminal(width, color=True, unicode=True)


def robot(rate=4):
    made = ScriptedRobot()
    made.rates["/scan"] = rate
    made.run(5)
    return made


def feed_of(made):
    return PageFeed("rover", made.page.newest, made.page.detail)


def text_of(app):
    return "\n".join(strip.text.rstrip() for strip in app.screen._compositor.render_strips())


async def settled(pilot):
    """Wait until what was asked for is shown."""
    await pilot.pause()
    await pilot.app.workers.wait_for_complete()
    await pilot.pause()


def _run(act):
    # A browser of another test in this process has an event loop, that of the main thread.
    with ThreadPoolExecutor(1) as thread:
        thread.submit(lambda: asyncio.run(act())).result()


def drive(feed, *keys, size=(80, 24)):
    """Return what is on the screen at first and after each key."""
    shown = []

    async def act():
        app = Board(feed, terminal, pace_s=1000)
        async with app.run_test(size=size) as pilot:
            await settled(pilot)
            shown.append(text_of(app))
            for key in keys:
                await pilot.press(key)
                await settled(pilot)
                shown.append(text_of(app))

    _run(act)
    return shown


def test_what_is_wrong_stands_first_and_all_fits_80_by_24():
    [screen] = drive(feed_of(robot()))
    found = screen.splitlines()
    assert len(found) == 24
    assert all(len(line) <= 80 for line in found)
    assert "1 low" in found[0]
    assert "▼ low" in found[1]
    assert "/scan: rate is low: 4 Hz" in found[1]
    assert any("/lidar" in line for line in found[3:])
    assert "state" in screen
    assert "rate" in screen


def test_enter_on_an_alert_shows_its_row_and_all_that_is_known_of_it():
    *_, screen = drive(feed_of(robot()), "n")
    assert "topic /scan" in screen
    assert "expected 8..12 Hz" in screen
    assert "Look at the cable of the lidar" in screen
    table, about = screen.split("topic /scan")
    assert "▼ low             ▾ /scan" in table
    assert "Rate received" in about


def test_a_filter_leaves_what_fits_and_escape_takes_it_away():
    before, *_, filtered, cleared = drive(feed_of(robot()), "slash", "s", "c", "a", "n", "escape")
    assert "/odom" in before
    assert "/odom" not in filtered
    assert "/scan" in filtered
    assert "/odom" in cleared


def test_only_what_is_wrong():
    *_, worse = drive(feed_of(robot()), "w")
    assert "/scan" in worse
    assert "/odom" not in worse


def test_a_closed_row_hides_its_parts():
    before, closed = drive(feed_of(robot()), "space", size=(80, 60))
    assert "▾ base" in before
    assert "▾ /slam" in before
    assert "▸ base" in closed
    assert "▾ /slam" not in closed


def test_new_values_come_and_the_cursor_stays():
    made = robot()
    shown = []

    async def act():
        app = Board(feed_of(made), terminal, pace_s=1000)
        async with app.run_test(size=(80, 24)) as pilot:
            await settled(pilot)
            await pilot.press("j", "j")
            chosen = app._chosen().key
            made.rates["/scan"] = 10
            made.run(30)
            app._ask()
            await settled(pilot)
            shown.append(text_of(app))
            assert app._chosen().key == chosen

    _run(act)
    assert "10 Hz" in shown[0]
    assert "▼ low" not in shown[0]


def test_a_monitor_that_is_gone_is_told_and_the_last_look_stays():
    made = robot()
    calls = []

    def fetch(address, what):
        calls.append(what)
        if len(calls) > 1:
            raise UsageError(f"{address} does not answer: refused", expected="a `roslens watch --serve`")
        return made.page.newest()

    shown = []

    async def act():
        app = Board(AddressFeed("robot:8080", fetch), terminal, pace_s=1000)
        async with app.run_test(size=(120, 30)) as pilot:
            await settled(pilot)
            app._ask()
            await settled(pilot)
            shown.append(text_of(app))

    _run(act)
    assert "NOT CURRENT: robot:8080 does not answer" in shown[0]
    assert "/lidar" in shown[0]


def test_another_version_is_refused():
    with pytest.raises(UsageError, match="version 99"):
        AddressFeed(
            "robot:1", lambda address, what: robot().page.newest().replace(b'"version":2', b'"version":99')
        ).snapshot()


@pytest.mark.parametrize("size", [(40, 12), (200, 60)])
def test_other_sizes_do_not_break_it(size):
    *_, screen = drive(feed_of(robot()), "n", size=size)
    assert "low" in screen

"""Why something is wrong, on the page: in the alert, and behind the row with each step, evidence and what to try."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from dashboard.live.scripted_robot import ScriptedRobot
from playwright.sync_api import Browser, Page, expect

from roslens.compare.why.declared import Declared
from roslens.dashboard.live.serving import LivePage
from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, Proof
from roslens.model.graph import Endpoint, Role

Open = Callable[..., Page]
RULES = Path(__file__).with_name("accessible.js").read_text(encoding="utf-8")


def source() -> Declared:
    """Return what source says of a lidar that does not run."""
    scan = ConfiguredEndpoint(Endpoint("/lidar", Role.PUBLISHER, "/scan", "x/msg/X"), Proof("src/lidar.cpp", 7))
    lidar = ConfiguredNode("/lidar", Proof("launch/robot.launch.py", 3), package="drivers", executable="lidar_node",
                           defined=Proof("src/lidar.cpp", 1), endpoints=(scan,))  # fmt: skip
    return Declared("robot.launch.py", Configuration("robot.launch.py", "ros2", (lidar,)))


@pytest.fixture
def robot() -> ScriptedRobot:
    """Return a robot whose lidar died."""
    robot = ScriptedRobot()
    robot.page.why.declared = lambda _: source()
    robot.run(20)
    robot.gone.add("/lidar")
    robot.run(12)
    return robot


@pytest.fixture
def follow(robot: ScriptedRobot, browser: Browser, visitor_class: Any) -> Iterator[Open]:
    """Open the page of the robot; fails the test on any problem that it shows."""
    page = robot.page
    with LivePage(page.newest, detail=page.detail, past=page.past, board=page.board, why=page.why.page) as live:
        visitor = visitor_class(browser, live.url.rstrip("/"))
        yield visitor.open
        visitor.close()
        assert not visitor.problems


def shot(page: Page, name: str) -> None:
    """Keep a picture where $ROSLENS_PICTURES names a folder."""
    if folder := os.environ.get("ROSLENS_PICTURES"):
        page.screenshot(path=f"{folder}/{name}.png", full_page=True)


def test_an_alert_says_the_first_cause(follow: Open) -> None:
    page = follow()
    expect(page.locator("#alerts .why-line").first).to_contain_text("/lidar")
    shot(page, "why-alert")


def test_a_row_that_is_wrong_is_explained_with_steps_and_what_to_try(follow: Open) -> None:
    page = follow("/?select=topic:/scan")
    answer = page.locator("#detail .why-answer")
    expect(answer.locator(".why-cause")).to_contain_text("First cause: no node that is seen publishes it: /lidar ended")
    answer.get_by_text("steps").click()
    steps = answer.locator(".why-steps > li")
    assert steps.count() >= 6
    expect(answer.locator(".why-steps")).to_contain_text("src/lidar.cpp:7")
    expect(answer.locator(".why-steps > li.why-not").first).to_contain_text("made by")
    expect(answer.locator("code").first).to_have_text("ros2 run drivers lidar_node")
    shot(page, "why-panel")
    assert {name: found for name, found in page.evaluate(RULES).items() if found} == {}


def test_a_row_that_is_fine_is_explained_when_asked(follow: Open) -> None:
    page = follow("/?select=topic:/odom")
    button = page.locator("#detail .why-answer").get_by_role("button", name="Why?")
    button.click()
    expect(page.locator("#detail .why-cause")).to_have_text("No cause was found.")


def test_of_a_host_and_of_the_past_nothing_is_asked(follow: Open) -> None:
    page = follow("/?select=host:rover")
    expect(page.locator("#detail")).to_contain_text("Every signal")
    expect(page.locator("#detail .why-answer")).to_be_hidden()
    page = follow("/?select=topic:/odom&at=20")
    expect(page.locator("#detail")).to_contain_text("topic /odom")
    expect(page.locator("#detail .why-answer")).to_be_hidden()

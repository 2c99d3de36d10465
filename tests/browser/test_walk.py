"""The walk of a newcomer: something is late, so to the topic, its line, its node, its package, findings, and author.

Over what `make demo` serves: the example as a repository with a change, checked, beside a recording with a fault.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

ROOT = Path(__file__).parents[2]
RECORDING = ROOT / "examples/recording"
STEPS_OF_A_MINUTE = 8
"""Clicks and looks that a reader has time for in a minute."""


@pytest.fixture(scope="module")
def demo(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Return the address that `make demo` prints."""
    folder = tmp_path_factory.mktemp("demo")
    workspace, bag = folder / "demo", folder / "rover_drive"
    roslens = str(Path(sys.executable).with_name("roslens"))
    assert shutil.which("git")
    subprocess.run(["sh", ROOT / "examples/change.sh", workspace], check=True, capture_output=True)
    subprocess.run([sys.executable, RECORDING / "record.py", bag], check=True, capture_output=True)
    checked = subprocess.run(
        [roslens, "check", workspace, "--baseline", "HEAD", "--fail-on", "never", "--quiet"],
        capture_output=True, text=True, check=False, timeout=300,
    )  # fmt: skip
    assert checked.returncode in {0, 3}, checked.stderr
    command = [roslens, "serve", workspace, "--port", "0", "--bag", bag, "--reference", RECORDING / "rover.yaml"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as served:
        assert served.stdout
        match = next((hit for line in served.stdout if (hit := re.search(r"http://\S+", line))), None)
        assert match, "no address was printed"
        yield match[0].rstrip("/")
        served.terminate()


@pytest.fixture
def page(browser: Browser, demo: str) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    page = context.new_page()
    page.goto(demo + "/")
    yield page
    context.close()


def test_from_what_is_late_to_who_changed_it_last_and_back(page: Page) -> None:
    steps = 0

    def step() -> None:
        nonlocal steps
        steps += 1

    page.get_by_role("navigation", name="Pages").get_by_role("link", name="Live").click()
    step()
    expect(page.locator("#cost")).to_contain_text("read to the end")
    # One thing is wrong, and it is said what.
    alert = page.locator("#alerts .alert")
    expect(alert).to_have_count(1)
    expect(alert).to_contain_text("/scan")
    alert.get_by_role("link", name="source").click()
    step()
    # The topic: who publishes it, on which line, what was found there, who changed it last.
    expect(page.get_by_role("heading", level=1)).to_contain_text("/scan")
    code = page.locator("#code tbody tr").filter(has_text="range_filter.py")
    expect(code).to_contain_text("/range_filter")
    expect(code).to_contain_text("rover_sensors")
    expect(code).to_contain_text("roslens")
    topic = page.url
    code.get_by_role("link", name=re.compile(r"range_filter\.py:\d+")).click()
    step()
    # The line, which says what it does, among the findings of its file.
    expect(page.locator(".row:target")).to_contain_text("create_publisher")
    expect(page.locator(".row:target .marks")).to_contain_text("publishes /scan")
    expect(page.locator(".graph-mark").filter(has_text="defines node")).to_contain_text("/range_filter")
    page.locator(".graph-mark").filter(has_text="defines node").get_by_role("link", name="/range_filter").click()
    step()
    # The faulty node, its package, the findings of that.
    expect(page.get_by_role("heading", level=1)).to_contain_text("/range_filter")
    page.locator("#code").get_by_role("link", name="rover_sensors", exact=True).first.click()
    step()
    expect(page.get_by_role("heading", level=1)).to_contain_text("rover_sensors")
    expect(page.locator("#nodes")).to_contain_text("/range_filter")
    expect(page.locator("#findings .finding").first).to_be_visible()
    assert steps <= STEPS_OF_A_MINUTE
    # And back: from the package to its node, from there to how it runs.
    page.locator("#nodes").get_by_role("link", name="/range_filter", exact=True).click()
    page.get_by_role("link", name="Show it running").click()
    expect(page.locator("#detail h3")).to_contain_text("/range_filter")
    page.go_back()
    page.go_back()
    expect(page.get_by_role("heading", level=1)).to_contain_text("rover_sensors")
    assert topic.rpartition("/")[2] == "scan"


def test_what_was_driven_is_held_against_what_is_in_the_source(page: Page) -> None:
    page.get_by_role("navigation", name="Pages").get_by_role("link", name="Diff").click()
    rows = page.locator("#differences tbody tr")
    # The recording was made before the change, whose node it does not have.
    expect(rows).to_have_count(6)
    for words in (
        ("/battery_guard", "not there", "the source"),
        ("/robot_state_publisher", "not there", "the source"),
        ("/battery_monitor", "transient_local", "volatile"),
        ("/joystick", "not there", "what ran"),
        ("/sonar_board", "not there", "what ran"),
        ("max_linear_m_s", "0.8", "0.4"),
    ):
        row = rows.filter(has_text=words[0])
        for word in words[1:]:
            expect(row).to_contain_text(word)
    rows.filter(has_text="/battery_monitor").get_by_role("link", name=re.compile(r"battery_monitor\.py:\d+")).click()
    expect(page.locator(".row:target")).to_contain_text("create_publisher")


def test_a_name_is_found_from_every_page(page: Page) -> None:
    for start in ("/", "/live/"):
        page.goto(page.url.split("/", 3)[0] + "//" + page.url.split("/", 3)[2] + start)
        field = page.locator("header form.search input")
        field.fill("scan")
        field.press("Enter")
        expect(page.get_by_role("heading", level=1)).to_contain_text("Search for")
        first = page.locator("#results tbody tr").first
        expect(first).to_contain_text("/scan")
        expect(first).to_contain_text("topic")
        first.get_by_role("link").click()
        expect(page.get_by_role("heading", level=1)).to_contain_text("/scan")

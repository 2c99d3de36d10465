"""The journal and the questions in a browser: they follow, and are answered by who may operate."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from dashboard.journal.test_journal_pages import about, decision
from dashboard.live.scripted_robot import ScriptedRobot
from playwright.sync_api import Browser, Page, expect

from roslens.dashboard.access.person import Person, Role
from roslens.dashboard.access.policy import Access
from roslens.dashboard.journal.journal_view import JournalView
from roslens.dashboard.journal.questions import Questions
from roslens.dashboard.journal.routes import journal_links, journal_routes
from roslens.dashboard.live.further import Further
from roslens.dashboard.live.serving import LivePage
from roslens.store.journals.journal import Journal

KEY = "k" * 32


class Scene:
    """A journal that is written to, and questions, on a page of a robot that is fine."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "journal.jsonl"
        self.questions = Questions()
        robot = ScriptedRobot()
        more = journal_routes(
            JournalView(self.path, lambda seconds: f"{seconds:.1f}"), "rover", questions=self.questions
        )
        access = Access({KEY: Person("Ada", Role.OPERATE)})
        self.live = LivePage(robot.page.newest, access=access, further=Further(more, journal_links(acting=True)))

    def write(self, *entries: tuple[str, dict[str, Any]]) -> None:
        with Journal(self.path) as journal:
            for what, fields in entries:
                journal.add(what, 100.0, **fields)

    def ask(self, number: int = 1) -> None:
        one = decision(number)
        self.questions.ask(one, one.at_s + 60.0)


@pytest.fixture
def scene(tmp_path: Path) -> Iterator[Scene]:
    found = Scene(tmp_path)
    yield found
    found.live.close()


@pytest.fixture
def visit(scene: Scene, browser: Browser, request: pytest.FixtureRequest) -> Iterator[Callable[..., Page]]:
    """Open pages of the scene; fails the test on any problem that they show."""
    visitor = request.getfixturevalue("visitor_class")(browser, scene.live.url.rstrip("/"))
    yield visitor.open
    visitor.close()
    assert not visitor.problems


def test_the_journal_follows_and_is_filtered(scene: Scene, visit: Callable[..., Page]) -> None:
    scene.write(about("node:/lidar"))
    page = visit("/")
    page.get_by_role("link", name="Journal").click()
    expect(page.locator("#entries tbody tr")).to_have_count(1)
    scene.write(("outcome", {"decision": "r/1.1", "result": "done"}), about("node:/camera", 2))
    expect(page.locator("#entries tbody tr")).to_have_count(3)
    expect(page.locator("#entries tbody tr").first).to_contain_text("node:/camera")
    expect(page.locator("#verified")).to_contain_text("3 entries as they were written")
    page.get_by_label("About").select_option("node:/lidar")
    page.get_by_role("button", name="Show").click()
    expect(page.locator("#entries tbody tr")).to_have_count(2)
    expect(page).to_have_url(re.compile("entity=node"))
    scene.path.write_text(scene.path.read_text().replace("/lidar", "/radar"))
    expect(page.locator("#verified")).to_contain_text("Changed after it was written")


def test_a_question_comes_up_and_is_allowed_by_who_may_operate(scene: Scene, visit: Callable[..., Page]) -> None:
    page = visit(f"/questions?token={KEY}")
    expect(page.locator("#shown")).to_contain_text("Nothing is asked.")
    assert KEY not in page.url
    scene.ask()
    expect(page.locator(".question")).to_contain_text("restart node:/lidar")
    expect(page.locator("#waiting")).to_have_text("1")
    page.get_by_role("button", name="Allow").click()
    expect(page.locator("#shown")).to_contain_text("Allowed.")
    expect(page.locator(".question")).to_have_count(0)
    assert scene.questions.answers() == [("r.one/1.1", True, "Ada on the page (127.0.0.1)")]
    scene.ask(2)
    page.get_by_role("button", name="Deny").click()
    expect(page.locator("#shown")).to_contain_text("Denied.")
    assert scene.questions.answers() == [("r.one/2.1", False, "Ada on the page (127.0.0.1)")]


def test_a_question_is_answered_by_keyboard_and_keeps_the_focus(scene: Scene, visit: Callable[..., Page]) -> None:
    scene.ask()
    page = visit(f"/questions?token={KEY}")
    page.get_by_role("button", name="Deny").focus()
    scene.ask(2)
    expect(page.locator(".question")).to_have_count(2)
    expect(page.locator(".question").first.get_by_role("button", name="Allow")).to_be_focused()
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(page.locator("#shown")).to_contain_text("Denied.")
    assert [(one, allowed) for one, allowed, _ in scene.questions.answers()] == [("r.one/1.1", False)]


def test_it_is_answered_without_scripts(scene: Scene, visit: Callable[..., Page]) -> None:
    scene.ask()
    page = visit(f"/questions?token={KEY}", java_script_enabled=False)
    page.get_by_role("button", name="Allow").click()
    expect(page.locator("#shown")).to_contain_text("Allowed.")
    assert [(one, allowed) for one, allowed, _ in scene.questions.answers()] == [("r.one/1.1", True)]


@pytest.mark.parametrize("path", ["/journal", "/questions"])
@pytest.mark.parametrize("width", [1440, 420])
def test_nothing_is_wider_than_the_window(scene: Scene, visit: Callable[..., Page], path: str, width: int) -> None:
    scene.write(*(about(f"node:/{'long' * 30}{number}", number) for number in range(3)))
    scene.ask()
    page = visit(path, viewport={"width": width, "height": 800})
    page.wait_for_load_state("load")
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_a_server_that_ended_is_said(scene: Scene, visit: Callable[..., Page], browser: Browser) -> None:
    context = browser.new_context()
    page = context.new_page()
    page.goto(scene.live.url + "journal")
    expect(page.locator("#lost")).to_be_hidden()
    scene.live.close()
    expect(page.locator("#lost")).to_be_visible(timeout=10_000)
    context.close()

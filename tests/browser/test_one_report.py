"""Pages of one report, which `roslens study` and `roslens evidence` write: they open from a file without an error."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page
from process_metrics.small_repository import MANIFEST, SmallRepository, function

from roslens.cli.main import main

RULES = Path(__file__).with_name("accessible.js").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with both pages of a small workspace."""
    pytest.importorskip("duckdb")
    pytest.importorskip("scipy")
    made = SmallRepository(tmp_path_factory.mktemp("report") / "ws")
    for number in range(4):
        made.write(f"p{number}/package.xml", MANIFEST.format(f"p{number}"))
        made.write(f"p{number}/src/a.cpp", function("a", 3 * number))
    for name in ("first", "second"):
        made.write(f"p1/include/p1/{'the_name_of_a_header_that_is_long_' * 2}{name}.hpp", "int a();\n")
    made.commit("first", day=0)
    root = str(made.root)
    assert main(["check", root, "-q", "--fail-on", "never"]) == 0
    assert main(["study", root, "--format", "html", "-o", str(made.root / "study.html")]) == 0
    words = ["evidence", "p1", "--workspace", root, "--format", "html", "-o", str(made.root / "evidence.html")]
    assert main(words) == 0
    return made.root


@pytest.fixture
def opened(browser: Browser, folder: Path, request: pytest.FixtureRequest) -> Iterator[Page]:
    name, width, scheme = request.param
    context = browser.new_context(viewport={"width": width, "height": 800}, color_scheme=scheme)
    page = context.new_page()
    problems: list[str] = []
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.goto(f"file://{folder / name}.html")
    yield page
    context.close()
    assert problems == []


@pytest.mark.parametrize(
    "opened",
    [(name, width, scheme) for name in ("study", "evidence") for width, scheme in ((1280, "light"), (420, "dark"))],
    indirect=True,
)
def test_they_are_accessible_and_fit_and_keys_work(opened: Page) -> None:
    assert {name: found for name, found in opened.evaluate(RULES).items() if found} == {}
    assert opened.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth") == 0
    opened.keyboard.press("?")
    assert opened.locator("#help-window").is_visible()


@pytest.mark.parametrize("opened", [("evidence", 420, "light")], indirect=True)
def test_what_shows_a_requirement_is_on_a_narrow_screen(opened: Page) -> None:
    ends = [one.bounding_box() for one in opened.locator(".requirements .shown").all()]
    assert len(ends) == 32
    assert max(box["x"] + box["width"] for box in ends if box) <= 420

"""Pages of the past: a stretch drawn over a curve leads to what is different between its ends; nobody is shut out."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect
from process_metrics.small_repository import MANIFEST, SmallRepository, function

from .conftest import Visitor

RULES = Path(__file__).with_name("accessible.js").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Return the address of ``roslens serve`` over a repository of four revisions."""
    made = SmallRepository(tmp_path_factory.mktemp("past") / "robot")
    made.write("p/package.xml", MANIFEST.format("p"))
    for day in range(4):
        made.commit(f"{day}", day=day, p__a_DOT_cpp=function("a", 6 * day))
        made.git("tag", f"1.{day}.0")
    roslens = str(Path(sys.executable).with_name("roslens"))
    for words in (["history", "--every", "1"], ["check", "--process-metrics", "--fail-on", "never"]):
        subprocess.run([roslens, *words, "-q"], cwd=made.root, capture_output=True, check=True, timeout=120)
    command = [roslens, "serve", "--port", "0", "--no-graph"]
    with subprocess.Popen(
        command, cwd=made.root, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as served:
        assert served.stdout
        match = next((hit for line in served.stdout if (hit := re.search(r"http://\S+", line))), None)
        assert match, "no address was printed"
        yield match[0].rstrip("/")
        served.terminate()


@pytest.fixture
def visitor(browser: Browser, address: str) -> Iterator[Visitor]:
    made = Visitor(browser, address)
    yield made
    made.close()
    assert not made.problems


def test_a_stretch_leads_to_the_difference_of_its_ends(visitor: Visitor) -> None:
    page = visitor.open("/history/loc")
    box = page.locator("svg[data-commits]").first.bounding_box()
    assert box
    page.mouse.move(box["x"] + box["width"] * 0.36, box["y"] + 100)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.96, box["y"] + 100, steps=4)
    page.mouse.up()
    page.wait_for_url("**/difference?*")
    expect(page.locator("h1")).to_have_text("1.1.0 to 1.3.0")


def test_two_lists_do_the_same(visitor: Visitor) -> None:
    page = visitor.open("/history")
    page.get_by_label("From").select_option(label="1.0.0, 2020-09-13")
    page.get_by_role("button", name="Compare").click()
    expect(page.locator("h1")).to_have_text("1.0.0 to 1.3.0")


@pytest.mark.parametrize("path", ["/history", "/history/loc", "/difference", "/hotspots", "/"])
@pytest.mark.parametrize("width", [1280, 420])
def test_pages_are_accessible_and_fit(visitor: Visitor, path: str, width: int) -> None:
    page = visitor.open(path, viewport={"width": width, "height": 800})
    assert {name: found for name, found in page.evaluate(RULES).items() if found} == {}
    assert page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth") == 0


def test_what_is_new_is_read_without_scrolling_on_a_narrow_screen(visitor: Visitor) -> None:
    page = visitor.open("/difference?before=1.0.0&after=1.3.0", viewport={"width": 420, "height": 800})
    found = page.locator("#new .prose")
    expect(found.first).to_be_visible()
    for box in (one.bounding_box() for one in found.all()):
        assert box is not None
        assert box["x"] + box["width"] <= 420
    expect(page.locator("#values").get_by_role("link", name="Lines of code")).to_be_visible()


@pytest.mark.parametrize("path", ["/history", "/history/loc", "/hotspots"])
def test_the_scale_stays_in_sight_where_a_plot_scrolls(visitor: Visitor, path: str) -> None:
    page = visitor.open(path, viewport={"width": 420, "height": 800})
    plots = page.locator(".plot.latest")
    assert plots.count() > 0
    for number in range(plots.count()):
        plot = plots.nth(number)
        assert plot.evaluate("plot => plot.scrollWidth > plot.clientWidth")
        for end in ("plot.scrollWidth", "-plot.scrollWidth", "-60"):
            # Ticks stand in the plot's sight wherever it is scrolled to, beside the lines that they are of.
            sight = plot.evaluate(f"""plot => {{
              plot.scrollLeft = {end};
              const around = plot.getBoundingClientRect();
              return [...plot.querySelectorAll('text[x="-8"]')].map((tick) => {{
                const box = tick.getBoundingClientRect();
                return box.left >= around.left && box.right <= around.left + 60;
              }});
            }}""")
            assert len(sight) > 1
            assert all(sight)


def test_a_scale_stands_beside_the_lines_that_it_is_of(visitor: Visitor) -> None:
    page = visitor.open("/history/loc", viewport={"width": 420, "height": 800})
    offsets = page.evaluate("""() => {
      const middles = (what) => [...document.querySelectorAll(what)].map((one) => {
        const box = one.getBoundingClientRect();
        return box.top + box.height / 2;
      });
      const lines = middles(".plot .grid");
      return middles('.plot text[x="-8"]').map((tick, place) => Math.abs(tick - lines[place]));
    }""")
    assert len(offsets) > 2
    assert max(offsets) < 4


def test_a_curve_begins_where_the_text_does(visitor: Visitor) -> None:
    page = visitor.open("/history/loc", viewport={"width": 1700, "height": 900})
    curve, head = (page.locator(one).first.bounding_box() for one in (".plot svg", "h1"))
    assert curve
    assert head
    assert abs(curve["x"] - head["x"]) < 2


def test_numbers_of_a_quantity_have_the_digits_that_it_needs(visitor: Visitor) -> None:
    page = visitor.open("/history")
    row = page.locator("tr", has=page.get_by_role("link", name="Lines of code", exact=True)).last
    assert "." not in row.inner_text()

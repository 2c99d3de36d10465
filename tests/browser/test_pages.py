"""Files, metrics, rules, search, help, theme, sorting, twins and the way through by keyboard."""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect

Visit = Callable[..., Page]
Fetch = Callable[[str], str]


@pytest.fixture(scope="module")
def flagged(fetch: Fetch) -> tuple[str, int]:
    """Return path and line of a finding far down in a file."""
    found = json.loads(fetch("/findings.json?severity=warning&group=file"))["findings"]
    best = max((one for one in found if one.get("line")), key=lambda one: int(one["line"]))
    return best["path"], best["line"]


def test_file_page_shows_source_with_findings_in_the_margin(visit: Visit, flagged: tuple[str, int]) -> None:
    path, line = flagged
    page = visit(f"/files/{path}#L{line}")
    row = page.locator(f"#L{line}")
    expect(row).to_be_in_viewport()
    expect(row).to_have_class(re.compile("flagged"))
    assert row.evaluate("one => one.matches(':target')")
    assert page.locator(".source code .k").count() > 0
    assert page.locator(".source code .c").count() > 0
    colours = page.evaluate(
        "['.source code .k', '.source code'].map(one => getComputedStyle(document.querySelector(one)).color)"
    )
    assert colours[0] != colours[1]
    expect(page.locator("h1")).to_contain_text(path.rpartition("/")[2])
    # What stands in source stays text.
    expect(page.locator(".source")).to_contain_text("<script>alert('x')</script>")
    page.locator("#L2 a.n").click()
    expect(page).to_have_url(re.compile("#L2$"))
    page.get_by_label("Severity").select_option("error")
    expect(page).to_have_url(re.compile("severity=error"))
    expect(row.locator(".margin-note")).to_have_count(0)
    assert page.locator("#functions tbody tr").count() > 0


def test_metric_page_shows_distribution_worst_and_bounds(visit: Visit, fetch: Fetch) -> None:
    page = visit("/metrics")
    page.get_by_role("link", name="Cyclomatic complexity", exact=True).first.click()
    expect(page).to_have_url(re.compile("/metrics/."))
    page.wait_for_load_state()
    figures = json.loads(fetch("/metrics/cyclomatic_complexity.json"))["figures"]
    bars = page.locator(".distribution .bars rect")
    counts = [
        int(text.rpartition(": ")[2].replace(",", "")) for text in bars.locator("title").evaluate_all(
            "all => all.map(one => one.textContent)"
        )
    ]  # fmt: skip
    assert sum(counts) == figures["n"]
    assert page.locator(".distribution .bounds line").count() > 0
    expect(page.locator("#worst tbody tr")).to_have_count(20)
    expect(page.locator("#worst tbody tr").first.locator(".num")).to_contain_text(f"{figures['most']:.0f}")
    expect(page.locator("#worst")).not_to_contain_text("<span")
    assert page.locator("#bounds tbody tr").count() > 3
    page.get_by_text("As a table").click()
    expect(page.locator(".twin table")).to_be_visible()
    page.get_by_role("link", name="packages", exact=True).click()
    expect(page).to_have_url(re.compile("kind=package"))
    page.locator("#worst tbody a").first.click()
    expect(page).to_have_url(re.compile("/packages/"))


def test_rules_lead_to_a_rule_and_its_findings(visit: Visit) -> None:
    page = visit("/rules")
    page.locator("#text").fill("calls")
    page.keyboard.press("Enter")
    expect(page).to_have_url(re.compile("text=calls"))
    page.get_by_role("link", name=re.compile("^(Calls above 10|ros.calls.max)$")).first.click()
    expect(page.locator("h1")).to_have_text("Calls above 10")
    page.wait_for_load_state()
    expect(page.get_by_text("Why it matters")).to_be_visible()
    assert set(page.locator(".finding").evaluate_all("all => all.map(one => one.dataset.rule)")) == {"ros.calls.max"}


def test_search_offers_matches_and_goes_there(visit: Visit) -> None:
    page = visit("/rules")
    page.keyboard.press("/")
    expect(page.locator("#q")).to_be_focused()
    page.keyboard.type("nav2_amcl")
    expect(page.locator("#search-found")).to_be_visible()
    page.keyboard.press("ArrowDown")
    expect(page.locator("#search-found [aria-selected=true]")).to_contain_text("nav2_amcl")
    page.keyboard.press("Enter")
    expect(page).to_have_url(re.compile("/packages/nav2_amcl$"))
    page.wait_for_load_state()
    page.keyboard.press("/")
    page.keyboard.type("zzz")
    expect(page.get_by_text("Nothing has this in its name.")).to_be_visible()
    page.keyboard.press("Escape")
    expect(page.locator("#search-found")).to_be_hidden()
    page.keyboard.press("/")
    page.keyboard.type("costmap")
    page.keyboard.press("Enter")
    expect(page).to_have_url(re.compile(r"/search\?q=costmap"))
    expect(page.locator("#results tbody tr").first).to_be_visible()


def test_help_opens_and_closes(visit: Visit) -> None:
    page = visit("/")
    shown = page.locator("#help-window")
    page.keyboard.press("?")
    expect(shown).to_be_visible()
    page.keyboard.press("Escape")
    expect(shown).to_be_hidden()
    page.get_by_role("link", name="Help").click()
    expect(shown).to_be_visible()
    page.get_by_role("button", name="Close").click()
    expect(shown).to_be_hidden()


def test_dark_is_kept_over_pages(visit: Visit) -> None:
    page = visit("/", color_scheme="light")
    ground = "getComputedStyle(document.body).backgroundColor"
    light = page.evaluate(ground)
    page.get_by_role("button", name="Dark").click()
    dark = page.evaluate(ground)
    assert dark != light
    page.locator("nav").get_by_role("link", name="Rules").click()
    expect(page.get_by_role("button", name="Light")).to_be_visible()
    page.wait_for_load_state()
    assert page.evaluate(ground) == dark
    page.keyboard.press("d")
    assert page.evaluate(ground) == light


def test_tables_sort_and_the_address_keeps_it(visit: Visit) -> None:
    page = visit("/packages")
    head = page.locator("#packages th", has_text="Code lines")
    head.get_by_role("link").click()
    expect(head).to_have_attribute("aria-sort", "descending")
    place = page.locator("#packages thead th").all_inner_texts().index("Code lines")

    def shown() -> list[int]:
        cells = page.locator(f"#packages tbody tr > :nth-child({place + 1})").all_inner_texts()
        return [int(text.replace(",", "")) for text in cells if text.strip() not in {"", "\N{EN DASH}"}]

    assert shown() == sorted(shown(), reverse=True)
    head.get_by_role("link").click()
    expect(head).to_have_attribute("aria-sort", "ascending")
    page.reload()
    expect(head).to_have_attribute("aria-sort", "ascending")
    assert shown() == sorted(shown())


@pytest.mark.parametrize("path", ["/", "/graph", "/packages", "/findings", "/metrics", "/rules", "/failures"])
def test_each_page_links_to_its_twins(visit: Visit, fetch: Fetch, path: str) -> None:
    page = visit(path)
    address = page.get_by_role("link", name="This page as JSON").evaluate("one => one.pathname + one.search")
    assert json.loads(fetch(address))["run"]["id"]
    tables = page.get_by_role("link", name="CSV", exact=True)
    assert tables.count() > 0
    for link in tables.all():
        rows = list(csv.reader(io.StringIO(fetch(link.evaluate("one => one.pathname + one.search")))))
        assert len(rows) > 1
        assert len({len(row) for row in rows}) == 1


def test_skip_link_and_keys_lead_through_the_pages(visit: Visit) -> None:
    page = visit("/")
    page.keyboard.press("Tab")
    skip = page.get_by_role("link", name="Skip to content")
    expect(skip).to_be_focused()
    expect(skip).to_be_in_viewport()
    page.keyboard.press("Enter")
    expect(page.locator("#main")).to_be_focused()
    for key, path in (("g", "/graph"), ("p", "/packages"), ("f", "/findings"), ("m", "/metrics"), ("r", "/rules")):
        page.keyboard.press("g")
        page.keyboard.press(key)
        expect(page).to_have_url(re.compile(path))
        page.wait_for_load_state()
    page.locator("#rules thead a").first.focus()
    assert page.evaluate("getComputedStyle(document.activeElement).outlineStyle") == "solid"


def test_what_to_fix_first_leads_to_its_line(visit: Visit) -> None:
    page = visit("/")
    place = page.locator(".first li a.place").first
    path = place.inner_text().partition(":")[0]
    place.click()
    expect(page).to_have_url(re.compile(f"/files/{re.escape(path)}"))


def test_of_a_long_path_its_end_with_the_line_is_shown(visit: Visit) -> None:
    page = visit("/findings", viewport={"width": 1440, "height": 900})
    where = page.locator(".finding .where").first
    where.locator(".place").evaluate("one => { one.textContent = `${'a_long_folder/'.repeat(20)}file.cpp:54`; }")
    sides = where.evaluate(
        """(one) => [one, one.querySelector(".place")].map((part) => part.getBoundingClientRect())
           .map(({ left, right }) => ({ left, right }))"""
    )
    assert sides[1]["left"] < sides[0]["left"]
    assert abs(sides[1]["right"] - sides[0]["right"]) < 2


def test_long_names_do_not_widen_a_narrow_screen(visit: Visit) -> None:
    page = visit("/findings?group=function", viewport={"width": 420, "height": 800})
    page.locator(".group h3").first.evaluate(
        "one => one.append(Object.assign(document.createElement('code'), { textContent: 'folder_name/'.repeat(9) }))"
    )
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.parametrize(("words", "more"), [(10, "History"), (11, "Countermeasures"), (15, "Countermeasures")])
def test_the_top_of_a_page_fits_a_screen_whatever_the_site_has(visit: Visit, words: int, more: str) -> None:
    page = visit("/", viewport={"width": 1440, "height": 900})
    page.locator(".top nav").evaluate(
        """(nav, [words, more]) => {
          while (nav.children.length > words) nav.lastElementChild.remove();
          while (nav.children.length < words) nav.insertAdjacentHTML("beforeend", `<a href="/">${more}</a>`);
        }""",
        [words, more],
    )
    assert page.evaluate("document.documentElement.scrollWidth") <= 1440
    box = page.locator(".top").get_by_text("Help").bounding_box()
    assert box
    assert box["x"] + box["width"] <= 1440


def test_the_name_of_a_row_that_stays_in_sight_is_level_with_its_values(visit: Visit) -> None:
    page = visit("/packages", viewport={"width": 420, "height": 800})
    ends = page.evaluate("""() => [...document.querySelectorAll(".scroll > table tbody tr")].map((row) =>
      [...row.cells].slice(0, 2).map((cell) => cell.getBoundingClientRect().bottom))""")
    assert len(ends) > 5
    # What is moved by itself is drawn on whole pixels, and the rest of its row where it comes to stand.
    assert all(name == value and round(name - ends[0][0], 3).is_integer() for name, value in ends)


def test_what_a_result_is_stands_below_its_name_on_a_narrow_screen(visit: Visit) -> None:
    page = visit("/search?q=a", viewport={"width": 420, "height": 800})
    row = page.locator("#search-results tbody tr").filter(has=page.locator("td:last-child:not(:empty)")).first
    name, more = (row.locator("td").nth(place).bounding_box() for place in (0, 1))
    assert name
    assert more
    assert more["y"] >= name["y"] + name["height"]
    assert more["x"] == name["x"]

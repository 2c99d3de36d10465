"""Every screen of one site: the rules of axe-core, the keyboard, a narrow screen, eyes that see few colours."""

from __future__ import annotations

import itertools
import re
import subprocess
from collections.abc import Callable, Iterator
from importlib import resources
from pathlib import Path
from typing import Any

import pytest
from browser.whole_site import KEY, SCREENS, WholeSite, signed_in
from playwright.sync_api import Browser, Page, expect

from roslens.dashboard.listener import Tls
from roslens.store.journals.journal import Journal

Open = Callable[..., Page]
DEFICIENCIES = ("protanopia", "deuteranopia", "tritanopia", "achromatopsia", "blurredVision")
TABS = 25
FURTHER = ("/search?q=scan", "/conformance?show=all")
"""Addresses that name more than the screens do."""
RULES = {"light": "undefined", "dark": "['color-contrast', 'link-in-text-block']"}
"""Of axe-core that are tried, by scheme; colours are all that differs in the dark."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Iterator[WholeSite]:
    """Serve the site."""
    site = WholeSite(tmp_path_factory.mktemp("whole"))
    yield site
    site.close()


@pytest.fixture
def visit(whole: WholeSite, browser: Browser, request: pytest.FixtureRequest) -> Iterator[Open]:
    """Open its screens; fails the test on any problem that they show."""
    visitor = request.getfixturevalue("visitor_class")(browser, whole.url)
    yield visitor.open
    visitor.close()
    assert not visitor.problems


@pytest.fixture(scope="session")
def axe() -> str:
    """Return axe-core."""
    package = pytest.importorskip("axe_playwright_python", reason="axe-core comes with the extra `dev`")
    return (resources.files(package) / "axe.min.js").read_text("utf-8")


def go(page: Page, whole: WholeSite, path: str) -> None:
    """Open another screen in the same page, and wait until nothing is asked for any more."""
    page.goto(whole.url + path)
    page.wait_for_load_state()
    if path.startswith("/live/") and not re.search("references|compared", path):
        expect(page.locator("#tree-count")).to_contain_text("rows")
    if "select=" in path:
        expect(page.locator("#plots canvas").first).to_be_visible()


NAVIGATION = """() => [...document.querySelectorAll("header.top nav a")].map(
    (one) => [new URL(one.href).pathname, one.firstChild.textContent.trim()])"""


def _breaks(page: Page, rules: str) -> dict[str, list[str]]:
    found = page.evaluate(f"() => axe.run(document, {{ resultTypes: ['violations'], runOnly: {rules} }})")
    return {one["id"]: [node["html"][:160] for node in one["nodes"][:3]] for one in found["violations"]}


def test_each_screen_breaks_no_rule_of_axe_links_its_names_and_is_walked_by_the_tab_key(
    whole: WholeSite, visit: Open, axe: str
) -> None:
    """One load of each screen for four questions, as to load a screen takes longer than to ask it."""
    page = visit(signed_in("/"))
    known = known_names(page, whole.url)
    assert {"/scan", "node:/lidar", "nav2_util", "cpp.explicit_constructor", "/left/camera"} <= known
    broken, unlinked, stuck, leading = {}, {}, {}, {}
    for path in (*SCREENS, *FURTHER):
        go(page, whole, path)
        if found := page.evaluate(UNLINKED, sorted(known)):
            unlinked[path] = sorted(set(found))
        if path in FURTHER:
            continue
        leading[path] = page.evaluate(NAVIGATION)
        page.evaluate(axe)
        for scheme, rules in RULES.items():
            page.emulate_media(color_scheme=scheme)
            if breaks := _breaks(page, rules):
                broken[path, scheme] = breaks
        page.emulate_media(color_scheme="light")
        if wrong := _wrong_on_the_walk(page):
            stuck[path] = wrong
    assert {"/live/", "/live/references", "/questions"} < {where for where, _ in leading["/"]}
    assert {path: links for path, links in leading.items() if links != leading["/"]} == {}, "one navigation"
    assert broken == {}
    assert unlinked == {}, "what has a place of its own leads there from wherever it is named"
    assert stuck == {}, "each step reaches something else that can be seen and that shows its focus"


def test_no_screen_scrolls_sideways_at_420_pixels(whole: WholeSite, visit: Open) -> None:
    page = visit(signed_in("/"), viewport={"width": 420, "height": 800})
    wide, cut = {}, {}
    for path in SCREENS:
        go(page, whole, path)
        width = page.evaluate("document.documentElement.scrollWidth")
        if width > 420:
            wide[path] = width
        if beyond := page.evaluate(BEYOND):
            cut[path] = beyond
    assert wide == {}
    assert cut == {}, "whole sentences are read without scrolling"


BEYOND = """() => [...document.querySelectorAll("td.prose, .alert .says, .detail td, .stacked td")].filter(
    (one) => one.getClientRects().length && one.getBoundingClientRect().right > innerWidth
).map((one) => one.textContent)"""


def _wrong_on_the_walk(page: Page) -> list[str]:
    """Return what is wrong with where the tab key leads; where it reaches fewer than four elements, all of it."""
    seen = []
    for _ in range(TABS):
        page.keyboard.press("Tab")
        seen.append(page.evaluate(FOCUSED))
    wrong = [one for one in itertools.takewhile(lambda one: one not in ("end", "again"), seen) if one]
    return wrong or (seen if len([one for one in seen if not one]) < 4 else [])


FOCUSED = """() => {
  const one = document.activeElement;
  window.walked ??= [];
  const again = window.walked.includes(one) && one !== document.body;
  window.walked.push(one);
  const box = one.getBoundingClientRect();
  const style = getComputedStyle(one);
  const shown = box.width > 0 && box.height > 0;
  const marked = style.outlineStyle !== "none" || style.boxShadow !== "none";
  const what = one.outerHTML.slice(0, 90);
  if (one === document.body || again) return again ? "again" : "end";
  return !shown ? `unseen ${what}` : !marked ? `unmarked ${what}` : "";
}"""
UNLINKED = """(known) => {
  const names = new Set(known), found = [];
  // The page of a thing is about it, and its parameters and log are what every node has: there is no page of these.
  const own = `${document.querySelector("h1")?.textContent} ${location.pathname}`;
  for (const one of document.querySelectorAll("main *")) {
    if ([...one.children].some((part) => part.localName !== "wbr")) continue;
    const text = one.textContent.trim();
    if (!names.has(text) || own.includes(text) || !one.checkVisibility()) continue;
    if (!one.closest("a, button, option, [role=button], [data-entity], [data-select], fieldset")) found.push(text);
  }
  return found;
}"""


def known_names(page: Page, base: str) -> set[str]:
    """Return every name that the pages of this site have a place for, and by kind those of what runs."""
    found = set()
    for path, table, key in (
        ("packages", "packages", "package"), ("rules", "rules", "rule"), ("computation/rover", "nodes", "node"),
    ):  # fmt: skip
        twin = page.request.get(f"{base}/{path}.json").json()
        found |= {str(row[key]) for row in twin["tables"][table]["rows"]}
    for row in page.request.get(f"{base}/live/snapshot.json").json()["rows"]:
        if row["kind"] in ("host", "node", "topic"):
            found |= {row["name"], row["entity"]}
    return found - {"rover"}


def test_what_runs_and_is_not_in_source_leads_to_what_is_known_of_it_as_it_runs(whole: WholeSite, visit: Open) -> None:
    page = visit(signed_in("/conformance"))
    page.locator("#differences").get_by_role("link", name="node /ui", exact=True).first.click()
    expect(page).to_have_url(re.compile("/live/.*select=node%3A%2Fui"))


def test_states_are_told_apart_by_sign_and_word(whole: WholeSite, visit: Open) -> None:
    page = visit(signed_in("/live/"))
    go(page, whole, "/live/")
    marks = page.locator("#counts .mark")
    signs = marks.evaluate_all("all => all.map(one => one.querySelector('use').getAttribute('href'))")
    words = [text.split(" ", 1)[1] for text in marks.all_text_contents()]
    assert len(signs) == len(set(signs)) >= 3
    assert len(words) == len(set(words))
    # The form of each sign is another one, whatever its colour is.
    forms = page.evaluate("signs => signs.map(one => document.querySelector(one).innerHTML)", signs)
    assert len(forms) == len(set(forms))
    session = page.context.new_cdp_session(page)
    for deficiency in DEFICIENCIES:
        session.send("Emulation.setEmulatedVisionDeficiency", {"type": deficiency})
        pictures = [one.screenshot() for one in page.locator("#counts .mark svg").all()]
        assert len(pictures) == len(set(pictures)), deficiency


def test_countermeasures_with_a_log_of_the_condition_that_was_true(whole: WholeSite, visit: Open) -> None:
    with Journal(whole.journal) as journal:
        because = [{"entity": "node:/lidar", "statement": "/lidar is gone", "state": "gone", "since": 99.0}]
        journal.add("decided", 102.0, decision="rover.lidar/2.1", entity="node:/lidar", because=because)
    page = visit(signed_in("/plan"))
    expect(page.locator(".measure").first).to_contain_text("When node /lidar is gone or stopped")
    named = page.locator(".measure a", has_text="/lidar")
    assert {one.get_attribute("href") for one in named.all()} == {"/live/?select=node%3A/lidar"}
    expect(named).to_have_count(2)
    page.locator(".measure a", has_text="decisions").first.click()
    entry = page.locator("#entries tr", has_text="rover.lidar/2.1").first
    expect(entry).to_contain_text("because /lidar is gone")
    entry.locator(".decision a").click()
    expect(page.locator("#entries tbody tr")).to_have_count(1)


def test_a_finding_is_accepted_and_taken_back_on_its_list(whole: WholeSite, visit: Open) -> None:
    page = visit(signed_in("/findings?severity=error"))
    first = page.locator(".finding").first
    first.locator("summary").click()
    first.get_by_label("Why it stays").fill("the caller checks it")
    first.get_by_role("button", name="Accept").click()
    expect(page).to_have_url(re.compile("severity=error"))
    expect(page.locator(".finding").first.locator("summary")).to_contain_text("accepted")
    assert 'reason = "the caller checks it"' in whole.accepted.read_text("utf-8")
    page.goto(whole.url + "/findings")
    page.locator(".reviewed summary").click()
    expect(page.locator(".reviewed li")).to_contain_text("the caller checks it")
    page.locator(".reviewed").get_by_role("button", name="Take it back").click()
    expect(page.locator(".reviewed")).to_have_count(0)
    assert not whole.accepted.exists()


def test_a_session_over_https(tmp_path: Path, browser: Browser, request: pytest.FixtureRequest) -> None:
    key, certificate = tmp_path / "key.pem", tmp_path / "certificate.pem"
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2",
         "-subj", "/CN=localhost", "-keyout", key, "-out", certificate],
        check=True, capture_output=True,
    )  # fmt: skip
    site = WholeSite(tmp_path, Tls(certificate, key))
    visitor: Any = request.getfixturevalue("visitor_class")(browser, site.url)
    try:
        page = visitor.open(signed_in("/live/"), ignore_https_errors=True)
        assert page.url == f"{site.url}/live/"
        (cookie,) = page.context.cookies()
        assert (cookie["secure"], cookie["httpOnly"], cookie["sameSite"]) == (True, True, "Lax")
        assert KEY not in cookie["value"]
        expect(page.locator("#pulse-word")).to_have_text("live")
        site.robot.rates["/scan"] = 10
        site.robot.run(6)
        expect(page.locator("#when")).to_have_text(f"12:00:{site.robot.now:04.1f}")
        expect(page.locator('#rows tr[data-entity="topic:/scan"]').first).to_have_class(re.compile(r"\bok\b"))
        # Who holds a token acts: the page may acknowledge.
        site.robot.rates["/scan"] = 3
        site.robot.run(6)
        with page.expect_response(lambda one: one.request.method == "POST"):
            page.locator("#alerts").get_by_role("button", name="Acknowledge").first.click()
        site.robot.run(1)
        expect(page.locator("#alerts")).to_contain_text("acknowledged by Ada")
        visitor.close()
        assert not visitor.problems
    finally:
        site.close()

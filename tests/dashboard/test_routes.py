"""What every page must have: an address, a template, a way to it, twins, a place in the reference."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from roslens.dashboard.address import PLACES, PageRef, served_path
from roslens.dashboard.export import pages_of
from roslens.dashboard.render import NAVIGATION, PARENTS, TEMPLATES
from roslens.dashboard.routes import PAGES, Target, candidates
from roslens.dashboard.site import Site
from roslens.dashboard.view import Request

REFERENCE = Path(__file__).parents[2] / "docs" / "reference" / "report_pages.md"
IN_THE_FRAME = {"search", "help"}


@pytest.mark.parametrize("page", PAGES)
def test_a_page_has_a_template_and_an_address(page: str) -> None:
    assert (TEMPLATES / "pages" / f"{page}.html").is_file()
    assert page in PLACES


@pytest.mark.parametrize("page", PAGES)
def test_a_page_can_be_reached(page: str) -> None:
    frame = (TEMPLATES / "chrome.html").read_text(encoding="utf-8")
    navigation = {name for name, _ in NAVIGATION}
    reached = page in navigation or PARENTS.get(page) in navigation
    assert reached or (page in IN_THE_FRAME and f"reference('{page}')" in frame)


def test_a_page_has_a_json_twin(site: Site) -> None:
    for page, ref in {ref.page: ref for ref in pages_of(site)}.items():
        view = PAGES[page](site, Request(ref.key))
        assert view is not None
        assert json.loads(view.to_json(site.run_facts()))["page"] == page
        assert Target(page, ref.key, "json") in candidates(served_path(ref) + ".json")


@pytest.mark.parametrize("page", PAGES)
def test_a_page_is_in_the_reference(page: str) -> None:
    text = REFERENCE.read_text(encoding="utf-8")
    address = "/" if page == "overview" else "/" + served_path(PageRef(page, "KEY")).replace("KEY", "<")
    assert re.search(rf"^\| {page} \| `{re.escape(address)}", text, re.MULTILINE)


def test_the_reference_names_every_table(site: Site) -> None:
    text = REFERENCE.read_text(encoding="utf-8")
    for page, ref in {ref.page: ref for ref in pages_of(site)}.items():
        view = PAGES[page](site, Request(ref.key, complete=True))
        assert view is not None
        row = next(line for line in text.splitlines() if line.startswith(f"| {page} |"))
        assert [table.name for table in view.tables if f"`{table.name}`" not in row] == []


def test_a_key_that_looks_like_a_twin_is_a_page_first() -> None:
    assert candidates("files/config.json") == [Target("file", "config.json"), Target("file", "config", "json")]
    assert candidates("packages/a.findings.csv")[1:] == [
        Target("package", "a", "csv", "findings"),
        Target("package", "a.findings", "csv"),
    ]

"""One file with all pages: nothing outside of it is needed, nothing in it leads nowhere, and it stays small."""

from __future__ import annotations

import json
import re
import time
from html.parser import HTMLParser
from pathlib import Path
from types import ModuleType
from urllib.parse import unquote

import pytest
from pace import turned_s

from roslens.dashboard.address import PageRef
from roslens.dashboard.section import fold_into_file, with_live_links
from roslens.dashboard.single_file import single_file, single_page
from roslens.dashboard.site import Site
from roslens.model.errors import UsageError


class Single(HTMLParser):
    """Ids, links, resources and rows of tables of each section."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.resources: list[str] = []
        self.sections: list[str] = []
        self.rows: dict[str, int] = {}
        self._depth = 0
        self._body = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        self.ids += [found["id"] or ""] if "id" in found else []
        if tag == "section":
            if not self._depth:
                self.sections.append(found.get("id") or "")
            self._depth += 1
        if tag == "tbody":
            self._body = True
        if tag == "tr" and self._body and self.sections:
            self.rows[self.sections[-1]] = self.rows.get(self.sections[-1], 0) + 1
        if tag == "a" and found.get("href"):
            self.links.append(found["href"] or "")
        self.resources += [found[name] or "" for name in ("src", "srcset", "data") if name in found]
        if tag in {"link", "use", "image"} and found.get("href"):
            self.resources.append(found["href"] or "")

    def handle_endtag(self, tag: str) -> None:
        if tag == "section":
            self._depth -= 1
        if tag == "tbody":
            self._body = False


@pytest.fixture(scope="module")
def text(site: Site) -> str:
    return single_page(site)


@pytest.fixture(scope="module")
def page(text: str) -> Single:
    return Single(text)


def test_every_page_is_a_section(site: Site, page: Single) -> None:
    assert page.sections[:8] == ["overview", "graph", "packages", "findings", "metrics", "rules", "failures", "help"]
    packages = [f"packages/{package.id}" for package in site.packages]
    assert [name for name in page.sections if name.startswith("packages/")] == packages
    assert [name for name in page.sections if name.startswith("files/")] != []


def test_sections_are_closed(text: str) -> None:
    assert text.count("<section") == text.count("</section>")


def test_no_name_is_there_twice(page: Single) -> None:
    # The graph keeps its names for scripts, and its table and its picture are both called so.
    twice = {name for name in page.ids if page.ids.count(name) > 1}
    assert twice <= {"graph"}


def test_every_link_leads_somewhere(page: Single) -> None:
    known = set(page.ids)
    dead = [link for link in page.links if link.startswith("#") and unquote(link[1:].partition("?")[0]) not in known]
    assert dead == []


def test_nothing_is_loaded(page: Single, text: str) -> None:
    assert [found for found in page.resources if not found.startswith(("#", "data:"))] == []
    style = text.partition("<style>")[2].partition("</style>")[0]
    assert "@import" not in style
    assert not re.search(r"url\((?!['\"]?(?:#|data:))", style)
    assert [link for link in page.links if not link.startswith("#") and not link.startswith("https://")] == []


def test_tables_are_complete_without_scripts(site: Site, page: Single) -> None:
    assert page.rows["packages"] == len(site.packages)
    assert page.rows["rules"] == len(site.rules)
    assert page.rows["metrics"] == len(site.quantities)


def test_the_search_index_leads_to_sections(page: Single, text: str) -> None:
    index = json.loads(text.partition('id="search-index">')[2].partition("</script>")[0])
    assert index
    assert {unquote(entry[3][1:]) for entry in index} <= set(page.sections)


def test_text_from_source_is_escaped(text: str) -> None:
    assert "<script>alert" not in text
    assert "&lt;script&gt;alert" in text


def test_what_is_left_out_is_said(site: Site, text: str) -> None:
    rows = re.findall(r'<th scope="row">(Packages|Files|Rules|Metrics) [^<]*</th><td class="num">([\d,]+)</td>', text)
    assert [name for name, _ in rows] == ["Packages", "Files", "Rules", "Metrics"]
    assert int(rows[0][1]) == len(site.packages)


def test_it_is_the_same_every_time(bare_site: Site) -> None:
    assert single_page(bare_site) == single_page(bare_site)


def test_the_file_takes_the_place_of_an_older_one(bare_site: Site, tmp_path: Path) -> None:
    out = tmp_path / "deep" / "report.html"
    out.parent.mkdir()
    out.write_text("old", encoding="utf-8")
    single_file(bare_site, out)
    assert out.read_text(encoding="utf-8") == single_page(bare_site)
    assert [path.name for path in out.parent.iterdir()] == ["report.html"]


def test_many_graphs_leave_room_for_the_rest_and_what_is_missing_is_said(bare_site: Site, made_up: ModuleType) -> None:
    large = made_up.large()
    site = Site(
        bare_site.view,
        quantities=bare_site.quantities,
        models=bare_site.models,
        configurations={f"large_{number}": large for number in range(9)},
    )
    text = single_page(site)
    assert len(text.encode()) < 5_000_000
    held = sum(f'id="computation/large_{number}"' in text for number in range(9))
    assert 1 <= held < 9
    assert re.search(rf"Computation graphs.*?{held}.*?9", text, re.DOTALL)
    assert set(Single(text).links) >= {"#computation/large_0"}


def test_a_folder_in_its_place_is_said(bare_site: Site, tmp_path: Path) -> None:
    (tmp_path / "report.html").mkdir()
    with pytest.raises(UsageError, match="expected a file that can be written"):
        single_file(bare_site, tmp_path / "report.html")
    assert [path.name for path in tmp_path.iterdir()] == ["report.html"]


def test_names_and_links_of_a_hostile_section() -> None:
    ref = PageRef("file", 'a"b<c>.cpp')
    section = fold_into_file(ref, '<p id="x">&#34; id=&#34;y&#34;</p><a href="#nowhere">n</a>')
    assert section.startswith('<section id="files/a&quot;b&lt;c&gt;.cpp" class="page-file">')
    assert 'id="files/a&quot;b&lt;c&gt;.cpp:x"' in section
    assert "<a>n</a>" in with_live_links(section)


def test_a_line_that_is_not_shown_leads_to_its_file() -> None:
    sections = fold_into_file(PageRef("file", "a b"), "") + '<a href="#files/a%20b:L9">n</a>'
    assert '<a href="#files/a%20b">' in with_live_links(sections)


@pytest.mark.heavy
@pytest.mark.timed
def test_a_large_workspace_stays_below_five_megabytes(large_site: Site) -> None:
    begun = time.process_time()
    text = single_page(large_site)
    took = turned_s(begun)
    size = len(text.encode())
    assert size < 5_000_000, f"{size:,} bytes"
    assert took < 60, f"{took:.1f} s"
    page = Single(text)
    assert page.rows["packages"] == 1000
    assert len([name for name in page.sections if name.startswith("packages/")]) == 1000
    assert "One file has room for the pages with most findings" in text

"""The exported folder: whole, linked, readable without a network, and never in place of something else."""

from __future__ import annotations

import csv
import io
import json
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

from roslens.dashboard.address import FolderLinks, PageRef, folder_path
from roslens.dashboard.export import MARKER, export_folder, pages_of
from roslens.dashboard.site import Site
from roslens.model.errors import UsageError


class Heard:
    """Notes what an export says of itself."""

    def __init__(self, stop_after: int = -1) -> None:
        self.total = 0
        self.done = 0
        self._stop_after = stop_after

    def step(self, title: str, total: int) -> None:
        self.total = total

    def advance(self, count: int = 1, item: str = "") -> None:
        self.done += count
        if self.done == self._stop_after:
            raise KeyboardInterrupt


class Page(HTMLParser):
    """Links, resources, ids and rows of tables of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.resources: list[str] = []
        self.ids: list[str] = []
        self.rows = 0
        self.inside_body = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        self.ids += [found["id"] or ""] if "id" in found else []
        self.inside_body = self.inside_body or tag == "tbody"
        self.rows += self.inside_body and tag == "tr"
        if tag == "a" and found.get("href"):
            self.links.append(found["href"] or "")
        for name in ("src", "href"):
            if tag in {"script", "link", "img"} and found.get(name):
                self.resources.append(found[name] or "")

    def handle_endtag(self, tag: str) -> None:
        self.inside_body = self.inside_body and tag != "tbody"


@pytest.fixture(scope="module")
def folder(site: Site, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("export") / "report"
    heard = Heard()
    export_folder(site, out, heard)
    assert heard.done == heard.total == len(list(pages_of(site)))
    return out


@pytest.fixture(scope="module")
def pages(folder: Path) -> dict[Path, Page]:
    return {path: Page(path.read_text(encoding="utf-8")) for path in sorted(folder.rglob("*.html"))}


def test_every_page_of_the_site_is_there(site: Site, folder: Path, pages: dict[Path, Page]) -> None:
    assert set(pages) == {folder / folder_path(ref, "html") for ref in pages_of(site)}
    assert folder / "index.html" in pages


def test_every_internal_link_resolves(folder: Path, pages: dict[Path, Page]) -> None:
    broken = []
    for path, page in pages.items():
        for link in (*page.links, *page.resources):
            parts = urlsplit(link)
            if parts.scheme:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            assert target.is_relative_to(folder)
            if not target.is_file() or (
                parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].ids
            ):
                broken.append((path.name, link))
    assert broken == []


def test_nothing_is_loaded_from_elsewhere(folder: Path, pages: dict[Path, Page]) -> None:
    assert [link for page in pages.values() for link in page.resources if "//" in link] == []
    assert 'type="module"' not in "".join(path.read_text(encoding="utf-8") for path in pages)
    script = (folder / "web" / "roslens.js").read_text(encoding="utf-8")
    assert "\nimport " not in script
    assert "\nexport " not in script


def test_tables_are_complete_without_scripts(site: Site, folder: Path, pages: dict[Path, Page]) -> None:
    assert pages[folder / "packages.html"].rows == len(site.packages)
    assert pages[folder / "rules.html"].rows == len(site.rules)
    assert pages[folder / "metrics.html"].rows == len(site.quantities)


def test_every_page_has_a_json_twin_that_says_which_page_it_is(site: Site, folder: Path) -> None:
    for ref in pages_of(site):
        twin = json.loads((folder / folder_path(ref, "json")).read_bytes())
        assert (twin["page"], twin["key"]) == (ref.page, ref.key)


def test_csv_twins_hold_every_row(site: Site, folder: Path) -> None:
    total = sum(count.count for _, count in site.counts())
    rows = list(csv.DictReader(io.StringIO((folder / "findings.csv").read_text(encoding="utf-8"))))
    assert len(rows) == total
    package = max(site.packages, key=lambda one: sum(count.count for count in one.rules))
    own = (folder / folder_path(PageRef("package", package.id), "findings.csv")).read_text(encoding="utf-8")
    assert len(list(csv.DictReader(io.StringIO(own)))) == sum(count.count for count in package.rules)


def test_text_from_source_is_escaped(pages: dict[Path, Page]) -> None:
    shown = "".join(path.read_text(encoding="utf-8") for path in pages)
    assert "<script>alert" not in shown
    assert "&lt;script&gt;alert" in shown


def test_two_exports_are_the_same(bare_site: Site, tmp_path: Path) -> None:
    first, second = (tmp_path / name for name in ("first", "second"))
    for out in (first, second):
        export_folder(bare_site, out, Heard())
    found = [
        {path.relative_to(out): path.read_bytes() for path in out.rglob("*") if path.is_file()}
        for out in (first, second)
    ]
    assert found[0] == found[1]


def test_an_old_report_is_replaced_and_what_others_put_there_is_kept(bare_site: Site, tmp_path: Path) -> None:
    out = tmp_path / "report"
    export_folder(bare_site, out, Heard())
    (out / "packages" / "gone.html").write_text("old", encoding="utf-8")
    (out / ".git").mkdir()
    export_folder(bare_site, out, Heard())
    assert not (out / "packages" / "gone.html").exists()
    assert (out / ".git").is_dir()
    assert [path.name for path in tmp_path.iterdir()] == ["report"]


def test_a_folder_with_other_files_is_refused_and_left_alone(bare_site: Site, tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("years of work", encoding="utf-8")
    with pytest.raises(UsageError, match="a folder with other files; expected a new or empty folder"):
        export_folder(bare_site, tmp_path, Heard())
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_a_file_is_refused(bare_site: Site, tmp_path: Path) -> None:
    (tmp_path / "report").write_text("text", encoding="utf-8")
    with pytest.raises(UsageError, match="is not a folder"):
        export_folder(bare_site, tmp_path / "report", Heard())
    with pytest.raises(UsageError, match="cannot write the report"):
        export_folder(bare_site, tmp_path / "report" / "below", Heard())


def test_an_interrupt_leaves_the_old_report(bare_site: Site, tmp_path: Path) -> None:
    out = tmp_path / "report"
    out.mkdir()
    (out / MARKER).write_text("Written by roslens 0\nindex.html\n", encoding="utf-8")
    (out / "index.html").write_text("old", encoding="utf-8")
    with pytest.raises(KeyboardInterrupt):
        export_folder(bare_site, out, Heard(stop_after=3))
    assert (out / "index.html").read_text(encoding="utf-8") == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["report"]


HOSTILE = (
    "../../etc/passwd",
    "/etc/passwd",
    "a/../../b",
    "<script>",
    'a"b',
    "a'b",
    "a b",
    "..",
    ".",
    "",
    "a\\b",
    "é" * 200,
    "a\nb",
)


@pytest.mark.parametrize("key", HOSTILE)
def test_hostile_names_stay_below_the_folder(key: str) -> None:
    path = folder_path(PageRef("file", key), "html")
    assert path.startswith("files/")
    assert not {"..", ".", ""} & set(path.split("/"))
    assert all(letter.isalnum() or letter in "._+@-/" for letter in path)
    assert path.isascii()
    link = FolderLinks(PageRef("overview")).to(PageRef("file", key))
    assert unquote(link) == path


@pytest.mark.parametrize(
    ("first", "second"),
    [("a b", "a_20_b"), ("a_5f_20_b", "a_20_b"), ("a<b", "a_3c_b"), ("..", "_2e_."), ("a.html/b", "a/b")],
)
def test_two_names_never_become_one(first: str, second: str) -> None:
    assert folder_path(PageRef("file", first), "html") != folder_path(PageRef("file", second), "html")


def test_a_folder_never_stands_where_a_page_must_stand() -> None:
    page = folder_path(PageRef("file", "a"), "html")
    assert not folder_path(PageRef("file", "a.html/b"), "html").startswith(page + "/")


@pytest.mark.parametrize(
    ("query", "page", "key"),
    [
        ((("package", "p"),), "package", "p"),
        ((("rule", "r"),), "rule", "r"),
        ((("rule", "r"), ("package", "p")), "package", "p"),
        ((("path", "f.cpp"),), "file", "f.cpp"),
        ((("severity", "error"),), "findings", ""),
    ],
)
def test_a_question_to_all_findings_goes_to_the_page_that_answers_it(
    query: tuple[tuple[str, str], ...], page: str, key: str
) -> None:
    link = FolderLinks(PageRef("overview")).to(PageRef("findings", query=query))
    assert urlsplit(link).path == folder_path(PageRef(page, key), "html")

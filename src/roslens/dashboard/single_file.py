"""The pages as one HTML file that needs nothing else: a section for each page, as many as the room allows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from markupsafe import Markup

from roslens.dashboard.address import FileLinks, PageRef, section_id
from roslens.dashboard.export import pages_of
from roslens.dashboard.pages.search import everything
from roslens.dashboard.render import WEB, Renderer
from roslens.dashboard.routes import PAGES
from roslens.dashboard.script_bundle import ENTRIES, bundle, inline
from roslens.dashboard.section import compact, fold_into_file, with_live_links
from roslens.dashboard.site import Site
from roslens.dashboard.view import Limits, Request
from roslens.model.errors import UsageError
from roslens.report.writing.whole_file import whole_file

LARGEST = 4_800_000
"""Bytes that the file may have: what a mail server takes, with room for its encoding left out."""

SOURCE_BUDGET = 1_500_000
GRAPH_BUDGET = 1_600_000
_PAST = ("history", "difference", "hotspots")
_MAIN = ("overview", "graph", "packages", "findings", "metrics", "rules", "failures", "help")
_FEW, _MANY = (
    Limits(findings=24, per_group=4, groups=12, entities=8, rows=25, lines=800, excerpts=False),
    Limits(findings=12, per_group=3, groups=8, entities=5, rows=15, lines=800, excerpts=False),
)
_MAIN_LIMITS = Limits(findings=120, per_group=6, groups=25, entities=20, rows=5000)
_GRAPH_LIMITS = Limits(rows=400)
_FEW_PACKAGES = 60
_TRIES = 12
_INDEXED_FILES = 2000


class _Book:
    """Renders sections and counts their bytes."""

    def __init__(self, site: Site) -> None:
        self.site = site
        self.renderer = Renderer(site, "file")
        self.links = FileLinks(frozenset(section_id(ref) for ref in pages_of(site) if ref.page != "search"))
        self.sections: dict[str, str] = {}
        self.size = 0

    def render(self, ref: PageRef, limits: Limits) -> str:
        view = PAGES[ref.page](self.site, Request(ref.key, limits=limits, medium="file"))
        return fold_into_file(ref, self.renderer.section(view, self.links)) if view else ""

    def add(self, ref: PageRef, section: str) -> None:
        name = section_id(ref)
        self.size += len(section.encode()) - len(self.sections.get(name, "").encode())
        self.sections[name] = section

    def fill(self, refs: Iterable[PageRef], limits: Limits, room: int) -> int:
        """Add pages in their order until a few do not fit into ``room`` bytes; return how many were added."""
        added = missed = 0
        until = self.size + room
        for ref in refs:
            section = self.render(ref, limits)
            if self.size + len(section.encode()) <= until:
                self.add(ref, section)
                added += 1
            else:
                missed += 1
                if missed > _TRIES:
                    break
        return added


def single_file(site: Site, out: Path) -> None:
    """Write the pages into one file that stays below five megabytes for a thousand packages.

    Main pages are whole; of the others those with most findings are there as far as the room goes, and the overview
    says how many of how many. The file takes the place of an older one when it is whole.

    Raises:
        UsageError: ``out`` cannot be written.
    """
    write_page(single_page(site), out, "--single-file")


def write_page(text: str, out: Path, option: str) -> None:
    """Write a file that takes the place of an older one when it is whole; ``option`` named it.

    Raises:
        UsageError: ``out`` cannot be written.
    """
    try:
        with whole_file(out) as stream:
            stream.write(text)
    except OSError as error:
        raise UsageError(
            f"cannot write {str(out)!r}: {error.strerror or error}",
            expected="a file that can be written",
            advice=f"Give another one with {option}",
        ) from error


def single_page(site: Site) -> str:
    """Return the text of the file."""
    book = _Book(site)
    shown = {"hotspots": bool(site.view.process), "history": site.past is not None, "difference": site.past is not None}
    for page in (*_MAIN, *(page for page in _PAST if shown[page])):
        book.add(PageRef(page), book.render(PageRef(page), _MAIN_LIMITS))
    graphs = _graphs(book)
    frame = _frame(book, "", ())
    book.size += len(frame.encode()) + 100 * min(_INDEXED_FILES, len(site.places))
    for package in site.packages:
        book.add(PageRef("package", package.id), _brief(book, package.id))
    contents = _fill_up(book)
    if graphs < len(site.book.systems):
        contents.append(("Computation graphs", graphs, len(site.book.systems)))
    book.sections["overview"] = book.sections["overview"].removesuffix("</section>\n") + (
        book.renderer.text("contents.html", contents=contents, cut=any(held < total for _, held, total in contents))
        + "</section>\n"
    )
    ordered = [book.sections[name] for ref in pages_of(site) if (name := section_id(ref)) in book.sections]
    sections = with_live_links("".join(ordered))
    return _frame(book, sections, _index(book))


def _graphs(book: _Book) -> int:
    """Add the computation graphs, the first whatever it takes; return how many."""
    refs = [PageRef("computation", slug) for slug in book.site.book.systems]
    start = book.size
    for ref in refs[:1]:
        book.add(ref, book.render(ref, _GRAPH_LIMITS))
    return len(refs[:1]) + book.fill(refs[1:], _GRAPH_LIMITS, max(0, GRAPH_BUDGET - (book.size - start)))


def _fill_up(book: _Book) -> list[tuple[str, int, int]]:
    """Add what the main pages lead to; return (what, how many are held, of how many)."""
    site = book.site
    limits = _FEW if len(site.packages) <= _FEW_PACKAGES else _MANY
    room = max(0, LARGEST - book.size)
    start = book.size
    ordered_rules = list(dict.fromkeys(total.rule for total in site.rule_totals()))
    rules = book.fill((PageRef("rule", rule) for rule in ordered_rules), _MANY, room // 6)
    metrics = book.fill((PageRef("metric", key) for key in _metrics(site)), _MANY, room // 6)
    joined = [ref for ref in site.book.refs() if ref.page != "computation"]
    interfaces = book.fill(joined, limits, room // 6)
    packages = book.fill((PageRef("package", name) for name in _packages(site)), limits, room * 2 // 5)
    left = max(0, room - (book.size - start))
    files = _worst_files(site)
    sources = book.fill((PageRef("file", path) for path in files), limits, min(left, SOURCE_BUDGET))
    return [
        ("Packages with findings listed", packages, len(site.packages)),
        ("Files with source", sources, len(site.places)),
        ("Rules that were broken", rules, len(ordered_rules)),
        ("Metrics with distribution", metrics, len(site.quantities)),
        *([("Nodes and topics", interfaces, len(joined))] if joined else ()),
    ]


def _packages(site: Site) -> list[str]:
    totals = {package.id: sum(count.count for count in package.rules) for package in site.packages}
    return sorted(totals, key=lambda name: (-totals[name], name))


def _metrics(site: Site) -> list[str]:
    """Return what the run's models bound first."""
    bound = {constraint.quantity for model in site.run_models for constraint in model.constraints}
    return sorted(site.quantities, key=lambda key: key not in bound)


def _worst_files(site: Site) -> Sequence[str]:
    counts = Counter(finding.path for finding in site.view.findings() if finding.path in site.places)
    return sorted(counts, key=lambda path: (-counts[path], path))


def _brief(book: _Book, package: str) -> str:
    summary = book.site.by_id[package]
    rules: Counter[str] = Counter()
    for count in summary.rules:
        rules[count.rule] += count.count
    text = book.renderer.text(
        "brief_package.html",
        summary=summary,
        rules=rules.most_common(6),
        total=rules.total(),
        rule_link=lambda rule: book.links.to(PageRef("rule", rule)),
    )
    return fold_into_file(PageRef("package", package), text)


def _index(book: _Book) -> list[tuple[str, str, str, str]]:
    return [
        (kind, name, more[:60], book.links.to(ref))
        for kind, name, more, ref in everything(book.site)
        if section_id(ref) in book.sections
    ][: len(book.site.packages) + len(book.site.rules) + len(book.site.quantities) + _INDEXED_FILES]


def _frame(book: _Book, sections: str, index: Sequence[tuple[str, str, str, str]]) -> str:
    page = book.renderer.text("single.html", link=book.links.to, sections=Markup("\0"), index=index, **inlined())
    return page.replace("\0", sections, 1)


def inlined() -> dict[str, object]:
    """Return what one file holds of ``web/``, ready to stand inside its elements: icon, style, theme, script."""

    def read(name: str) -> str:
        return (WEB / name).read_text(encoding="utf-8")

    return {
        "icon": read("icon.svg"),
        "style": Markup(compact(read("roslens.css"))),  # noqa: S704 - our own file
        "theme": Markup(inline(read("theme.js"))),  # noqa: S704 - our own file
        "script": Markup(inline(bundle(ENTRIES, read))),  # noqa: S704 - our own files
    }

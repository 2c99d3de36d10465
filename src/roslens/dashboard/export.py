"""The pages as a folder of files that opens from disk: HTML, with JSON and CSV twins beside it."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Protocol
from urllib.parse import quote

import roslens
from roslens.dashboard.address import FolderLinks, PageRef, folder_path
from roslens.dashboard.pages.search import everything
from roslens.dashboard.render import WEB, Renderer, embedded
from roslens.dashboard.routes import PAGES
from roslens.dashboard.script_bundle import ENTRIES, bundle
from roslens.dashboard.side_by_side import each
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import Table, to_csv
from roslens.dashboard.view import FOLDER, Limits, Request
from roslens.model.errors import UsageError
from roslens.report.writing.control_characters import shown_control_bytes, shown_controls
from roslens.report.writing.left_behind import OLD, PARTIAL, beside, sweep

MARKER = ".roslens-report"
"""Marks a folder that roslens wrote, and lists its content: the names directly below it, one a line."""

_TABLES_ONLY = Limits(findings=0, groups=0, lines=0, excerpts=False)
_AS_THEY_ARE = ("icon.svg", "roslens.css", "theme.js")


class Progress(Protocol):
    """Is called with how far the export is."""

    def step(self, title: str, total: int) -> None:
        """Begin a step of ``total`` items."""

    def advance(self, count: int = 1, item: str = "") -> None:
        """Report that ``count`` more items are done, the last of them ``item``."""


def export_folder(site: Site, out: Path, progress: Progress, jobs: int = 1) -> None:
    """Write every page, its twins and what they need below ``out``.

    The folder is written beside ``out`` and takes its place when it is whole, so an interrupt leaves the old report.
    What others put into an old report (a ``.git``, say) is kept.

    Args:
        site: what is shown. With more than one job its run must be in a file.
        out: the folder.
        progress: is called with each page.
        jobs: how many processes write pages; 0 is one per processor.

    Raises:
        UsageError: ``out`` holds something that roslens did not write, or cannot be written.
    """
    target = Path(os.path.abspath(out))  # noqa: PTH100 - resolve() would write through a link that the reader set
    sweep(target)
    _refuse_foreign(target, out)
    partial = beside(target, PARTIAL)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        partial.mkdir()
        try:
            _write_pages(site, partial, progress, jobs)
            _write_web(site, partial)
            names = sorted(entry.name for entry in partial.iterdir())
            _write(partial / MARKER, f"Written by roslens {roslens.__version__}\n" + "".join(f"{n}\n" for n in names))
            _replace(target, partial)
        finally:
            shutil.rmtree(partial, ignore_errors=True)
    except OSError as error:
        raise UsageError(
            f"cannot write the report to {str(out)!r}: {error.strerror or error}",
            expected="a folder that can be written",
            advice="Give another one with --output",
        ) from error


def pages_of(site: Site) -> Iterator[PageRef]:
    """Yield every page of the site, each once."""
    for page in ("overview", "graph", "packages", "findings", "metrics", "rules", "failures", "search", "help"):
        yield PageRef(page)
    yield from site.book.refs()
    if site.view.process:
        yield PageRef("hotspots")
    if site.past is not None:
        yield PageRef("history")
        yield PageRef("difference")
        for key in site.past.keys:
            yield PageRef("trend", key)
    for package in site.packages:
        yield PageRef("package", package.id)
    for key in site.quantities:
        yield PageRef("metric", key)
    for rule in site.rules:
        yield PageRef("rule", rule)
    for path in sorted(site.places):
        yield PageRef("file", path)


def _refuse_foreign(target: Path, out: Path) -> None:
    if target.is_dir() and ((target / MARKER).is_file() or not any(target.iterdir())):
        return
    if target.exists() or target.is_symlink():
        found = "a folder with other files" if target.is_dir() else "not a folder"
        raise UsageError(
            f"{str(out)!r} is {found}",
            expected="a new or empty folder, or one that roslens wrote",
            advice="Give another one with --output, or empty it first; nothing was changed",
        )


def _write_pages(site: Site, folder: Path, progress: Progress, jobs: int) -> None:
    renderer = Renderer(site, "folder")
    refs = list(pages_of(site))
    renderer.prepare(ref.page for ref in refs)
    run = site.run_facts()

    def write(ref: PageRef) -> None:
        view = PAGES[ref.page](site, Request(ref.key, limits=FOLDER, medium="folder"))
        if view is not None:
            _write(folder / folder_path(ref, "html"), renderer.page(view, FolderLinks(ref)))
            _write(folder / folder_path(ref, "json"), shown_control_bytes(view.to_json(run)))
            for name, text in _csv_twins(site, ref, view.whole):
                _write(folder / folder_path(ref, name), text)

    progress.step("Writing pages", len(refs))
    for ref in each(write, refs, jobs):
        progress.advance(1, ref.key or ref.page)


def _csv_twins(site: Site, ref: PageRef, tables: tuple[Table, ...]) -> Iterator[tuple[str, str]]:
    """Yield (suffix, text) of each table with rows; the only table of a page needs no name and is there without."""
    if not tables:
        view = PAGES[ref.page](site, Request(ref.key, limits=_TABLES_ONLY, medium="folder", complete=True))
        tables = view.tables if view else ()
    if len(tables) == 1:
        yield "csv", to_csv(tables[0])
        return
    yield from ((f"{table.name}.csv", to_csv(table)) for table in tables if table.rows)


def _write_web(site: Site, folder: Path) -> None:
    for name in _AS_THEY_ARE:
        _write(folder / "web" / name, (WEB / name).read_bytes())
    script = bundle(ENTRIES, lambda path: (WEB / path).read_text(encoding="utf-8"))
    _write(folder / "web" / "roslens.js", script)
    index = [
        (kind, name, more, quote(folder_path(ref, "html"), safe="/@+")) for kind, name, more, ref in everything(site)
    ]
    _write(folder / "web" / "search-index.js", f"window.roslensIndex = {embedded(index)};\n")


def _write(path: Path, content: str | bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(shown_controls(content).encode("utf-8") if isinstance(content, str) else content)


def _replace(target: Path, partial: Path) -> None:
    if not target.exists():
        partial.rename(target)
        return
    kept = _foreign_names(target)
    old = beside(target, OLD)
    target.rename(old)
    try:
        partial.rename(target)
    except OSError:
        old.rename(target)
        raise
    for name in kept:
        if not (target / name).exists():
            (old / name).rename(target / name)
    shutil.rmtree(old, ignore_errors=True)


def _foreign_names(target: Path) -> list[str]:
    """Return the names directly below an old report that roslens did not write."""
    marker = target / MARKER
    written = {MARKER, *(marker.read_text(encoding="utf-8").splitlines()[1:] if marker.is_file() else ())}
    return sorted(entry.name for entry in target.iterdir() if entry.name not in written)

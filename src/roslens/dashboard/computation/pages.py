"""The pages of configurations: all of them as views, or as one HTML file that needs nothing else."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from markupsafe import Markup

from roslens.dashboard.address import FileLinks, PageRef, section_id
from roslens.dashboard.computation.book import Book
from roslens.dashboard.computation.element_pages import build_node, build_topic
from roslens.dashboard.computation.graph_page import build as build_graph
from roslens.dashboard.computation.system import systems_of
from roslens.dashboard.pages.help import KEYS
from roslens.dashboard.render import environment
from roslens.dashboard.section import fold_into_file, with_live_links
from roslens.dashboard.single_file import inlined, write_page
from roslens.dashboard.view import FOLDER, Request, View
from roslens.model.configuration import Configuration
from roslens.model.finding import Finding

COMPUTATION_PAGES: dict[str, Callable[[Book, Request], View | None]] = {
    "computation": build_graph,
    "node": build_node,
    "topic": build_topic,
}
"""Every page about a configuration by name, built from the book that holds it."""


def computation_pages(
    configurations: Mapping[str, Configuration],
    findings: Mapping[str, Sequence[Finding]] | None = None,
    *,
    has_page: Callable[[str], bool] = lambda path: False,  # noqa: ARG005 - the shape of every lookup
    medium: str = "folder",
    unstarted: Sequence[Configuration] = (),
) -> Iterator[View]:
    """Yield every page: a graph for each configuration, then nodes, then topics, services and actions.

    Args:
        configurations: by the names under which they are shown.
        findings: about each, by the same names.
        has_page: whether the report has a page for a file, by its path below the workspace root.
        medium: served, folder or file.
        unstarted: what no known program starts.
    """
    book = Book(systems_of(configurations, findings), has_page, unstarted=unstarted)
    for ref in book.refs():
        view = COMPUTATION_PAGES[ref.page](book, Request(ref.key, limits=FOLDER, medium=medium))
        if view is not None:
            yield view


def computation_page(
    configurations: Mapping[str, Configuration],
    findings: Mapping[str, Sequence[Finding]] | None = None,
    *,
    title: str = "Computation graph",
    unstarted: Sequence[Configuration] = (),
) -> str:
    """Return the text of one HTML file with a section for each page.

    Args:
        configurations: by the names under which they are shown.
        findings: about each, by the same names.
        title: of the file.
        unstarted: what no known program starts.
    """
    views = list(computation_pages(configurations, findings, medium="file", unstarted=unstarted))
    links = FileLinks(frozenset(section_id(view.ref) for view in views))
    templates = environment("file", help_keys={area: KEYS[area] for area in ("Everywhere", "Graph")})
    sections = []
    for view in views:
        content = templates.get_template(f"pages/{view.ref.page}.html").render(
            view=view, content=view.ref.page, link=links.to, twin=links.twin, asset=links.asset, **view.shown
        )
        sections.append(fold_into_file(view.ref, content))
    graphs = [view.ref for view in views if view.ref.page == "computation"]
    page = templates.get_template("computation.html").render(
        title=title,
        link=links.to,
        first=graphs[0] if graphs else PageRef("computation"),
        tabs=[(ref, ref.key) for ref in graphs],
        index=[(_kind(view.ref), view.title, "", links.to(view.ref)) for view in views],
        sections=Markup("\0"),
        **inlined(),
    )
    return page.replace("\0", with_live_links("".join(sections)), 1)


def _kind(ref: PageRef) -> str:
    return ref.key.split("/")[1] if ref.page == "topic" else ref.page


def computation_file(
    configurations: Mapping[str, Configuration],
    out: Path,
    findings: Mapping[str, Sequence[Finding]] | None = None,
    *,
    title: str = "Computation graph",
    unstarted: Sequence[Configuration] = (),
) -> None:
    """Write the pages of configurations into one HTML file that loads nothing.

    Raises:
        UsageError: ``out`` cannot be written.
    """
    write_page(computation_page(configurations, findings, title=title, unstarted=unstarted), out, "--html")

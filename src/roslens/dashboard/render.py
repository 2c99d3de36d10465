"""From a view to HTML: templates, the same for every medium; only links and the frame differ."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from types import CodeType

import msgspec
from jinja2 import BytecodeCache, Environment, FileSystemLoader, StrictUndefined
from jinja2.bccache import Bucket
from markupsafe import Markup

import roslens
from roslens.dashboard.address import FileLinks, Links, PageRef
from roslens.dashboard.charts.figures import number, share
from roslens.dashboard.pages.help import KEYS
from roslens.dashboard.site import Site
from roslens.dashboard.sources.source_rows import excerpt_html, source_html
from roslens.dashboard.tables.breakable import breakable
from roslens.dashboard.tables.table import next_sort
from roslens.dashboard.tables.table_rows import rows_html, ticks
from roslens.dashboard.view import Query, View
from roslens.model.weight.consequence import Consequence
from roslens.model.words.plural import plural

TEMPLATES = Path(__file__).with_name("templates")
WEB = Path(__file__).with_name("web")

NAVIGATION = (
    ("overview", "Overview"),
    ("graph", "Graph"),
    ("computation", "Computation"),
    ("conformance", "Diff"),
    ("packages", "Packages"),
    ("findings", "Findings"),
    ("runs", "Runs"),
    ("history", "History"),
    ("hotspots", "Hotspots"),
    ("metrics", "Metrics"),
    ("rules", "Rules"),
    ("failures", "Not analysed"),
)
PARENTS = {
    "package": "packages",
    "file": "packages",
    "metric": "metrics",
    "trend": "history",
    "difference": "history",
    "rule": "rules",
    "node": "computation",
    "topic": "computation",
}
"""Under which word of the navigation a page is found."""


def shown_in_navigation(site: Site, name: str) -> bool:
    """Return whether a site has anything to show under a word of the navigation."""
    if name == "computation":
        return bool(site.book.systems)
    there = {
        "conformance": site.against, "runs": site.runs, "history": site.past, "hotspots": site.view.process,
    }  # fmt: skip
    return bool(there.get(name, True))


class _Compiled(BytecodeCache):
    """Templates that this process has compiled, whichever environment asked for them."""

    def __init__(self) -> None:
        self._codes: dict[str, tuple[str, CodeType]] = {}

    def load_bytecode(self, bucket: Bucket) -> None:
        """Give a bucket its code, where its source is the same."""
        checksum, code = self._codes.get(bucket.key, ("", None))
        if checksum == bucket.checksum:
            bucket.code = code

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Keep the code of a bucket."""
        if bucket.code is not None:
            self._codes[bucket.key] = (bucket.checksum, bucket.code)


_COMPILED = _Compiled()


class Renderer:
    """Renders the views of one site for one medium: served, folder or file."""

    def __init__(
        self, site: Site, medium: str, further: Sequence[tuple[str, str]] = (), waiting: Callable[[], int] = int
    ) -> None:
        """Load the templates.

        Args:
            site: what is shown.
            medium: served, folder or file.
            further: address and word of pages beside these.
            waiting: returns how many questions wait for an answer.
        """
        self._environment = environment(
            medium,
            site=site,
            navigation=NAVIGATION,
            in_navigation=shown_in_navigation,
            parents=PARENTS,
            help_keys=KEYS,
            live=next((href for href, word in further if word == "Live"), ""),
            further=further,
            waiting=waiting,
        )

    def navigation(self, site: Site, links: Links) -> tuple[tuple[str, str], ...]:
        """Return address and word of each page that the top of every page leads to."""
        return tuple(
            (links.to(reference(name, next(iter(site.book.systems)) if name == "computation" else "")), word)
            for name, word in NAVIGATION
            if shown_in_navigation(site, name)
        )

    def prepare(self, pages: Iterable[str]) -> None:
        """Compile what all pages share and the templates of ``pages``, so that copies of this process need not."""
        shared = [name for name in self._environment.list_templates() if not name.startswith("pages/")]
        for name in (*shared, *sorted({f"pages/{page}.html" for page in pages})):
            self._environment.get_template(name)

    def page(self, view: View, links: Links, *, may: bool = False) -> str:
        """Return a whole page; ``may`` says whether who looks may change what is reviewed."""
        return self._render("frame.html", view, links, may=may)

    def section(self, view: View, links: FileLinks) -> str:
        """Return the content of a page without its frame, for a single file."""
        return self._render(f"pages/{view.ref.page}.html", view, links)

    def text(self, template: str, **values: object) -> str:
        """Return any other template."""
        return self._environment.get_template(template).render(**values)

    def message(self, view: View, links: Links) -> str:
        """Return a page that says ``what`` and gives ``advice``, both among what the view shows."""
        return self._render("frame.html", view, links, content="message")

    def _render(self, template: str, view: View, links: Links, content: str = "", *, may: bool = False) -> str:
        return self._environment.get_template(template).render(
            view=view, content=content or view.ref.page, link=links.to, twin=links.twin, asset=links.asset, may=may,
            **view.shown,
        )  # fmt: skip


def environment(medium: str, **known: object) -> Environment:
    """Return what renders templates; ``known`` is what all of them can name besides what every page needs."""
    made = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=StrictUndefined,
        bytecode_cache=_COMPILED,
    )
    made.filters["ticks"] = ticks
    made.filters["breakable"] = breakable
    made.globals.update(
        medium=medium,
        number=number,
        share=share,
        plural=plural,
        consequences=[(one.value, one.value) for one in Consequence],
        next_sort=next_sort,
        reference=reference,
        requery=requery,
        embedded=embedded,
        rows_html=rows_html,
        source_html=source_html,
        excerpt_html=excerpt_html,
        version=roslens.__version__,
        **known,
    )
    return made


def reference(page: str, key: str = "", anchor: str = "", **query: str) -> PageRef:
    """Return a reference; the templates' way to name a page."""
    return PageRef(page, key, tuple((name, value) for name, value in query.items() if value), anchor)


def requery(ref: PageRef, **query: str) -> PageRef:
    """Return the same page asked with these parameters set anew; an empty value takes one away."""
    return PageRef(ref.page, ref.key, Query(ref.query).replaced(**query))


def embedded(value: object) -> Markup:
    """Return JSON that may stand inside a script element: nothing in it can end the element."""
    text = msgspec.json.encode(value).decode()
    return Markup(text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026"))  # noqa: S704 - escaped

"""How to read the pages and which keys there are; also the text of the help window."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.site import Site
from roslens.dashboard.view import Request, View

KEYS = {
    "Everywhere": (
        ("/", "search"),
        ("?", "this help"),
        ("Esc", "close, clear"),
        ("g, then o", "overview"),
        ("g, then g", "graph"),
        ("g, then c", "computation graph"),
        ("g, then p", "packages"),
        ("g, then f", "findings"),
        ("g, then m", "metrics"),
        ("g, then r", "rules"),
        ("d", "dark or light"),
    ),
    "Findings": (
        ("j, k", "next, previous finding"),
        ("Enter", "open or close it"),
        ("e", "open or close all"),
        ("o", "go to its line"),
    ),
    "Graph": (
        ("arrows", "to the nearest package in that direction"),
        ("Enter", "select"),
        ("o", "open its page"),
        ("f", "focus on it; again: one step wider"),
        ("+, -, 0", "zoom in, out, all"),
        ("Shift arrows", "move the picture"),
        ("s", "open or close the side panel"),
        ("t", "table instead of picture"),
        ("l", "computation graph: to the line that makes what is selected"),
        ("n", "Diff: to the next difference"),
        ("Esc", "clear selection, then focus"),
    ),
}


def build(site: Site, request: Request) -> View | None:  # noqa: ARG001 - the shape of every page
    """Return the page."""
    keys = {area: [{"keys": key, "does": does} for key, does in pairs] for area, pairs in KEYS.items()}
    return View(ref=PageRef("help"), title="Help", facts={"keys": keys})

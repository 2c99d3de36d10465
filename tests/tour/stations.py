"""Where the tour stops: which page, and what is clicked there before its picture is taken."""

from __future__ import annotations

from typing import NamedTuple


class Station(NamedTuple):
    """A picture: its name, the address that is opened, and the elements that are clicked in turn."""

    name: str
    path: str
    clicks: tuple[str, ...] = ()


STATIONS = (
    Station("overview", "/"),
    Station("live", "/live/"),
    Station("live_detail", "/live/", ("#alerts a.name",)),
    Station("topic", "/topics/rover/topic/scan"),
    Station("line", "/topics/rover/topic/scan", ('#code a[href*="range_filter.py"]',)),
    Station("node", "/nodes/rover/range_filter"),
    Station("package", "/packages/rover_sensors"),
    Station("findings", "/findings?group=function"),
    Station("computation", "/computation/rover"),
    Station("diff", "/conformance"),
    Station("graph", "/graph"),
    Station("search", "/search?q=scan"),
)

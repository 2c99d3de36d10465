"""Every kind of page of a server that is running: the first address that leads to each, found by following links."""

from __future__ import annotations

import json
import re
from collections import deque
from html import unescape
from typing import Any
from urllib.error import HTTPError
from urllib.parse import quote, unquote, urljoin, urlsplit
from urllib.request import urlopen

from tour.stations import Station

_LINK = re.compile(r'<a\b[^>]*? href="([^"#]+)"')
_TWIN = re.compile(r"\.(json|csv|svg|yaml)$|^/web/|^/live/(accepted|plots|sparks)")
ALWAYS = ("/findings?group=function", "/search?q={package}", "/help", "/live/references", "/computation")
"""Pages that are looked at besides: other views of the same page, and what needs something to be typed."""


def screens(base: str) -> tuple[Station, ...]:
    """Return a station for each kind of page that can be reached: what has a key is looked at with the first one."""
    waiting, found = deque(["/", *ALWAYS]), dict[str, str]()
    while waiting:
        path = waiting.popleft()
        if "{package}" in path:
            known = found.get("packages of a name")
            if known is None:
                if waiting:
                    waiting.append(path)
                continue
            path = path.format(package=quote(known.rpartition("/")[2]))
        kind = kind_of(path)
        if kind in found:
            continue
        try:
            with urlopen(base + path) as answer:
                text = answer.read().decode()
        except HTTPError as error:
            error.close()
            continue  # a page that this server does not have
        except OSError:
            continue
        found[kind] = path
        for href in _LINK.findall(text):
            address = urlsplit(urljoin(base + path, unescape(href)))
            if "*" in unquote(address.path):
                continue  # a name that was not resolved says little
            if address.netloc == urlsplit(base).netloc and not _TWIN.search(address.path):
                waiting.append(address.path)
    linked = (Station(re.sub(r"\W+", "_", kind), path) for kind, path in sorted(found.items()))
    return (*linked, *of_what_runs(base))


def of_what_runs(base: str) -> tuple[Station, ...]:
    """Return stations of the live page: something selected, a moment of the past, and two moments compared."""
    try:
        with urlopen(f"{base}/live/snapshot.json") as answer:
            snapshot = json.load(answer)
        with urlopen(f"{base}/live/timeline.json") as answer:
            timeline = json.loads(answer.read() or "{}")
    except HTTPError as error:
        error.close()
        return ()
    except OSError:
        return ()
    return stations_of(snapshot, timeline)


def stations_of(snapshot: dict[str, Any], timeline: dict[str, Any]) -> tuple[Station, ...]:
    """Return these stations: what is wrong is selected rather than anything else, a mark rather than the middle."""
    rows = [*snapshot.get("alerts", ()), *snapshot.get("rows", ())]
    found = []
    if rows:
        found.append(Station("live_by_select", f"/live/?select={quote(rows[0]['entity'])}"))
    if timeline:
        first, last = timeline["first"], timeline["last"]
        at = next((one["time"] for one in timeline["marks"] if first < one["time"] < last), (first + last) / 2)
        found += [
            Station("live_by_at", f"/live/?at={at}"),
            Station("live_compared", f"/live/compared?from={first}&to={at}"),
        ]
    return tuple(found)


def kind_of(path: str) -> str:
    """Return what kind of page an address leads to: ``packages of a name``, ``findings by group``."""
    address = urlsplit(path)
    first, _, key = address.path.strip("/").partition("/")
    kind = f"{first} of a name" if key and first != "live" else f"live {key}" if key else first or "overview"
    return f"{kind} by {address.query.partition('=')[0]}" if address.query else kind

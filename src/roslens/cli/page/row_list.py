"""The tree of a system as the rows of the live page; rows of parts that did not change are used again."""

from __future__ import annotations

import math
from functools import lru_cache
from hashlib import blake2b

import msgspec

from roslens.cli.page.half_lines import encodable, ends_of
from roslens.cli.page.watch_screen import nameless, value_text
from roslens.dashboard.live.snapshot import UNJUDGED, Row
from roslens.live.system.shown_rows import badge, is_shown
from roslens.live.system.tree import SystemView

COLUMNS = (
    ("rate", "Rate"),
    ("largest_gap", "Gap"),
    ("latency", "Latency"),
    ("loss", "Loss"),
    ("bandwidth", "Bandwidth"),
    ("cpu", "CPU"),
    ("memory", "Memory"),
)
RECORDED = "all nodes (a recording names no hosts)"
"""In place of a host, above what was recorded."""
_LONGEST_NAME = 200
_LONGEST_TEXT = 600
_SPARE = 1000
"""Rows of parts that went which are kept besides the present ones."""


class RowList:
    """Makes the rows of one tree after the other."""

    def __init__(self) -> None:
        self._kept: dict[str, tuple[SystemView, Row | None, tuple[Row, ...]]] = {}
        self._live = True

    def of(self, whole: SystemView, *, live: bool = True) -> tuple[Row, ...]:
        """Return the rows of everything below the whole, in order; where nothing is live, hosts are not missing."""
        if live is not self._live:
            self._live = live
            self._kept.clear()
        rows: list[Row] = []
        for part in whole.children:
            rows += self._below(part, 0, "")
        if len(self._kept) > 2 * len(rows) + _SPARE:
            self._kept.clear()
        return tuple(rows)

    def _below(self, part: SystemView, depth: int, above: str) -> tuple[Row, ...]:
        key = row_key(above, part.id)
        kept = self._kept.get(key)
        if kept is not None and kept[0] is part:
            return kept[2]
        found: list[Row] = []
        row = None
        if is_shown(part):
            row = _row(part, depth, key)
            if part.kind == "host" and not part.name and not self._live:
                row = msgspec.structs.replace(row, name=RECORDED)
            if kept is not None and kept[1] == row:
                row = kept[1]
            found.append(row)
            for one in part.children:
                found += self._below(one, depth + 1, key)
        rows = tuple(found)
        self._kept[key] = part, row, rows
        return rows


def _row(part: SystemView, depth: int, key: str) -> Row:
    values = {name: value for name, value in part.values.items() if math.isfinite(value)}
    shown = {name: _shown(name, float(f"{values[name]:.3g}")) for name, _ in COLUMNS if name in values}
    return Row(
        key,
        encodable(part.id),
        _name(part),
        part.kind,
        depth,
        part.state.value if part.state else UNJUDGED,
        part.counts,
        values,
        shown,
        part.observer,
        part.worst.value if part.worst else UNJUDGED,
        badge(part),
    )


@lru_cache(maxsize=65536)
def row_key(above: str, entity: str) -> str:
    """Return by what a row is known: the same entity stands below several others."""
    return blake2b(f"{above}\0{entity}".encode("utf-8", "replace"), digest_size=6).hexdigest()


@lru_cache(maxsize=65536)
def _shown(key: str, value: float) -> str:
    return value_text(key, value)


def _name(part: SystemView) -> str:
    if not part.name:
        return nameless(part)
    if part.kind == "connection":
        _, _, subscriber = ends_of(part.id)
        return f"→ {shown_name(subscriber) or 'anybody'}"
    return shown_name(part.name)


def shown_name(name: str) -> str:
    """Return a name from outside as text that can be encoded, and short enough to show."""
    return _cut(name, _LONGEST_NAME)


def shown_text(text: str) -> str:
    """Return a text from outside as text that can be encoded, and short enough to show."""
    return _cut(text, _LONGEST_TEXT)


def _cut(text: str, longest: int) -> str:
    if len(text) > longest:
        text = f"{text[: longest * 2 // 3]}…{text[-(longest // 3) :]}"
    return encodable(text)

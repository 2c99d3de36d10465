"""The tree of a system as the rows of the live page; rows of parts that did not change are used again."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache
from hashlib import blake2b
from operator import attrgetter
from typing import TypeAlias

from roslens.cli.page.half_lines import encodable, ends_of
from roslens.cli.page.watch_screen import nameless, value_text
from roslens.dashboard.live.snapshot import UNJUDGED, Row
from roslens.dashboard.live.stirred import stirred
from roslens.live.system.shown_rows import badge, is_shown
from roslens.live.system.tree import SystemView

COLUMNS = (
    ("rate", "Rate"),
    ("rate_received", "Received"),
    ("largest_gap", "Gap"),
    ("latency", "Latency"),
    ("loss", "Loss"),
    ("bandwidth", "Bandwidth"),
    ("cpu", "CPU"),
    ("memory", "Memory"),
)
_COLUMNS = tuple(key for key, _ in COLUMNS)
RECORDED = "all nodes (a recording names no hosts)"
"""In place of a host, above what was recorded."""
_LONGEST_NAME = 200
_LONGEST_TEXT = 600
MOST_GONE_ROWS = 300
"""So many rows of parts that went are kept at most. To give up all rows together would cost twice their memory once."""
_SHOWN = attrgetter("shown")
_Kept: TypeAlias = "tuple[SystemView, Row | None, tuple[Row, ...]]"
"""A part, its row where it is shown, and that with all below it."""


class RowList:
    """Makes the rows of one tree after the other.

    Attributes:
        order: another object once rows came, went or moved.
        columns: keys of the values that any row shows.
        unjudged: how many entities with a name have rows that nothing judges.
    """

    def __init__(self) -> None:
        self._kept: dict[str, _Kept] = {}
        self._there = 0
        self._recorded = False
        self._rows: tuple[Row, ...] = ()
        self.order = object()
        self.columns: frozenset[str] = frozenset()
        self.unjudged = 0

    @property
    def remembered(self) -> int:
        """Of how many parts rows are kept, those that went included."""
        return len(self._kept)

    def of(self, whole: SystemView, *, recorded: bool = False) -> tuple[Row, ...]:
        """Return the rows of everything below the whole, in order; of a recording no host is missing."""
        before, self._rows = self._rows, self._made(whole, recorded=recorded)
        rows = self._rows
        if len(before) != len(rows):
            moved = anew = True
        else:
            pairs = [(before[place], rows[place]) for place in stirred(before, rows)]
            moved = any(was.key != row.key for was, row in pairs)
            anew = moved or any(was.state != row.state or was.shown.keys() != row.shown.keys() for was, row in pairs)
        if moved:
            self.order = object()
        if anew:
            self.columns = frozenset[str]().union(*map(_SHOWN, rows))
            self.unjudged = len({row.entity for row in rows if row.state == UNJUDGED and not row.entity.endswith(":")})
        return rows

    def _made(self, whole: SystemView, *, recorded: bool) -> tuple[Row, ...]:
        if recorded is not self._recorded:
            self._recorded = recorded
            self._kept.clear()
        rows: list[Row] = []
        for part in whole.children:
            rows += self._below(part, 0, "")
        if len(self._kept) > self._there + MOST_GONE_ROWS:
            there = {key for part in whole.children for key in _keys(part, "")}
            for key in self._kept.keys() - there:
                del self._kept[key]
            self._there = len(there)
        return tuple(rows)

    def _below(self, part: SystemView, depth: int, above: str) -> tuple[Row, ...]:
        key = row_key(above, part.id)
        kept = self._kept.get(key)
        if kept is not None and kept[0] is part:
            return kept[2]
        found: list[Row] = []
        row = None
        if is_shown(part):
            row = self._row(part, depth, key, kept)
            found.append(row)
            for one in part.children:
                there = self._kept.get(row_key(key, one.id))
                found += there[2] if there is not None and there[0] is one else self._below(one, depth + 1, key)
        rows = tuple(found)
        self._kept[key] = part, row, rows
        return rows

    def _row(self, part: SystemView, depth: int, key: str, kept: _Kept | None) -> Row:
        """Return the row of a part, the same as before where it says the same."""
        before, row = kept[:2] if kept is not None else (part, None)
        if row is None:
            return _row(part, depth, key, self._name(part))
        if _alike(part, before):
            return row
        made = _row(part, depth, key, self._name_again(part, before, row))
        return row if made == row else made

    def _name(self, part: SystemView) -> str:
        return RECORDED if part.kind == "host" and not part.name and self._recorded else _name(part)

    def _name_again(self, part: SystemView, before: SystemView, row: Row) -> str:
        """Return the name of a part that had one; what has none is called by what is below it."""
        return row.name if part.name and part.name == before.name else self._name(part)


def _keys(part: SystemView, above: str) -> Iterator[str]:
    """Yield the key of a part and of what is shown below it."""
    key = row_key(above, part.id)
    yield key
    if is_shown(part):
        for one in part.children:
            yield from _keys(one, key)


def _alike(part: SystemView, before: SystemView) -> bool:
    """Whether a part with a name is what it was, whatever is below it: what of it stays is the same object."""
    return (
        part.values is before.values
        and part.counts is before.counts
        and part.below is before.below
        and part.state is before.state
        and part.worst is before.worst
        and part.observer == before.observer
        and part.name == before.name != ""
    )


def _row(part: SystemView, depth: int, key: str, name: str) -> Row:
    values = part.values
    if not all(map(math.isfinite, values.values())):
        values = {key: value for key, value in values.items() if math.isfinite(value)}
    shown = {column: _shown(column, f"{values[column]:.3g}") for column in _COLUMNS if column in values}
    return Row(
        key,
        encodable(part.id),
        name,
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
def _shown(key: str, digits: str) -> str:
    return value_text(key, float(digits))


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

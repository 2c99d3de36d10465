"""What the live page asks of the past; who watches answers from the history."""

from __future__ import annotations

from typing import Protocol

import msgspec

from roslens.dashboard.live.snapshot import UNJUDGED


class Series(msgspec.Struct, frozen=True, omit_defaults=True):
    """One signal over a stretch of time, for a plot.

    Attributes:
        key: of the signal.
        title: of it.
        unit: of its values.
        times: seconds on the monitor's clock, ascending.
        values: means; None where nothing was observed.
        least: of each piece.
        greatest: of each piece.
        low: least value that is fine; None where none is expected.
        high: greatest value that is fine.
        expected: both as the reference has them.
    """

    key: str
    title: str
    unit: str
    times: tuple[float, ...]
    values: tuple[float | None, ...]
    least: tuple[float | None, ...]
    greatest: tuple[float | None, ...]
    low: float | None = None
    high: float | None = None
    expected: str = ""


class Plots(msgspec.Struct, frozen=True):
    """Signals of one entity from ``since`` to ``until``."""

    entity: str
    since: float
    until: float
    series: tuple[Series, ...]


class Mark(msgspec.Struct, frozen=True, omit_defaults=True):
    """Something that happened, on the line of time: ``count`` of a ``kind``, the first of them at ``time``."""

    time: float
    when: str
    kind: str
    entity: str
    name: str
    detail: str = ""
    count: int = 1


class Timeline(msgspec.Struct, frozen=True):
    """From when to when there is something to look at, and what happened in a part of that."""

    first: float
    last: float
    since: float
    until: float
    marks: tuple[Mark, ...]


class Changed(msgspec.Struct, frozen=True, omit_defaults=True):
    """A row that is not the same at two moments; texts are empty where it was not there.

    Attributes:
        entity: text form of its id.
        name: to show.
        kind: of it.
        before: state at the first moment.
        after: state at the second.
        values: title of a signal, its value before and after, as people read them.
    """

    entity: str
    name: str
    kind: str
    before: str = UNJUDGED
    after: str = UNJUDGED
    values: tuple[tuple[str, str, str], ...] = ()

    @property
    def quiet(self) -> bool:
        """Whether no constraint judged it at either moment, and it was there at both."""
        return self.before == self.after == UNJUDGED


class Compared(msgspec.Struct, frozen=True):
    """Two moments: what changed between them, the gravest first, and how many rows are the same."""

    since: float
    until: float
    when: tuple[str, str]
    changed: tuple[Changed, ...]
    same: int
    left_out: int = 0


class Past(Protocol):
    """The past of what a page shows. Every method may be called from any thread, and raises StoreError."""

    def snapshot(self, at: float) -> bytes:
        """Return how it was, as a snapshot; empty where nothing is kept of that time."""

    def detail(self, entity: str, at: float) -> bytes:
        """Return what was known of an entity; empty where it was not there."""

    def plots(self, entity: str, since: float, until: float, most: int) -> Plots:
        """Return all signals of an entity."""

    def sparks(self, entities: tuple[str, ...], until: float) -> dict[str, tuple[float | None, ...]]:
        """Return by entity how its foremost signal went in the last minutes, as shares of its range."""

    def timeline(self, since: float, until: float) -> Timeline | None:
        """Return what happened; None where nothing is kept."""

    def compared(self, since: float, until: float) -> Compared | None:
        """Return what is not the same at two moments; None where one of them is not kept."""

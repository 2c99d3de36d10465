"""Tallies by columns: as they go over a line, and as they are read without making a record of each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import repeat
from typing import Any, overload

import msgspec

from roslens.model.traffic.tally import Moments, Observer, Tally

_BETWEEN = "\n"
_NAMES = 3
Row = tuple[float, float, int, int, float, float, Moments, Moments, Moments, int, Observer, str, Moments, float]
"""The fields of a tally besides its names, in their order."""


class Columns(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """What goes over a line: for each field of a tally a list of its values, or of the only one where all are the same.

    Attributes:
        names: topic, publisher and subscriber of each tally in a text, so that one look finds a connection.
    """

    names: list[str]
    start: list[float]
    end: list[float]
    count: list[int]
    bytes: list[int]
    first: list[float]
    last: list[float]
    period: list[Moments]
    latency: list[Moments]
    age: list[Moments]
    lost: list[int]
    observer: list[Observer]
    host: list[str]
    processing: list[Moments]
    longest_at: list[float]


class TallyColumns(Sequence[Tally]):
    """Tallies that are created on demand.

    Attributes:
        names: of each, as :func:`names_of` takes apart.
    """

    __slots__ = ("_values", "names")
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, columns: Columns) -> None:
        """Read what came over a line.

        Raises:
            ValueError: a column has values for another number of tallies.
        """
        self.names = columns.names
        self._values: list[list[Any]] = list(msgspec.structs.astuple(columns)[1:])
        many = len(self.names)
        for field, values in zip(_FIELDS, self._values, strict=True):
            if len(values) != many and (len(values) != 1 or not many):
                raise ValueError(f"{len(values)} values of {field} for {many} tallies")

    def rows(self) -> Iterator[Row]:
        """Return the fields of each besides its names."""
        many = len(self.names)
        columns = (values if len(values) == many else repeat(values[0], many) for values in self._values)
        return zip(*columns, strict=False)

    def __len__(self) -> int:
        return len(self.names)

    def __iter__(self) -> Iterator[Tally]:
        return map(tally_of, self.names, self.rows())

    @overload
    def __getitem__(self, index: int) -> Tally: ...
    @overload
    def __getitem__(self, index: slice) -> list[Tally]: ...
    def __getitem__(self, index: int | slice) -> Tally | list[Tally]:
        return list(self)[index]

    def __eq__(self, other: object) -> bool:
        return list(self) == list(other) if isinstance(other, Sequence) else NotImplemented

    def __repr__(self) -> str:
        return repr(list(self))


def columns_of(tallies: Iterable[Tally]) -> Columns:
    """Return tallies by columns; none of their names may hold a line break."""
    columns = list(map(list, zip(*map(msgspec.structs.astuple, tallies), strict=True)))
    if not columns:
        return Columns([], *([] for _ in _FIELDS))
    names = list(map(_BETWEEN.join, zip(*columns[:_NAMES], strict=True)))
    return Columns(names, *map(_column, columns[_NAMES:]))


def fits(tally: Tally) -> bool:
    """Return whether a tally can be reported by columns: a line break is in no name of ROS."""
    return _BETWEEN not in tally.topic and _BETWEEN not in tally.publisher and _BETWEEN not in tally.subscriber


def names_of(text: str) -> tuple[str, str, str]:
    """Return topic, publisher and subscriber; what is missing is empty."""
    topic, _, ends = text.partition(_BETWEEN)
    publisher, _, subscriber = ends.partition(_BETWEEN)
    return topic, publisher, subscriber


def tally_of(names: str, row: Row) -> Tally:
    """Return a tally with these names and the fields of a row."""
    topic, publisher, subscriber = names_of(names)
    return Tally(topic, publisher, subscriber, *row)


def row_of(tally: Tally) -> Row:
    """Return the fields of a tally besides its names."""
    return (
        tally.start, tally.end, tally.count, tally.bytes, tally.first, tally.last, tally.period, tally.latency,
        tally.age, tally.lost, tally.observer, tally.host, tally.processing, tally.longest_at,
    )  # fmt: skip


_FIELDS = Columns.__struct_fields__[1:]


def _column(values: list[Any]) -> list[Any]:
    first = values[:1]
    return first if values == first * len(values) else values

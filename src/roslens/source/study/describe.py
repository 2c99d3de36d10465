"""Key figures of each quantity, over all and by group, computed by DuckDB."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.model.study import GROUPINGS, Column, Corpus, Figures
from roslens.source.study.measurements import TABLE

if TYPE_CHECKING:
    from duckdb import DuckDBPyConnection

_FIGURES = (
    "count(*), median(value), avg(value), stddev_samp(value), min(value), "
    "quantile_cont(value, 0.25), quantile_cont(value, 0.75), max(value)"
)


def describe(connection: DuckDBPyConnection, corpus: Corpus, by: str = "") -> tuple[Figures, ...]:
    """Return the figures of every column that has values, in the order of columns and then of groups.

    Args:
        connection: as :func:`roslens.source.study.measurements.measurements` yields it.
        corpus: that is in it.
        by: one of ``GROUPINGS``, or nothing for one group ``""`` of all; what is in no group is left out.
    """
    if by not in ("", *GROUPINGS):
        raise ValueError(f"{by!r} is none of {', '.join(GROUPINGS)}")
    group, where = (by, f"WHERE {by} <> ''") if by else ("''", "")
    query = f"SELECT quantity, {group}, {_FIGURES} FROM {TABLE} {where} GROUP BY ALL"  # noqa: S608 - names of this package
    found = {(row[0], row[1]): row[2:] for row in connection.execute(query).fetchall()}
    groups = sorted({group for _, group in found})
    return tuple(
        _figures(connection, column, group, by, found[column.key, group])
        for column in corpus.columns
        for group in groups
        if (column.key, group) in found
    )


def _figures(connection: DuckDBPyConnection, column: Column, group: str, by: str, row: tuple[float, ...]) -> Figures:
    n, median, mean, deviation, least, lower, upper, most = row
    beyond = _beyond(connection, column, group, by)
    return Figures(column.key, group, int(n), median, mean, deviation, least, lower, upper, most, beyond)


def _beyond(connection: DuckDBPyConnection, column: Column, group: str, by: str) -> int | None:
    if column.minimum is None and column.maximum is None:
        return None
    outside = "(value < coalesce(?, '-inf'::DOUBLE) OR value > coalesce(?, 'inf'::DOUBLE))"
    among = f"AND {by} = ?" if by else ""
    given = [column.key, column.minimum, column.maximum, *([group] if by else ())]
    query = f"SELECT count(*) FROM {TABLE} WHERE quantity = ? AND {outside} {among}"  # noqa: S608 - names of this package
    found = connection.execute(query, given).fetchone()
    return int(found[0]) if found else None

"""The measurements of a corpus as one table of DuckDB: a row for each value, with the groups of what has it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roslens.model.errors import UsageError
from roslens.model.study import GROUPINGS, Corpus

if TYPE_CHECKING:
    from duckdb import DuckDBPyConnection

TABLE = "measurement"
"""Its columns: kind, name, repository, role, distribution, language, quantity, value."""


def missing(error: ImportError) -> UsageError:
    """Return the message for a library of the extra that is not installed."""
    return UsageError(
        f"{error.name or 'a library'} is not installed, and studies are computed with it",
        expected="the extra for studies",
        advice="Install it with `pip install 'roslens[study]'`",
    )


@contextmanager
def measurements(corpus: Corpus) -> Iterator[DuckDBPyConnection]:
    """Yield a connection in which :data:`TABLE` can be asked.

    Raises:
        UsageError: DuckDB is not installed.
    """
    try:
        duckdb = import_module("duckdb")
    except ImportError as error:
        raise missing(error) from None
    rows = list(_rows(corpus))
    texts = list(zip(*(row[0] for row in rows), strict=True)) or [()] * (2 + len(GROUPINGS) + 1)
    names = ("kind", "name", *GROUPINGS, "quantity")
    columns: dict[str, object] = {name: np.array(text, dtype=object) for name, text in zip(names, texts, strict=True)}
    columns["value"] = np.array([row[1] for row in rows], dtype=float)
    with duckdb.connect() as connection:
        types = ", ".join([*(f"{name} VARCHAR" for name in names), "value DOUBLE"])
        connection.execute(f"CREATE TABLE {TABLE} ({types})")
        if rows:
            connection.register("given", columns)
            connection.execute(f"INSERT INTO {TABLE} SELECT {', '.join((*names, 'value'))} FROM given")  # noqa: S608 - names of this module
        yield connection


def write_measurements(corpus: Corpus, path: Path) -> None:
    """Write every measurement of a corpus as Parquet; what is there under this name is replaced.

    Raises:
        UsageError: DuckDB is not installed, or the file cannot be written.
    """
    part = path.with_name(f".{path.name}.part")
    try:
        with measurements(corpus) as connection:
            order = f"SELECT * FROM {TABLE} ORDER BY kind, name, quantity"  # noqa: S608 - a name of this module
            quoted = str(part).replace("'", "''")
            connection.execute(f"COPY ({order}) TO '{quoted}' (FORMAT parquet)")
        part.replace(path)
    except (OSError, RuntimeError) as error:
        raise UsageError(f"cannot write {str(path)!r}: {error}", expected="a file that can be written") from error
    finally:
        part.unlink(missing_ok=True)


def _rows(corpus: Corpus) -> Iterator[tuple[tuple[str, ...], float]]:
    for column in corpus.columns:
        for one in corpus.subjects(column):
            groups = (getattr(one, grouping) for grouping in GROUPINGS)
            yield (column.of, one.name, *groups, column.key), one.values[column.key]

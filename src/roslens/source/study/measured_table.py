"""A table of one's own as a corpus: a row for each package, its groups, and a column for each quantity."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.judge.quality.quality_model import QualityModel
from roslens.model.errors import UsageError
from roslens.model.quantity import Quantity
from roslens.model.source import Location
from roslens.model.study import GROUPINGS, Column, Corpus, Subject
from roslens.source.study.columns import column_of, size_among
from roslens.source.study.csv_rows import CsvRows

KIND = "table"
_NAME = "package"


def is_measured_table(head: Sequence[str]) -> bool:
    """Return whether a header begins with what every such table has."""
    return _NAME in head


def corpus_of_table(table: CsvRows, known: Sequence[Quantity], models: Sequence[QualityModel] = ()) -> Corpus:
    """Return the corpus of a table; empty cells are values that were not measured.

    Args:
        table: its columns ``package``, and as far as there ``role``, ``distribution``, ``repository`` and ``language``,
            say what a row is; every other column is a quantity.
        known: quantities whose titles and units are taken where a column has their key.
        models: whose bounds are thresholds.

    Raises:
        UsageError: a cell is no number, a row has no name, or there is no quantity.
    """
    keys = [name for name in table.head if name not in (_NAME, *GROUPINGS)]
    if not keys:
        raise UsageError(
            "no column with a quantity",
            where=table.path,
            expected=f"besides {_NAME}, {', '.join(GROUPINGS)} at least one column of numbers",
        )
    by_key = {one.key: one for one in known}
    packages: list[Subject] = []
    for line, row in table.dictionaries():
        if not row[_NAME].strip():
            raise UsageError("a row without a name", where=Location(table.path, line), expected=f'text in "{_NAME}"')
        values = {key: table.number(line, key, row[key]) for key in keys if row[key].strip()}
        packages.append(Subject(row[_NAME], **{name: row.get(name, "") for name in GROUPINGS}, values=values))
    columns = tuple(column_of(by_key[key], models) if key in by_key else Column(key, key) for key in keys)
    return Corpus(KIND, (table.path,), columns, tuple(packages), size_key=size_among(keys))

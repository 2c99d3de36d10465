"""A table as a value: shown as HTML, sorted by its address, written as CSV and JSON, all from the same cells."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.charts.figures import number

Value = str | float | int | None


class Column(msgspec.Struct, frozen=True):
    """A column.

    ``kind`` is text, prose (whole sentences), name, code, number, day or mark (severity or rating).
    ``bar`` draws the share of the most.
    ``optional`` columns are the first to go on a narrow screen; ``sparse`` ones are not shown where no row fills them.
    """

    key: str
    title: str
    kind: str = "text"
    unit: str = ""
    hint: str = ""
    decimals: int = 0
    bar: bool = False
    optional: bool = False
    sparse: bool = False
    ref: PageRef | None = None


class Cell(msgspec.Struct, frozen=True):
    """A value; ``text`` where it is not shown as such; ``refs`` are shown instead, as links with their texts.

    ``rating`` (ok, low, high) says how a number stands to its bounds; ``spark`` are the heights of small bars.
    """

    value: Value = None
    text: str = ""
    ref: PageRef | None = None
    refs: tuple[tuple[str, PageRef | None], ...] = ()
    hint: str = ""
    rating: str = ""
    spark: tuple[int, ...] = ()


class Table(msgspec.Struct, frozen=True):
    """Rows of cells. ``total`` is how many rows there are in all; more than ``len(rows)`` where it was cut.

    ``sort`` is the key of the column that orders the rows, with ``-`` for descending; empty for the order given.
    ``all`` is the page that has all of them, where this one shows the first.
    """

    name: str
    title: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Cell, ...], ...]
    total: int = 0
    sort: str = ""
    empty: str = "Nothing to show."
    identities: tuple[str, ...] = ()
    all: PageRef | None = None

    def __post_init__(self) -> None:
        """Refuse rows with another number of cells than there are columns: they would stand under wrong heads.

        Raises:
            ValueError: there is such a row.
        """
        wrong = next((row for row in self.rows if len(row) != len(self.columns)), None)
        if wrong is not None:
            raise ValueError(f"a row of the table {self.name!r} has {len(wrong)} cells for {len(self.columns)} columns")

    @property
    def stacked(self) -> bool:
        """Whether a narrow screen has the cells of a row below each other: whole sentences, or more than one place."""
        kinds = [column.kind for column in self.columns]
        return "prose" in kinds or kinds.count("code") > 1

    @property
    def cut(self) -> bool:
        """Whether rows are left out."""
        return self.total > len(self.rows)

    def on_page(self) -> Table:
        """Return the table without the sparse columns that no row fills."""
        kept = [
            place
            for place, column in enumerate(self.columns)
            if not column.sparse or any(row[place].value not in (None, "") for row in self.rows)
        ]
        if len(kept) == len(self.columns):
            return self
        columns = tuple(self.columns[place] for place in kept)
        return msgspec.structs.replace(
            self, columns=columns, rows=tuple(tuple(row[place] for place in kept) for row in self.rows)
        )

    def digits(self) -> list[int]:
        """Return for each column how many digits behind the point its numbers need: none where all are whole."""
        found = []
        for place, column in enumerate(self.columns):
            numbers = (value for row in self.rows if isinstance(value := row[place].value, int | float))
            found.append(0 if all(value == int(value) for value in numbers) else column.decimals)
        return found

    def most(self, place: int) -> float:
        """Return the largest number in a column; 0 where there is none."""
        return max((value for row in self.rows if isinstance(value := row[place].value, int | float)), default=0)


def shown(column: Column, cell: Cell, digits: int | None = None) -> str:
    """Return the text of a cell for a reader, with ``digits`` behind the point instead of the column's."""
    if cell.text:
        return cell.text
    if cell.value is None:
        return number(None) if column.kind == "number" else ""
    if isinstance(cell.value, int | float):
        return number(cell.value, column.decimals if digits is None else digits)
    return cell.value


def sort_rows(table: Table, wanted: str, limit: int | None = None) -> Table:
    """Return the table ordered by ``wanted`` (``key`` or ``-key``), cut to ``limit`` rows.

    Cells without a value come last either way. An unknown key leaves the table's own order.
    """
    keys = [column.key for column in table.columns]
    key = wanted.lstrip("-")
    if key not in keys:
        wanted, key = table.sort, table.sort.lstrip("-")
    order = list(range(len(table.rows)))
    if key in keys:
        place = keys.index(key)
        cells = [row[place].value for row in table.rows]
        valued = [index for index in order if cells[index] is not None]
        without = [index for index in order if cells[index] is None]
        valued.sort(key=lambda index: _sort_key(cells[index]), reverse=wanted.startswith("-"))
        order = valued + without
    kept = order[:limit]
    return msgspec.structs.replace(
        table,
        rows=tuple(table.rows[index] for index in kept),
        identities=tuple(table.identities[index] for index in kept) if table.identities else (),
        total=table.total or len(table.rows),
        sort=wanted if key in keys else "",
    )


def _sort_key(value: Value) -> tuple[int, float, str]:
    if isinstance(value, str):
        return (1, 0.0, value.casefold())
    return (0, float(value or 0), "")


def next_sort(table: Table, column: Column) -> str:
    """Return the sort that a click on the column's head asks for: numbers from the most first."""
    falling = "-" + column.key
    if table.sort == column.key:
        return falling
    if table.sort == falling:
        return column.key
    return falling if column.kind == "number" else column.key


def to_csv(table: Table) -> str:
    """Return the table as CSV (RFC 4180) with the columns' keys in the first line.

    A text that a spreadsheet would run as a formula gets an apostrophe in front.
    """
    out = io.StringIO(newline="")
    writer = csv.writer(out)
    writer.writerow(column.key for column in table.columns)
    for row in table.rows:
        writer.writerow(_csv_cell(cell) for cell in row)
    return out.getvalue()


def _csv_cell(cell: Cell) -> Value:
    value = cell.value
    if value is None:
        return ""
    if isinstance(value, str):
        return "'" + value if value.startswith(("=", "+", "-", "@", "\t", "\r")) else value
    return int(value) if value == int(value) else value


def to_rows(table: Table) -> list[dict[str, Value]]:
    """Return the rows as JSON objects with the columns' keys."""
    keys = [column.key for column in table.columns]
    return [{key: cell.value for key, cell in zip(keys, row, strict=True)} for row in table.rows]


def to_json(tables: Iterable[Table]) -> dict[str, object]:
    """Return name -> rows and how many there are in all."""
    return {table.name: {"total": table.total or len(table.rows), "rows": to_rows(table)} for table in tables}


def of_mapping(name: str, title: str, head: tuple[str, str], pairs: Mapping[str, Value]) -> Table:
    """Return a table of two columns of text."""
    columns = (Column("name", head[0]), Column("value", head[1]))
    rows = tuple((Cell(key), Cell(value)) for key, value in pairs.items())
    return Table(name, title, columns, rows, total=len(rows))

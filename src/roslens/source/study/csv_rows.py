"""Rows of a CSV file that a user gives: bounded, with a header, each cell a number where the column wants one."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from io import StringIO
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import MOST_DOCUMENT_BYTES, read_bounded
from roslens.model.errors import UsageError
from roslens.model.source import Location


class CsvRows(msgspec.Struct, frozen=True):
    """The header and the rows of a file, each row with the line it begins in; all rows are as long as the header."""

    path: str
    head: tuple[str, ...]
    rows: tuple[tuple[int, tuple[str, ...]], ...]

    def dictionaries(self) -> list[tuple[int, dict[str, str]]]:
        """Return each row with its line as a mapping from header to cell."""
        return [(line, dict(zip(self.head, row, strict=True))) for line, row in self.rows]

    def number(self, line: int, column: str, text: str) -> float:
        """Read a cell as a number.

        Raises:
            UsageError: it is none.
        """
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise UsageError(
                f'"{text[:60]}" in the column "{column}"',
                where=Location(self.path, line),
                expected="a finite number, or an empty cell",
                advice="Correct the cell or remove the row",
            )
        return value


def read_csv(path: Path) -> CsvRows:
    """Read a file.

    Raises:
        UsageError: it cannot be read, is not UTF-8, has no header, names a column twice, or a row has another number
            of cells than the header.
    """
    try:
        text = read_bounded(path, MOST_DOCUMENT_BYTES).decode("utf-8-sig")
    except OSError as error:
        raise UsageError(
            f'"{path}" cannot be read, {error.strerror}', expected="a CSV file", advice="Check the path"
        ) from error
    except UnicodeDecodeError as error:
        raise UsageError(
            f"byte {error.start} is not UTF-8", where=str(path), expected="a CSV file in UTF-8", advice="Convert it"
        ) from error
    try:
        return _rows(str(path), text)
    except csv.Error as error:
        raise UsageError(f"no CSV, {error}", where=str(path), expected="RFC 4180", advice="Write it again") from error


def _rows(path: str, text: str) -> CsvRows:
    reader = csv.reader(StringIO(text, newline=""), strict=True)
    head = tuple(cell.strip() for cell in next(reader, ()))
    if not any(head):
        raise UsageError("no header in the first line", where=path, expected="names of columns, separated by commas")
    if doubled := sorted({name for name in head if head.count(name) > 1}):
        raise UsageError(f'two columns are called "{doubled[0]}"', where=path, expected="each name once")
    rows: list[tuple[int, tuple[str, ...]]] = []
    line = reader.line_num + 1
    for row in reader:
        if row:
            _refuse_length(row, head, path, line)
            rows.append((line, tuple(row)))
        line = reader.line_num + 1
    return CsvRows(path, head, tuple(rows))


def _refuse_length(row: Sequence[str], head: Sequence[str], path: str, line: int) -> None:
    if len(row) != len(head):
        raise UsageError(
            f"a row of {len(row)} cells",
            where=Location(path, line),
            expected=f"{len(head)}, one for each name in the first line",
            advice="Quote cells that contain a comma",
        )

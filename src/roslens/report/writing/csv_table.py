"""A table as CSV (RFC 4180) with a header line.

A cell of text that begins with ``=``, ``+``, ``-``, ``@``, a tab or a carriage return gets an apostrophe in front:
names and messages come from the source that is analysed, and a spreadsheet would run them as formulas. Numbers
stay as they are.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable
from typing import TextIO

from roslens.report.writing.control_characters import shown_controls
from roslens.report.writing.numbers import written

Cell = str | int | float | None
Table = tuple[tuple[str, ...], Iterable[tuple[Cell, ...]]]

_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def write_rows(table: Table, stream: TextIO) -> None:
    """Write a table with its header line.

    Raises:
        OSError: the stream cannot be written.
    """
    head, rows = table
    writer = csv.writer(stream, lineterminator="\r\n")
    writer.writerow(head)
    writer.writerows(map(written_cell, row) for row in rows)


def written_cell(value: Cell) -> str:
    """Return a cell as a spreadsheet may read it: text that would be a formula gets an apostrophe in front."""
    if isinstance(value, str):
        # No spreadsheet takes a zero byte, and the csv module of Python 3.10 fails on it.
        value = shown_controls(value.replace("\0", "\N{REPLACEMENT CHARACTER}"))
        return "'" + value if value.startswith(_FORMULA) else value
    return written(value)

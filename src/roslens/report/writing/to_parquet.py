"""Tables as Parquet, by pyarrow, which is installed with ``roslens[parquet]`` alone: it is larger than roslens."""

from __future__ import annotations

import os
from importlib import import_module
from pathlib import Path

from roslens.model.errors import UsageError
from roslens.report.writing.csv_table import Table


def write_parquet(table: Table, path: Path) -> None:
    """Write a table, each column of one type; what is there under this name is replaced.

    Raises:
        UsageError: pyarrow is not installed.
        OSError: the file cannot be written.
    """
    try:
        arrow, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    except ImportError as error:
        raise UsageError(
            f"--format parquet, and {error.name or 'pyarrow'} is not installed",
            expected="pyarrow",
            advice="Install it with `pip install 'roslens[parquet]'`, or write CSV",
        ) from None
    head, rows = table
    columns = list(zip(*rows, strict=True)) or [()] * len(head)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        parquet.write_table(
            arrow.table({name: arrow.array(list(column)) for name, column in zip(head, columns, strict=True)}), part
        )
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)

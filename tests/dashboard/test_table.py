"""Tables: the same cells sorted, cut, as CSV and as JSON."""

from __future__ import annotations

import csv
import io

import pytest

from roslens.dashboard.tables.table import Cell, Column, Table, next_sort, shown, sort_rows, to_csv, to_json

COLUMNS = (Column("name", "Name"), Column("size", "Size", "number", decimals=1))


def table(*rows: tuple[str, float | None], sort: str = "") -> Table:
    return Table("things", "Things", COLUMNS, tuple((Cell(name), Cell(size)) for name, size in rows), sort=sort)


def names(found: Table) -> list[object]:
    return [row[0].value for row in found.rows]


def test_numbers_sort_as_numbers_and_what_has_none_comes_last() -> None:
    found = table(("a", 10.0), ("b", None), ("c", 9.0))
    assert names(sort_rows(found, "size")) == ["c", "a", "b"]
    assert names(sort_rows(found, "-size")) == ["a", "c", "b"]


def test_texts_sort_without_regard_to_case() -> None:
    assert names(sort_rows(table(("b", 1), ("A", 1), ("C", 1)), "name")) == ["A", "b", "C"]


def test_an_unknown_column_leaves_the_order_of_the_table() -> None:
    found = sort_rows(table(("a", 1), ("b", 2), sort="-size"), "nonsense")
    assert names(found) == ["b", "a"]
    assert found.sort == "-size"


def test_a_cut_table_knows_how_many_there_were() -> None:
    found = sort_rows(table(("a", 1), ("b", 2), ("c", 3)), "-size", 2)
    assert names(found) == ["c", "b"]
    assert found.total == 3
    assert found.cut


def test_a_click_on_a_head_turns_the_order() -> None:
    found = table(("a", 1))
    assert next_sort(found, COLUMNS[1]) == "-size"
    assert next_sort(sort_rows(found, "-size"), COLUMNS[1]) == "size"
    assert next_sort(found, COLUMNS[0]) == "name"


def test_a_row_has_a_cell_for_each_column() -> None:
    with pytest.raises(ValueError, match="a row of the table 'things' has 1 cells for 2 columns"):
        Table("things", "Things", COLUMNS, ((Cell("a"),),))


def test_csv_reads_back_and_no_text_runs_as_a_formula() -> None:
    found = table(("=HYPERLINK(1)", 1.5), ('quo"te, and\nline', None), ("-1", 3))
    rows = list(csv.reader(io.StringIO(to_csv(found), newline="")))
    assert rows == [["name", "size"], ["'=HYPERLINK(1)", "1.5"], ['quo"te, and\nline', ""], ["'-1", "3"]]


def test_json_holds_values_and_the_total() -> None:
    assert to_json([table(("a", 1.5))]) == {"things": {"total": 1, "rows": [{"name": "a", "size": 1.5}]}}


def test_whole_columns_show_no_empty_digits() -> None:
    whole, broken = table(("a", 3.0)), table(("a", 3.0), ("b", 0.25))
    assert whole.digits() == [0, 0]
    assert shown(COLUMNS[1], whole.rows[0][1], 0) == "3"
    assert shown(COLUMNS[1], broken.rows[0][1], broken.digits()[1]) == "3.0"
    assert shown(COLUMNS[1], Cell(None)) == "\N{EN DASH}"


def test_columns_that_no_row_fills_are_not_on_the_page_but_in_its_twins() -> None:
    columns = (Column("name", "Name"), Column("why", "Why", sparse=True), Column("how", "How", sparse=True))
    found = Table("t", "T", columns, ((Cell("a"), Cell(""), Cell("b")), (Cell("c"), Cell(None), Cell(""))))
    assert [column.key for column in found.on_page().columns] == ["name", "how"]
    assert [len(row) for row in found.on_page().rows] == [2, 2]
    assert to_csv(found).splitlines()[0] == "name,why,how"
    whole = table(("a", 1.0))
    assert whole.on_page() is whole
